// Base twist to wheel speeds and back, for a skid-steer base.
#pragma once

#include <array>

#include "drover/twist.h"
#include "engine/config.h"

namespace drover::engine {

/// Joint velocities (rad/s) of left and right wheels for a twist of base_link. When a wheel would
/// be faster than `max_wheel_mps`, both are scaled so that the curvature stays. Zero when any
/// number is not finite, or when the limit or the wheel permits no motion.
struct WheelSpeeds {
  double left_radps = 0;
  double right_radps = 0;
};
WheelSpeeds wheels_from_twist(const BaseConfig& base, double yaw_slip_factor, const Twist& twist,
                              double max_wheel_mps);
/// `left_mps`, `right_mps`: rim speeds.
Twist twist_from_wheels(const BaseConfig& base, double yaw_slip_factor, double left_mps,
                        double right_mps);

}  // namespace drover::engine
