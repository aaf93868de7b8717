// How fast a base moves, or is to move.
#pragma once

#include <cmath>
#include <limits>

namespace drover {

/// Twist in base_link (REP 103): m/s ahead, rad/s counter-clockwise, m/s to the left.
struct Twist {
  double vx_mps = 0;
  double wz_radps = 0;
  double vy_mps = 0;  ///< 0 of every base that cannot go sideways
};

/// At rest, or told to be.
constexpr bool is_zero(const Twist& twist) {
  return twist.vx_mps == 0 && twist.wz_radps == 0 && twist.vy_mps == 0;
}

/// Slower has no way and no curve of its own: a gate's ramp to rest ends in it, and noise.
inline constexpr double kDrives_mps = 0.01;
/// Slower is no turn.
inline constexpr double kTurns_radps = 0.02;

inline bool drives(const Twist& twist) {
  return std::abs(twist.vx_mps) > kDrives_mps;
}

/// Part of its way leads aside.
inline bool goes_sideways(const Twist& twist) {
  return std::abs(twist.vy_mps) > kDrives_mps;
}

/// On the spot.
inline bool is_turn(const Twist& twist) {
  return !drives(twist) && !goes_sideways(twist) && std::abs(twist.wz_radps) > kTurns_radps;
}

/// What a base says of its motion, by its wheels or by itself, in its own axes: m/s along its x,
/// rad/s about its z, which is not the vertical on a slope. Nothing that was learned is in it.
struct BodyMotion {
  Twist twist;
  /// Of an error that keeps its sign for about a second: (m/s)^2, (rad/s)^2.
  double vx_var = 0;
  double wz_var = 0;
  double vy_var = 0;
  bool known = false;     ///< false: part of it is silent, the base may do anything
  bool standing = false;  ///< known, and all that turns is at rest
  /// Of a base that steers: the angle of a wheel in the middle of its steered axle, left positive,
  /// also at rest; not a number: it does not tell it.
  double steering_rad = std::numeric_limits<double>::quiet_NaN();
};

}  // namespace drover
