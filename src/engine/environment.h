// What the engine is told of the world beside measurements and commands.
#pragma once

#include <array>

#include "drover/driver.h"
#include "drover/fixed_text.h"
#include "drover/measurement.h"
#include "drover/role.h"

namespace drover::engine {

/// What the runtime knows and the engine must not find out itself.
struct Environment {
  bool guard_alive = false;
  bool guard_has_bus = false;  ///< the guard sends stop frames; ours are blocked until hand-back
  bool guard_latched = false;  ///< somebody stopped the robot at the guard, until a reset there
  bool guard_refuses_set = false;  ///< it keeps the stop set of another configuration, until then
  bool guard_has_all = false;      ///< it takes this program for gone
  /// By a stop from outside the guard leaves what only a program can hold to the one whose stop set
  /// it has, and which it hears: else it plays all, and two would write.
  bool guard_leaves_the_rest() const {
    return guard_latched && !guard_refuses_set && !guard_has_all;
  }
  /// The drives had power when the outputs were opened: another program kept the enable relay.
  bool relay_found_closed = false;
  /// Health of each drive, by AxisId, as its driver judges it.
  std::array<SourceHealth, kMaxAxes> axes{};
  SourceHealth base{};  ///< of the device of a base that takes a twist
  /// A drive keeps its last command when it is no longer reached.
  bool drives_on_in_silence = false;
  bool stop_creeps = false;  ///< a drive that is told to stand only brakes: on a slope it creeps
  Reason slept;    ///< the computer, or droverd stood still: a task ends; empty when neither did
  Reason foreign;  ///< who else commands the drives; empty when nobody does
  Reason bus;      ///< what is wrong with a CAN bus; empty when all is well
  /// A part of the daemon hangs, or it is about to end: motion ends with a ramp. Empty: all is
  /// well.
  Reason program;
  // By the number of their kind.
  std::array<SourceHealth, kMaxOfKind> gnss{};
  std::array<SourceHealth, kMaxOfKind> imu{};
  std::array<SourceHealth, kMaxOfKind> battery{};
  std::array<SourceHealth, kLineCount> lines{};
  bool gnss_configured = true;
  bool imu_configured = false;
};

}  // namespace drover::engine
