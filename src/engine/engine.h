// The engine: measurements and commands in, one snapshot, axis commands and events out.
// Pure and deterministic: equal inputs give equal outputs, to the bit. No descriptor, clock or
// allocation after construction. Each stage has a folder; Engine::step has their order.
#pragma once

#include <array>
#include <memory>

#include "drover/clearance.h"
#include "drover/command.h"
#include "drover/driver.h"
#include "drover/event.h"
#include "drover/fixed_vector.h"
#include "drover/learned.h"
#include "drover/remembered.h"
#include "drover/snapshot.h"
#include "drover/twist.h"
#include "drover/viewpoint.h"
#include "engine/config.h"
#include "engine/environment.h"

namespace drover::engine {

/// What a base that takes a twist is to do now.
struct BaseCommand {
  AxisRequest request = AxisRequest::rest;
  Twist twist;  ///< with `hold`: as it moves now, and falling
  /// As EngineOutput::slowing_permitted, of its device.
  bool slowing_permitted = false;
};

struct EngineOutput {
  std::array<AxisCommand, kMaxAxes> axes{};
  BaseCommand base;                          ///< of one that takes a twist: it has no axes
  std::array<bool, kOutputCount> outputs{};  ///< by Output, true is on
  FixedVector<Event, 64> events;
  /// True while any motion is permitted this cycle; the frame gate refuses motion frames otherwise.
  bool motion_permitted = false;
  /// By AxisId: nothing else may move it, but a ramp from its present speed to rest is permitted.
  std::array<bool, kMaxAxes> slowing_permitted{};
  /// By AxisId, of joints outside the base: it holds, or follows its commands. Whether the base may
  /// move opens nothing for them, and they nothing for the base.
  std::array<bool, kMaxAxes> joint_may_move{};
  /// What is commanded to rest may not be there yet: its power is being cut, or it is silent and
  /// may go on.
  bool unsettled = false;
  Remembered remembered;  ///< what is to outlive this program, as of this cycle
};

class Engine final {
 public:
  /// Throws std::invalid_argument when an axis of the base is not among the joints.
  explicit Engine(const EngineConfig& config);
  ~Engine();

  /// Before the first step: what the program before this one left.
  void recall(const Remembered& remembered, Time now);
  /// Likewise, of the robot.
  void recall(const LearnedValues& learned);
  void on_measurement(const Measurement& measurement);
  /// After it: what its device says of it in words.
  void on_words(const Measurement& measurement, std::string_view words);
  void on_command(const Command& command, Time now);
  /// Somebody looked around. Without EngineConfig::clearance_required it changes nothing.
  void on_clearance(const Clearance& found);
  /// One control cycle. `out` is cleared first.
  void step(Time now, const Environment& environment, EngineOutput& out);
  /// The engine's part of the snapshot (links and cycle statistics are the runtime's).
  const Snapshot& snapshot() const;
  /// For whoever looks around; of the last step.
  const Viewpoint& viewpoint() const;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace drover::engine
