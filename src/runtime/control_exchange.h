// What the control thread and the others give each other, without a lock.
#pragma once

#include <atomic>
#include <cstdint>

#include "drover/event.h"
#include "drover/snapshot.h"
#include "drover/spsc_ring.h"
#include "drover/triple_buffer.h"
#include "runtime/command_intake.h"
#include "runtime/recorder.h"
#include "runtime/scene_sight.h"
#include "runtime/stop_requests.h"
#include "runtime/wake.h"

namespace drover::runtime {

/// What the control thread shares with the publish and the main thread.
struct ControlExchange {
  CommandRing commands;             ///< publish → control
  StopRequests stops;               ///< any → control: never full, never behind commands
  SpscRing<Event, 256> events;      ///< control → publish
  TripleBuffer<Snapshot> snapshot;  ///< control → publish
  Wake events_ready;
  std::atomic<std::uint64_t> beats{0};
  std::atomic<bool> at_rest{true};  ///< no task, no axis is commanded to move, and none does
  std::atomic<std::uint64_t> lost_events{0};
  /// Main → control, of static lifetime: why the robot comes to rest; nullptr while all is well.
  std::atomic<const char*> trouble{nullptr};
  /// Counted by the main thread at each look at the others; 0: it has not begun.
  std::atomic<std::uint64_t> looks{0};
  SceneSight* scene = nullptr;   ///< nullptr: the robot has no scene
  Recorder* recorder = nullptr;  ///< control and publish tell it; nullptr: nothing is recorded
};

}  // namespace drover::runtime
