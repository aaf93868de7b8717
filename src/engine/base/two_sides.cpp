#include "engine/base/two_sides.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <span>

#include "engine/still.h"

namespace drover::engine {

WheelSpeeds wheels_from_twist(const TwoSides& sides, double yaw_slip_factor, const Twist& twist,
                              double max_wheel_mps) {
  const double turn_mps = 0.5 * sides.track_m * yaw_slip_factor * twist.wz_radps;
  double left_mps = twist.vx_mps - turn_mps;
  double right_mps = twist.vx_mps + turn_mps;
  const double fastest_mps = std::max(std::abs(left_mps), std::abs(right_mps));
  // Fails closed: what is not a number, and a limit that permits nothing, is a stop.
  if (!std::isfinite(left_mps) || !std::isfinite(right_mps) || !(max_wheel_mps > 0) ||
      !(sides.wheel_radius_m > 0)) {
    return {};
  }
  if (fastest_mps > max_wheel_mps) {
    left_mps *= max_wheel_mps / fastest_mps;
    right_mps *= max_wheel_mps / fastest_mps;
  }
  return {left_mps / sides.wheel_radius_m, right_mps / sides.wheel_radius_m};
}

Twist twist_from_wheels(const TwoSides& sides, double yaw_slip_factor, double left_mps,
                        double right_mps) {
  return {0.5 * (left_mps + right_mps), (right_mps - left_mps) / (sides.track_m * yaw_slip_factor)};
}

namespace {

/// What a silent wheel may turn otherwise than its neighbours, on ground that holds them unlike.
constexpr double kUnheardShare = 0.1;
constexpr double kFar = std::numeric_limits<double>::infinity();

/// What the wheels of one side say.
struct Side {
  double sum_mps = 0;
  double low_mps = 0;
  double high_mps = 0;
  int count = 0;
  bool silent = false;  ///< at least one is
  bool rest = true;

  void add(double rim_mps) {
    low_mps = count == 0 ? rim_mps : std::min(low_mps, rim_mps);
    high_mps = count == 0 ? rim_mps : std::max(high_mps, rim_mps);
    sum_mps += rim_mps;
    rest = rest && std::abs(rim_mps) < kEncoderRest_mps;
    ++count;
  }
  double mean_mps() const { return sum_mps / count; }
  double spread_mps() const {
    const double heard_mps = (high_mps - low_mps) / 2;
    return silent ? std::max(heard_mps, kUnheardShare * std::abs(mean_mps())) : heard_mps;
  }
};

Side side_of(std::span<const AxisId> wheels, double wheel_radius_m, const JointMotions& joints,
             Time at, Duration stale) {
  Side side;
  for (const AxisId id : wheels) {
    if (id < joints.size() && at - joints[id].at <= stale) {
      side.add(joints[id].velocity_radps * wheel_radius_m);
    } else {
      side.silent = true;
    }
  }
  return side;
}

}  // namespace

BodyMotion body_motion(const TwoSides& sides, const JointMotions& joints, Time at, Duration stale) {
  const Side left = side_of(sides.left, sides.wheel_radius_m, joints, at, stale);
  const Side right = side_of(sides.right, sides.wheel_radius_m, joints, at, stale);
  BodyMotion motion;
  motion.known = left.count > 0 && right.count > 0;
  if (!motion.known) return motion;
  motion.standing = left.rest && right.rest;
  if (motion.standing) return motion;
  motion.twist = twist_from_wheels(sides, 1.0, left.mean_mps(), right.mean_mps());
  const double spread_mps = std::max(left.spread_mps(), right.spread_mps());
  motion.vx_var = spread_mps * spread_mps;
  motion.wz_var = motion.vx_var / (sides.track_m * sides.track_m);
  return motion;
}

Twist largest_twist(const TwoSides& sides, double yaw_slip_factor, std::span<const double> radps) {
  Twist largest;
  if (sides.left.empty() || sides.right.empty()) return largest;
  // What is largest is made by the outermost of each side: no need to try all pairs.
  const auto ends = [&](std::span<const AxisId> wheels) {
    std::array<double, 2> mps{kFar, -kFar};
    for (const AxisId id : wheels) {
      const double rim_mps = radps[id] * sides.wheel_radius_m;
      mps = {std::min(mps[0], rim_mps), std::max(mps[1], rim_mps)};
    }
    return mps;
  };
  const auto lefts_mps = ends(sides.left);
  const auto rights_mps = ends(sides.right);
  for (const double left_mps : lefts_mps) {
    for (const double right_mps : rights_mps) {
      const Twist twist = twist_from_wheels(sides, yaw_slip_factor, left_mps, right_mps);
      largest.vx_mps = std::max(largest.vx_mps, std::abs(twist.vx_mps));
      largest.wz_radps = std::max(largest.wz_radps, std::abs(twist.wz_radps));
    }
  }
  return largest;
}

}  // namespace drover::engine
