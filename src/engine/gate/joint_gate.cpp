// The gate of single joints: limits of speed and acceleration between joint commands and drives.
#include "engine/gate/joint_gate.h"

#include <algorithm>
#include <cmath>

namespace drover::engine {

JointGate::JointGate(const LimitsConfig& limits, double wheel_radius_m)
    : acceleration_radps2_(limits.acceleration_mps2 / wheel_radius_m),
      deceleration_radps2_(limits.deceleration_mps2 / wheel_radius_m) {}

void JointGate::step(Duration dt, std::span<const double> wanted_radps, double max_radps,
                     Stop stop) {
  if (stop == Stop::immediate) return reset();
  const double dt_s = std::max(to_s(dt), 0.0);
  for (std::size_t i = 0; i < velocities_.size(); ++i) {
    const bool follow = stop == Stop::none && i < wanted_radps.size() && max_radps > 0 &&
                        std::isfinite(wanted_radps[i]);
    const double target = follow ? std::clamp(wanted_radps[i], -max_radps, max_radps) : 0.0;
    const double now = velocities_[i];
    // Through zero it goes in two steps: slowing down has its own limit.
    const bool slower = now != 0 && (target * now <= 0 || std::abs(target) < std::abs(now));
    const double aim = slower && target * now < 0 ? 0.0 : target;
    const double step = (slower ? deceleration_radps2_ : acceleration_radps2_) * dt_s;
    velocities_[i] = std::abs(aim - now) <= step ? aim : now + std::copysign(step, aim - now);
  }
}

bool JointGate::at_rest() const {
  return std::all_of(velocities_.begin(), velocities_.end(), [](double v) { return v == 0; });
}

}  // namespace drover::engine
