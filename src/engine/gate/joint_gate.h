// The gate of single joints: limits of speed and acceleration between joint commands and drives.
#pragma once

#include <algorithm>
#include <span>

#include "engine/base/kinematics.h"
#include "engine/gate/target_gate.h"

namespace drover::engine {

/// The base's limits hold for the twist that the joints make together, as its kinematics make it.
/// What is too fast is scaled, all joints alike, so that the curve stays. What is not permitted
/// becomes a ramp to zero; an immediate stop is zero at once.
class JointGate final {
 public:
  using Velocities = JointVelocities;

  JointGate(const BaseConfig& base, const LimitsConfig& limits);

  /// `wanted_radps` by AxisId. Values that are not numbers count as zero. `cap_mps`: no wheel's rim
  /// is faster. With any stop but `none` nothing is followed.
  void step(Duration dt, std::span<const double> wanted_radps, double yaw_slip_factor,
            double cap_mps, Stop stop);
  void reset() { std::fill(velocities_.begin(), velocities_.end(), 0.0); }

  bool at_rest() const;
  /// rad/s by AxisId, to be commanded now.
  const Velocities& velocities_radps() const { return velocities_; }

 private:
  double permitted_share(const Velocities& wanted_radps, double yaw_slip_factor,
                         double cap_mps) const;
  void approach(const Velocities& target_radps, double dt_s);

  Kinematics base_;
  LimitsConfig limits_;
  Velocities velocities_;
};

}  // namespace drover::engine
