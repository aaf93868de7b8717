// Whether the wheels do what they are told: blocked, not following, running away.
#pragma once

#include <array>
#include <span>

#include "drover/snapshot.h"
#include "engine/config.h"

namespace drover::engine {

/// What is wrong with the wheels; `none` when they follow.
enum class WheelFault : std::uint8_t {
  none,
  blocked,        ///< all are commanded and none moves
  not_following,  ///< some move and one does not, or moves the wrong way
  runaway,        ///< faster than any command can be
};

/// Compares commands with feedback. It looks at travelled angle, so it needs no tuned lag: a wheel
/// follows when it made a fifth of the commanded way, in the commanded direction.
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
    Time window = kNever;  ///< when this window began
    Time mark = kNever;    ///< when it was last seen to follow
    Time fast_since = kNever;
  };
  void watch(Wheel& wheel, const AxisSnapshot& axis, Time now, Duration dt);
  bool runs_away(Wheel& wheel, const AxisSnapshot& axis, Time now) const;

  EngineConfig config_;
  double judged_radps_;   ///< slower commands are not judged
  double fastest_radps_;  ///< no command is faster
  std::array<Wheel, kMaxAxes> wheels_{};
  Reason reason_;
};

/// Rim speed that no wheel is commanded beyond: full speed in the tightest permitted turn, m/s.
double max_wheel_mps(const BaseConfig& base, const LimitsConfig& limits, double yaw_slip_factor);

}  // namespace drover::engine
