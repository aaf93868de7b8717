// The gate of single joints: limits of speed and acceleration between joint commands and drives.
#include "engine/gate/joint_gate.h"

#include <algorithm>
#include <cmath>

#include "engine/drive/skid_steer.h"

namespace drover::engine {
namespace {

constexpr double kRest_radps = 1e-9;

}  // namespace

JointGate::JointGate(const BaseConfig& base, const LimitsConfig& limits)
    : base_(base), limits_(limits) {}

/// Which part of the wanted velocities keeps within the limits; 0 when nothing does. Each wheel on
/// the left makes a twist with each on the right, and the worst one counts: wheels of one side that
/// work against each other hide nothing.
double JointGate::permitted_share(const Velocities& wanted_radps, double yaw_slip_factor,
                                  double cap_mps) const {
  double rim_mps = 0;
  for (const double wanted : wanted_radps)
    rim_mps = std::max(rim_mps, std::abs(wanted) * base_.wheel_radius_m);
  double speed_mps = 0;
  double turn_radps = 0;
  for (const AxisId left : base_.left) {
    for (const AxisId right : base_.right) {
      const Twist twist =
          twist_from_wheels(base_, yaw_slip_factor, wanted_radps[left] * base_.wheel_radius_m,
                            wanted_radps[right] * base_.wheel_radius_m);
      speed_mps = std::max(speed_mps, std::abs(twist.vx_mps));
      turn_radps = std::max(turn_radps, std::abs(twist.wz_radps));
    }
  }
  const auto within = [](double limit, double value) {
    if (value == 0) return 1.0;
    return limit > 0 ? std::min(limit / value, 1.0) : 0.0;
  };
  const double share = std::min({within(cap_mps, rim_mps), within(limits_.max_speed_mps, speed_mps),
                                 within(limits_.max_yaw_rate_radps, turn_radps)});
  return yaw_slip_factor > 0 && std::isfinite(share) ? share : 0;
}

/// All joints arrive together: on the straight line between two twists within the limits there is
/// none beyond them.
void JointGate::approach(const Velocities& target_radps, double dt_s) {
  const double faster_radps = limits_.acceleration_mps2 * dt_s / base_.wheel_radius_m;
  const double slower_radps = limits_.deceleration_mps2 * dt_s / base_.wheel_radius_m;
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
  Velocities target{};
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
