// Roll and pitch of the base from an inertial sensor, and its turn about the vertical.
#pragma once

#include "drover/measurement.h"
#include "drover/time.h"

namespace drover::engine::estimate {

inline constexpr double kGravity_mps2 = 9.81;

/// Takes the device's own orientation when it gives one. Else the gyro carries roll and pitch and
/// gravity levels them: in half a second at rest, slowly in motion, where acceleration is not only
/// gravity. REP 103: roll is positive with the left side up, pitch with the nose down.
class Tilt final {
 public:
  /// `bias_radps` is taken off about x and y only. `speed_mps` of the base, for the force of a
  /// bend.
  void update(const ImuSample& sample, Time at, bool standing, double speed_mps,
              const Vector3& bias_radps);
  bool known() const { return last_ != kNever; }
  double roll_rad() const { return roll_rad_; }
  double pitch_rad() const { return pitch_rad_; }
  /// Rate about the vertical for a rate in the axes of the base, as tilted as now.
  double vertical_radps(const Vector3& rate_radps) const;
  void forget() { last_ = kNever; }

 private:
  void level(const ImuSample& sample, double dt_s, bool standing, double speed_mps,
             const Vector3& bias_radps);

  double roll_rad_ = 0;
  double pitch_rad_ = 0;
  Time last_ = kNever;
};

}  // namespace drover::engine::estimate
