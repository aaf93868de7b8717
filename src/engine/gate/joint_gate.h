// The gate of single joints: limits of speed and acceleration between joint commands and drives.
#pragma once

#include <array>
#include <span>

#include "engine/config.h"
#include "engine/gate/target_gate.h"

namespace drover::engine {

/// The base's limits, taken to the joints by the wheel radius. What is not permitted becomes a ramp
/// to zero; an immediate stop is zero at once.
class JointGate final {
 public:
  JointGate(const LimitsConfig& limits, double wheel_radius_m);

  /// `wanted_radps` by AxisId. Values that are not numbers count as zero. With any stop but `none`
  /// nothing is followed.
  void step(Duration dt, std::span<const double> wanted_radps, double max_radps, Stop stop);
  void reset() { velocities_.fill(0); }

  bool at_rest() const;
  /// rad/s by AxisId, to be commanded now.
  const std::array<double, kMaxAxes>& velocities_radps() const { return velocities_; }

 private:
  double acceleration_radps2_;
  double deceleration_radps2_;
  std::array<double, kMaxAxes> velocities_{};
};

}  // namespace drover::engine
