// Whether the wheels of a base that steers are where they are told to be.
#pragma once

#include "engine/base/kinematics.h"

namespace drover::engine {

/// A wheel that stays behind leads the robot off its curve before its place shows it. At rest
/// nothing is asked of it: its angle stays.
class SteeringWatch final {
 public:
  explicit SteeringWatch(const EngineConfig& config);

  /// Once a cycle: what was commanded in the last one, and the angle that the base told last (not a
  /// number: it does not tell it).
  void update(Time now, Duration dt, const Twist& commanded, double measured_rad);
  /// Empty: it follows, or does not steer.
  const Reason& reason() const { return reason_; }

 private:
  double wheelbase_m_ = 0;  ///< 0: it does not steer
  double limit_s_;
  double followed_rad_ = 0;  ///< where a wheel that lags a little is by now
  Time astray_since_ = kNever;
  Reason reason_;
};

}  // namespace drover::engine
