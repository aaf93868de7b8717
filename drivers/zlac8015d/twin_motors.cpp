// The simulated drive's motor side: encoders, ramps, velocity controllers.
#include <algorithm>
#include <cmath>
#include <numbers>

#include "drivers/zlac8015d/twin.h"

namespace drover::zlac8015d {
namespace {

/// What the times of 6083 and 6084 count to; the maker does not say.
constexpr double kRampTo_rpm = 100;
constexpr double kRadpsPerRpm = 2 * std::numbers::pi / 60;

}  // namespace

double Zlac8015dTwin::torque_of(std::size_t wheel, double dt_s) {
  Wheel& w = wheels_[wheel];
  const bool follows = w.drive == canopen::DriveState::operation_enabled &&
                       stored(canopen::kMode, 0) == kVelocityMode;
  const double asked_rpm =
      follows ? w.target / std::max(1.0, static_cast<double>(stored(kDriverParameters, 5))) : 0.0;
  const bool faster = std::abs(asked_rpm) > std::abs(w.ramped_rpm);
  const auto sub = static_cast<std::uint8_t>(wheel + 1);
  const double time_s = stored(faster ? kAccelerationTime : kDecelerationTime, sub) / 1000.0;
  const double step_rpm = time_s > 0 ? kRampTo_rpm * dt_s / time_s : 1e9;
  w.ramped_rpm += std::clamp(asked_rpm - w.ramped_rpm, -step_rpm, step_rpm);
  const double wanted_radps = w.ramped_rpm * kRadpsPerRpm / settings_.gear_ratio;
  const double error_radps = wanted_radps - w.measured_radps;
  const double limit_Nm = twin_.torque_limit_Nm;
  w.integral_Nm += error_radps * twin_.integrator_gain_Nm_per_rad * dt_s;
  w.integral_Nm = std::clamp(w.integral_Nm, -limit_Nm, limit_Nm);
  return std::clamp(twin_.velocity_gain_Nms_per_rad * error_radps + w.integral_Nm, -limit_Nm,
                    limit_Nm);
}

void Zlac8015dTwin::move(double dt_s, std::span<Shaft> shafts) {
  for (std::size_t wheel = 0; wheel < kWheels && wheel < shafts.size(); ++wheel) {
    Wheel& w = wheels_[wheel];
    Shaft& shaft = shafts[wheel];
    const bool energized = booted_ && canopen::is_powered(w.drive);
    const double sign = settings_.sign[wheel];
    if (!booted_) w.power_on_rad = shaft.position_rad * sign;
    w.position_rad = shaft.position_rad * sign - w.power_on_rad;
    w.measured_radps = shaft.velocity_radps * sign;
    if (!energized) {
      w.integral_Nm = 0;
      w.ramped_rpm = w.measured_radps / kRadpsPerRpm * settings_.gear_ratio;
    }
    const double torque_Nm = energized ? torque_of(wheel, dt_s) * sign : 0;
    shaft.torque_Nm = w.torn ? 0 : torque_Nm;
    shaft.energized = energized;
  }
}

}  // namespace drover::zlac8015d
