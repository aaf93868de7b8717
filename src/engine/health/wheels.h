// Whether the wheels do what they are told: blocked, not following, running away.
#pragma once

#include <array>
#include <span>

#include "drover/snapshot.h"
#include "engine/base/kinematics.h"
#include "engine/config.h"

namespace drover::engine {

/// What is wrong with the wheels; `none` when they follow.
enum class WheelFault : std::uint8_t {
  none,
  blocked,        ///< all are commanded and none moves
  not_following,  ///< some move and one does not, or moves the wrong way
  runaway,        ///< one turns much faster than it was told to of late
  disagrees,      ///< wheels, gyro and receiver tell different ways since the start
};

/// Compares commands with feedback. It looks at travelled angle, so it needs no tuned lag: a wheel
/// follows when it made a fifth of the commanded way, in the commanded direction; one that does not
/// is given the way, too, by which tyres that were wound up unwind. How fast a wheel
/// may turn follows its command with the delay and the deceleration of a stop; a wheel that is seen
/// for the first time, again after a silence, or newly in closed loop begins with the speed it has.
/// No wheel is faster than the highest command, except one that is caught while it rolls: until it
/// is slower once, only what it began with counts, over a silence, too.
class WheelMonitor final {
 public:
  explicit WheelMonitor(const EngineConfig& config);

  /// `axes` with the commands of the last cycle.
  WheelFault update(Time now, Duration dt, std::span<const AxisSnapshot> axes);
  void reset();
  const Reason& reason() const { return reason_; }

 private:
  struct Wheel {
    bool active = false;  ///< commanded enough to be judged
    bool forwards = true;
    double commanded_rad = 0;  ///< in this window
    double moved_rad = 0;      ///< in this window, in the commanded direction
    double last_position_rad = kAbsent;
    Time window = kNever;    ///< when this window began
    Time mark = kNever;      ///< when it was last seen to follow
    double owed_rad = 0;     ///< commanded since then
    double made_rad = 0;     ///< moved since then, in the commanded direction
    bool judged = false;     ///< heard, and in closed loop, in the cycle before
    double reach_radps = 0;  ///< how fast the commands of late may have made it
    double began_radps = 0;  ///< its reach when it was first seen, or caught
    Time reached = kNever;   ///< when a command, or its first speed, last asked for so much
    bool let_go = false;     ///< heard, and not in closed loop, in the cycle before
    bool caught = false;     ///< taken into closed loop while it turned faster than any command
    Time fast_since = kNever;
  };
  void watch(Wheel& wheel, const AxisSnapshot& axis, Time now, Duration dt);
  void follow_command(Wheel& wheel, const AxisSnapshot& axis, Time now, Duration dt) const;
  bool runs_away(Wheel& wheel, const AxisSnapshot& axis, Time now, Duration dt) const;
  void tell_runaway(const AxisSnapshot& axis);
  void tell_blocked(Duration since);

  EngineConfig config_;
  Kinematics base_;
  double judged_radps_;   ///< slower commands are not judged
  double unwinds_rad_;    ///< less than this commanded way a wheel may stay behind
  double fastest_radps_;  ///< no command is faster
  double margin_radps_;   ///< faster than told by more than this: it runs away
  double falls_radps2_;   ///< of a wheel's reach, once nothing asks for it any more
  std::array<Wheel, kMaxAxes> wheels_{};
  Reason reason_;
};

}  // namespace drover::engine
