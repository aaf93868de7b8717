// Everything that reaches the gateway, as one type with a time: who applies the same inputs to the
// same configuration gets the same outputs, to the bit. That is what a recording holds.
//
// A new input is a struct here, a line in the variant, an `on` in the gateway and a pair of lines
// in input_codec.cpp; what is not in the variant cannot reach the gateway at all.
#pragma once

#include <cstdint>
#include <span>
#include <variant>

#include "drover/can_frame.h"
#include "drover/clearance.h"
#include "drover/command.h"
#include "drover/driver.h"
#include "drover/fixed_text.h"
#include "drover/fixed_vector.h"
#include "drover/learned.h"
#include "drover/measurement.h"
#include "drover/remembered.h"
#include "drover/time.h"

namespace drover::gateway {

/// Links and slots are named by their numbers in the gateway's Wiring.
using LinkId = std::uint8_t;
using SlotId = std::uint8_t;
inline constexpr std::uint8_t kNowhere = 0xFF;  ///< no such link or slot
inline constexpr std::size_t kMaxLinks = 32;
inline constexpr std::size_t kMaxSlots = 96;
inline constexpr std::size_t kMaxBuses = 8;
inline constexpr std::size_t kMaxLevels = 16;  ///< of one chip

/// A frame of a bus; the input's time is when it was received.
struct FrameHeard {
  LinkId bus = 0;
  CanFrame frame;
};
/// The input's time is when the first byte came in. The bytes are the caller's, for the call only.
struct BytesHeard {
  LinkId link = 0;
  std::span<const std::uint8_t> bytes;
};
/// `levels[i]` belongs to the i-th slot on the link; true: electrically high.
struct LevelsRead {
  LinkId link = 0;
  FixedVector<bool, kMaxLevels> levels;
};
/// The device's answer to the request `block` of its driver, asked in a thread of its own.
struct RegistersRead {
  SlotId slot = 0;
  std::uint8_t block = 0;
  FixedVector<std::uint16_t, 125> words;
};
/// The request brought nothing; `exception` is Modbus's of a refusal, else 0.
struct RegistersFailed {
  SlotId slot = 0;
  std::uint8_t block = 0;
  RegisterFailure failure = RegisterFailure::silent;
  int exception = 0;
};
struct LinkUp {
  LinkId link = 0;
};
/// It is gone, or cannot be opened: why. Until LinkUp, or until levels are read from it.
struct LinkLost {
  LinkId link = 0;
  Reason why;
};
/// After each cycle's frames: how many the link took and refused so far. One that takes none for
/// as long as a drive may be silent is as good as gone, though it still hears.
struct FramesSent {
  LinkId bus = 0;
  std::uint64_t sent = 0;
  std::uint64_t refused = 0;
};
struct CommandGiven {
  Command command;
};
/// A part of the daemon hangs, or it is about to end: why the robot comes to rest and no start is
/// taken. Empty: no longer.
struct ProgramTrouble {
  Reason why;
};
/// The whole computer slept for so long: nothing that was heard before it is true any more.
struct Suspended {
  double lasted_s = 0;
};
/// Before the first cycle: what the program before this one left.
struct Recalled {
  Remembered remembered;
};
/// Before the first cycle: what drives taught the robot of itself, by the programs before this one.
struct LearnedRecalled {
  LearnedValues learned;
};
/// The output lines were opened; whether the enable relay was closed then, because another program
/// had kept it.
struct OutputsUp {
  bool relay_closed = false;
};
/// Somebody looked around the robot.
struct ClearanceFound {
  Clearance clearance;
};
/// The control thread stood still while the robot moved, for so long that a guard which lived would
/// have taken the drives: whatever moves comes to rest. What is heard meanwhile has its own time.
struct HeldUp {
  double lasted_s = 0;
};
/// One control cycle: afterwards the gateway's output is that cycle's.
struct Tick {
  bool guard_alive = false;
  bool guard_has_bus = false;  ///< it sends stop frames; ours are blocked until hand-back
  bool guard_latched = false;  ///< somebody stopped the robot at the guard, until a reset there
  /// It keeps the stop set of another configuration, and takes this one's with a reset there.
  bool guard_refuses_set = false;
  bool guard_has_all = false;  ///< it takes this program for gone
};

/// The order is the recording's: a new one goes to the end.
using InputBody =
    std::variant<FrameHeard, BytesHeard, LevelsRead, RegistersRead, RegistersFailed, LinkUp,
                 LinkLost, FramesSent, CommandGiven, Tick, ProgramTrouble, Suspended, Recalled,
                 OutputsUp, ClearanceFound, LearnedRecalled, HeldUp>;

struct Input {
  Time time = kNever;
  InputBody body;
};

}  // namespace drover::gateway
