#include "engine/base/mecanum.h"

#include <algorithm>
#include <cmath>

#include "engine/still.h"

namespace drover::engine {
namespace {

// An assumption, as no maker tells it: of a way to the side rollers lose or win a tenth (one
// sigma), by their own friction, their edges and how the load is spread.
constexpr double kRollerSlip = 0.1;

/// The four wheels, and which way each adds to a way to the left.
struct Corner {
  AxisId joint = 0;
  bool on_left = false;
  double aside = 0;
};

std::array<Corner, 4> corners_of(const Mecanum& base) {
  const auto& [radius, track, left, right] = base.sides;
  return {{{left[0], true, -1}, {right[0], false, 1}, {left[1], true, 1}, {right[1], false, -1}}};
}

bool complete(const Mecanum& base) {
  return base.sides.left.size() == 2 && base.sides.right.size() == 2;
}

}  // namespace

Mecanum mecanum_of(const BaseConfig& base) {
  return {{base.wheel_radius_m, base.track_m + base.wheelbase_m, base.left, base.right}};
}

FixedVector<double, kMaxAxes> setpoints(const Mecanum& base, const Twist& twist,
                                        double yaw_slip_factor, double max_rim_mps) {
  FixedVector<double, kMaxAxes> radps;
  for (const auto* side : {&base.sides.left, &base.sides.right})
    for (const AxisId id : *side) radps.resize(std::max(radps.size(), std::size_t{id} + 1));
  if (!complete(base)) return radps;
  const double turn_mps = 0.5 * base.sides.track_m * yaw_slip_factor * twist.wz_radps;
  const double fastest_mps = std::abs(twist.vx_mps) + std::abs(twist.vy_mps) + std::abs(turn_mps);
  // Fails closed, as with wheels of two sides.
  if (!std::isfinite(fastest_mps) || !(max_rim_mps > 0) || !(base.sides.wheel_radius_m > 0))
    return radps;
  const double share = std::min(1.0, max_rim_mps / std::max(fastest_mps, max_rim_mps));
  for (const Corner& corner : corners_of(base)) {
    const double rim_mps =
        twist.vx_mps + (corner.on_left ? -turn_mps : turn_mps) + corner.aside * twist.vy_mps;
    radps[corner.joint] = share * rim_mps / base.sides.wheel_radius_m;
  }
  return radps;
}

double sideways_mps(const Mecanum& base, std::span<const double> radps) {
  double sum_radps = 0;
  if (!complete(base)) return 0;
  for (const Corner& corner : corners_of(base))
    if (corner.joint < radps.size()) sum_radps += corner.aside * radps[corner.joint];
  return sum_radps * base.sides.wheel_radius_m / 4;
}

BodyMotion body_motion(const Mecanum& base, const JointMotions& joints, Time at, Duration stale) {
  BodyMotion motion;
  if (!complete(base)) return motion;
  double left_mps = 0;
  double right_mps = 0;
  double aside_mps = 0;
  double against_mps = 0;  // front wheels against rear ones: no motion does that
  bool rest = true;
  for (const Corner& corner : corners_of(base)) {
    if (corner.joint >= joints.size() || at - joints[corner.joint].at > stale) return motion;
    const double rim_mps = joints[corner.joint].velocity_radps * base.sides.wheel_radius_m;
    (corner.on_left ? left_mps : right_mps) += rim_mps / 2;
    aside_mps += corner.aside * rim_mps / 4;
    against_mps += (corner.on_left ? -1 : 1) * corner.aside * rim_mps / 4;
    rest = rest && std::abs(rim_mps) < kEncoderRest_mps;
  }
  motion.known = true;
  motion.standing = rest;
  if (rest) return motion;
  motion.twist = twist_from_wheels(base.sides, 1.0, left_mps, right_mps);
  motion.twist.vy_mps = aside_mps;
  // One wheel that is wrong by four of it makes so much of each part.
  motion.vx_var = against_mps * against_mps;
  motion.wz_var = 4 * motion.vx_var / (base.sides.track_m * base.sides.track_m);
  motion.vy_var = motion.vx_var + kRollerSlip * kRollerSlip * aside_mps * aside_mps;
  return motion;
}

}  // namespace drover::engine
