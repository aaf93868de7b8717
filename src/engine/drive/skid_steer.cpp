// Base twist to wheel speeds and back, for a skid-steer base.
#include "engine/drive/skid_steer.h"

#include <algorithm>
#include <cmath>

namespace drover::engine {

WheelSpeeds wheels_from_twist(const BaseConfig& base, double yaw_slip_factor, const Twist& twist,
                              double max_wheel_mps) {
  const double turn_mps = 0.5 * base.track_m * yaw_slip_factor * twist.wz_radps;
  double left_mps = twist.vx_mps - turn_mps;
  double right_mps = twist.vx_mps + turn_mps;
  const double fastest_mps = std::max(std::abs(left_mps), std::abs(right_mps));
  // Fails closed: what is not a number, and a limit that permits nothing, is a stop.
  if (!std::isfinite(left_mps) || !std::isfinite(right_mps) || !(max_wheel_mps > 0) ||
      !(base.wheel_radius_m > 0)) {
    return {};
  }
  if (fastest_mps > max_wheel_mps) {
    left_mps *= max_wheel_mps / fastest_mps;
    right_mps *= max_wheel_mps / fastest_mps;
  }
  return {left_mps / base.wheel_radius_m, right_mps / base.wheel_radius_m};
}

Twist twist_from_wheels(const BaseConfig& base, double yaw_slip_factor, double left_mps,
                        double right_mps) {
  return {0.5 * (left_mps + right_mps), (right_mps - left_mps) / (base.track_m * yaw_slip_factor)};
}

}  // namespace drover::engine
