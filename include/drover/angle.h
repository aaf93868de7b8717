// Angles: wrapping, and the heading conventions of the field (REP 103: yaw is radians
// counter-clockwise from east; a compass heading is degrees clockwise from true north).
#pragma once

#include <cmath>
#include <numbers>

namespace drover {

inline constexpr double kPi = std::numbers::pi;

/// Wraps to [-pi, pi).
inline double wrap_rad(double angle_rad) {
  const double turns = std::floor((angle_rad + kPi) / (2 * kPi));
  return angle_rad - turns * 2 * kPi;
}
/// Wraps to [0, 360).
inline double wrap_deg(double angle_deg) {
  const double wrapped = angle_deg - std::floor(angle_deg / 360.0) * 360.0;
  return wrapped >= 360.0 ? 0.0 : wrapped;
}
constexpr double to_rad(double deg) {
  return deg * kPi / 180.0;
}
constexpr double to_deg(double rad) {
  return rad * 180.0 / kPi;
}

inline double yaw_rad_from_compass_deg(double heading_deg) {
  return wrap_rad(to_rad(90.0 - heading_deg));
}
inline double compass_deg_from_yaw_rad(double yaw_rad) {
  return wrap_deg(90.0 - to_deg(yaw_rad));
}

}  // namespace drover
