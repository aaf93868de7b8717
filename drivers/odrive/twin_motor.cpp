// The simulated drive's motor side: encoder, velocity controller, torque and heat.
#include <algorithm>
#include <cmath>
#include <numbers>

#include "drivers/odrive/twin.h"

namespace drover::odrive {
namespace {

/// Share of the way that a first-order lag goes in one step.
double lag_share(double dt_s, double time_constant_s) {
  return time_constant_s > 0 ? 1 - std::exp(-dt_s / time_constant_s) : 1.0;
}

}  // namespace

void OdriveTwin::move(double dt_s, Shaft& shaft) {
  const double sign = motor_sign();
  if (booted_) {
    if (!position_known_) {
      position_known_ = true;
      power_on_rad_ = shaft.position_rad * sign;
    }
    const double count_rad =
        2 * std::numbers::pi / (twin_.encoder_counts_per_turn * settings_.gear_ratio);
    const double velocity_radps = stuck_ ? 0.0 : shaft.velocity_radps * sign;
    if (!stuck_)
      measured_rad_ =
          std::floor((shaft.position_rad * sign - power_on_rad_) / count_rad) * count_rad;
    measured_radps_ +=
        (velocity_radps - measured_radps_) * lag_share(dt_s, twin_.estimator_time_constant_s);
  }
  double wanted_Nm = 0;
  if (booted_ && state_ == kStateClosedLoop) {
    // In any mode but velocity with passthrough the set point is not a speed: hold.
    const bool velocity = control_mode_ == kControlVelocity && input_mode_ == kInputPassthrough;
    const double target_radps =
        velocity ? input_turnps_ * 2 * std::numbers::pi / settings_.gear_ratio : 0.0;
    const double error_radps = target_radps - measured_radps_;
    const double limit_Nm = twin_.torque_limit_Nm;
    integral_Nm_ += error_radps * twin_.integrator_gain_Nm_per_rad * dt_s;
    integral_Nm_ = std::clamp(integral_Nm_, -limit_Nm, limit_Nm);
    wanted_Nm = twin_.velocity_gain_Nms_per_rad * error_radps + integral_Nm_;
    if (std::abs(wanted_Nm) > limit_Nm) {
      // Saturated: no more winding up than what the limit leaves.
      wanted_Nm = std::copysign(limit_Nm, wanted_Nm);
      const double room_Nm = wanted_Nm - twin_.velocity_gain_Nms_per_rad * error_radps;
      integral_Nm_ = std::clamp(integral_Nm_, std::min(room_Nm, 0.0), std::max(room_Nm, 0.0));
    }
    torque_Nm_ += (wanted_Nm - torque_Nm_) * lag_share(dt_s, twin_.motor_time_constant_s);
  } else {
    torque_Nm_ = 0;
  }
  shaft.torque_Nm = torque_Nm_ * sign;
  shaft.energized = booted_ && state_ == kStateClosedLoop;
}

void OdriveTwin::heat(double dt_s, const Shaft& shaft) {
  const double constant =
      settings_.torque_constant_Nm_per_A > 0 ? settings_.torque_constant_Nm_per_A : 0.1;
  const double current_A = torque_Nm_ / settings_.gear_ratio / constant;
  const double loss_W = 1.5 * current_A * current_A * twin_.phase_resistance_ohm;
  const double cooling_W = (motor_degC_ - twin_.ambient_degC) / twin_.thermal_resistance_KpW;
  electrical_W_ = loss_W + shaft.torque_Nm * shaft.velocity_radps;
  motor_degC_ += (loss_W - cooling_W) / twin_.thermal_capacity_JpK * dt_s;
  if (over_temperature_) motor_degC_ = std::max(motor_degC_, twin_.motor_limit_degC + 10);
  const std::uint32_t hot = v0_6() ? 0x2000U : 0x40040U;
  if (booted_ && motor_degC_ > twin_.motor_limit_degC && (error_ & hot) != hot) disarm(hot);
}

}  // namespace drover::odrive
