// The gate of single joints: limits of speed and acceleration between joint commands and drives.
#include "engine/gate/joint_gate.h"

#include <algorithm>
#include <cmath>

namespace drover::engine {
namespace {

constexpr double kRest_radps = 1e-9;

}  // namespace

JointGate::JointGate(const BaseConfig& base, const LimitsConfig& limits)
    : base_(kinematics_of(base)), limits_(limits) {
  velocities_.resize(joints_needed(base));
}

/// Which part of the wanted velocities keeps within the limits; 0 when nothing does.
double JointGate::permitted_share(const Velocities& wanted_radps, double yaw_slip_factor,
                                  double cap_mps) const {
  double fastest_mps = 0;
  for (const double wanted : wanted_radps)
    fastest_mps = std::max(fastest_mps, rim_mps(base_, std::abs(wanted)));
  const Twist twist = largest_twist(base_, wanted_radps, {yaw_slip_factor});
  const auto within = [](double limit, double value) {
    if (value == 0) return 1.0;
    return limit > 0 ? std::min(limit / value, 1.0) : 0.0;
  };
  const double share =
      std::min({within(cap_mps, fastest_mps), within(limits_.max_speed_mps, twist.vx_mps),
                within(limits_.max_yaw_rate_radps, twist.wz_radps)});
  return yaw_slip_factor > 0 && std::isfinite(share) ? share : 0;
}

/// All joints arrive together: on the straight line between two twists within the limits there is
/// none beyond them.
void JointGate::approach(const Velocities& target_radps, double dt_s) {
  const double faster_radps = joint_radps(base_, limits_.acceleration_mps2 * dt_s);
  const double slower_radps = joint_radps(base_, limits_.deceleration_mps2 * dt_s);
  double share = 1;
  for (std::size_t i = 0; i < velocities_.size(); ++i) {
    const double now = velocities_[i];
    const double target = target_radps[i];
    if (target == now) continue;
    // Through zero it goes in two steps: slowing down has its own limit.
    const bool through_zero = target * now < 0;
    const bool slower = through_zero || std::abs(target) < std::abs(now);
    double step_radps = slower ? slower_radps : faster_radps;
    if (through_zero) step_radps = std::min(step_radps, std::abs(now));
    share = std::min(share, step_radps / std::abs(target - now));
  }
  for (std::size_t i = 0; i < velocities_.size(); ++i) {
    double& velocity = velocities_[i];
    velocity = share < 1 ? velocity + share * (target_radps[i] - velocity) : target_radps[i];
    if (std::abs(velocity) < kRest_radps) velocity = 0;  // what rounding leaves at zero
  }
}

void JointGate::step(Duration dt, std::span<const double> wanted_radps, double yaw_slip_factor,
                     double cap_mps, Stop stop) {
  if (stop == Stop::immediate) return reset();
  Velocities target;
  target.resize(velocities_.size());
  if (stop == Stop::none) {
    for (std::size_t i = 0; i < target.size() && i < wanted_radps.size(); ++i)
      if (std::isfinite(wanted_radps[i])) target[i] = wanted_radps[i];
    const double share = permitted_share(target, yaw_slip_factor, cap_mps);
    for (double& velocity : target) velocity *= share;
  }
  approach(target, std::max(to_s(dt), 0.0));
}

bool JointGate::at_rest() const {
  return std::all_of(velocities_.begin(), velocities_.end(), [](double v) { return v == 0; });
}

}  // namespace drover::engine
