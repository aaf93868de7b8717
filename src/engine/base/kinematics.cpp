#include "engine/base/kinematics.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <numbers>

#include "engine/still.h"

namespace drover::engine {
namespace {

// Tyres of two sides, worn and loaded unlike each other.
constexpr double kTyreShare = 0.005;
// The gain of a skidding base differs between a wide curve and a turn on the spot.
constexpr double kSkiddingShare = 0.15;
constexpr double kRollingShare = 0.03;
// Wheels that roll in a turn: the gain is known as well as track and radii were measured, and
// stays; the base turns about the middle of its axle.
constexpr double kRollingGain = 0.03;       // one sigma
constexpr double kRollingGainWalk = 0.003;  // per square root of radian
constexpr double kRollingShift_m = 0.005;   // per square root of radian
constexpr double kRollingTurn_rad = 0.01;   // per square root of radian
// Wheels that are a degree beside what they are said to be steered to.
constexpr double kSteeringZero_rad = 0.017;
constexpr Time kFarFuture{Duration{INT64_MAX / 4}};

const TwoSides& sides_of(const Kinematics& base) {
  return std::visit([](const auto& kind) -> const TwoSides& { return kind.sides; }, base);
}

TwoSides edges(double width_m) {
  TwoSides sides;
  sides.wheel_radius_m = 1.0;
  sides.track_m = width_m;
  (void)sides.left.push_back(0);
  (void)sides.right.push_back(1);
  return sides;
}

/// What is as slow as an encoder at rest is rest, as for wheels.
BodyMotion at_rest(const Kinematics& base, BodyMotion motion) {
  motion.standing = motion.known && fastest_mps(base, motion.twist) < kEncoderRest_mps;
  if (motion.standing || !motion.known) motion.twist = {};
  return motion;
}

}  // namespace

TwoSides sides_of(const BaseConfig& base) {
  return {base.wheel_radius_m, base.track_m, base.left, base.right};
}

Kinematics kinematics_of(const BaseConfig& base) {
  switch (base.kind) {
    case BaseKind::differential: return Differential{sides_of(base)};
    case BaseKind::twist: return TwistBase{edges(base.track_m)};
    case BaseKind::ackermann:
      return Ackermann{edges(base.track_m), base.wheelbase_m, base.max_steering_rad,
                       base.steering_rate_radps};
    case BaseKind::mecanum: return mecanum_of(base);
    case BaseKind::skid_steer: break;
  }
  return SkidSteer{sides_of(base)};
}

BodyLimits limits(const Kinematics& base) {
  BodyLimits limits;
  limits.sideways = std::holds_alternative<Mecanum>(base);
  const auto* const steered = std::get_if<Ackermann>(&base);
  if (steered == nullptr) return limits;
  limits.pivots = false;
  limits.smallest_radius_m =
      steered->sides.track_m / 2 + steered->wheelbase_m / std::tan(steered->max_steering_rad);
  // By how much the inner wheel is steered for a change of the curve: wheelbase / ((1 - half track
  // * curvature)^2 + (wheelbase * curvature)^2), and most where that is least.
  const double wheelbase_m = steered->wheelbase_m;
  const double half_track_m = steered->sides.track_m / 2;
  limits.curvature_rate_radpms = steered->steering_rate_radps * wheelbase_m /
                                 (wheelbase_m * wheelbase_m + half_track_m * half_track_m);
  return limits;
}

bool rolls_in_turns(const Kinematics& base) {
  return std::holds_alternative<Differential>(base) || std::holds_alternative<Ackermann>(base);
}

double steered_wheelbase_m(const Kinematics& base) {
  const auto* const steered = std::get_if<Ackermann>(&base);
  return steered == nullptr ? 0 : steered->wheelbase_m;
}

double steering_rad(double wheelbase_m, double curvature_radpm) {
  return std::atan(wheelbase_m * curvature_radpm);
}

double curvature_radpm(double wheelbase_m, double steering_rad) {
  return std::tan(steering_rad) / wheelbase_m;
}

[[gnu::hot]] bool takes_twist(const Kinematics& base) {
  return std::holds_alternative<TwistBase>(base) || std::holds_alternative<Ackermann>(base);
}

const char* joint_unit(const Kinematics& base) {
  return takes_twist(base) ? "m/s" : "rad/s";  // the radius of an edge is a metre
}

JointVelocities edges_of(const Kinematics& base, const Twist& twist) {
  const WheelSpeeds speeds =
      wheels_from_twist(sides_of(base), 1.0, twist, std::numeric_limits<double>::infinity());
  JointVelocities mps;
  (void)mps.push_back(speeds.left_radps);  // their radius is a metre
  (void)mps.push_back(speeds.right_radps);
  return mps;
}

Twist twist_of_edges(const Kinematics& base, const JointVelocities& mps) {
  return twist_from_wheels(sides_of(base), 1.0, mps[0], mps[1]);
}

std::size_t joints_needed(const BaseConfig& base) {
  std::size_t needed = 0;
  if (takes_twist(base.kind)) return needed;
  for (const auto* side : {&base.left, &base.right})
    for (const AxisId id : *side) needed = std::max(needed, std::size_t{id} + 1);
  return needed;
}

JointSet joints_of(const Kinematics& base) {
  const TwoSides& sides = sides_of(base);
  JointSet joints;
  for (const auto* side : {&sides.left, &sides.right})
    for (const AxisId id : *side) joints.set(id);
  return joints;
}

JointVelocities setpoints(const Kinematics& base, const Twist& twist, const Learned& learned,
                          double max_rim_mps) {
  if (const auto* const rollers = std::get_if<Mecanum>(&base))
    return setpoints(*rollers, twist, learned.yaw_slip_factor, max_rim_mps);
  const TwoSides& sides = sides_of(base);
  Twist drivable = twist;
  if (const BodyLimits body = limits(base); !body.pivots && std::isfinite(twist.wz_radps)) {
    const double most_radps = std::abs(twist.vx_mps) * body.most_radpm() / learned.yaw_slip_factor;
    drivable.wz_radps = std::clamp(twist.wz_radps, -most_radps, most_radps);
  }
  const WheelSpeeds speeds =
      wheels_from_twist(sides, learned.yaw_slip_factor, drivable, max_rim_mps);
  JointVelocities radps;
  for (const auto* side : {&sides.left, &sides.right})
    for (const AxisId id : *side) radps.resize(std::max(radps.size(), std::size_t{id} + 1));
  for (const AxisId id : sides.left) radps[id] = speeds.left_radps;
  for (const AxisId id : sides.right) radps[id] = speeds.right_radps;
  return radps;
}

Twist largest_twist(const Kinematics& base, const JointVelocities& radps, const Learned& learned) {
  return largest_twist(sides_of(base), learned.yaw_slip_factor, radps);
}

Twist twist_of(const Kinematics& base, const JointVelocities& radps, const Learned& learned) {
  const TwoSides& sides = sides_of(base);
  const auto mean_mps = [&](std::span<const AxisId> wheels) {
    double sum_radps = 0;
    for (const AxisId id : wheels) sum_radps += id < radps.size() ? radps[id] : 0.0;
    return sum_radps * sides.wheel_radius_m / static_cast<double>(wheels.size());
  };
  if (sides.left.empty() || sides.right.empty()) return {};
  Twist twist = twist_from_wheels(sides, learned.yaw_slip_factor, mean_mps(sides.left),
                                  mean_mps(sides.right));
  if (const auto* const rollers = std::get_if<Mecanum>(&base))
    twist.vy_mps = sideways_mps(*rollers, radps);
  return twist;
}

BodyMotion body_motion(const Kinematics& base, const Told& told, Time at, Duration stale) {
  if (takes_twist(base))
    return at - told.body_at <= stale ? at_rest(base, told.body) : BodyMotion{};
  if (const auto* const rollers = std::get_if<Mecanum>(&base))
    return body_motion(*rollers, told.joints, at, stale);
  return body_motion(sides_of(base), told.joints, at, stale);
}

Time next_stale(const Told& told, Time at, Duration stale) {
  Time next = kFarFuture;
  for (const JointMotion& joint : told.joints) {
    if (at - joint.at <= stale) next = std::min(next, joint.at + stale + Duration{1});
  }
  if (at - told.body_at <= stale) next = std::min(next, told.body_at + stale + Duration{1});
  return next;
}

[[gnu::hot]] double rim_mps(const Kinematics& base, double radps) {
  return radps * sides_of(base).wheel_radius_m;
}

double joint_radps(const Kinematics& base, double rim_mps) {
  return rim_mps / sides_of(base).wheel_radius_m;
}

EstimateConfig tuned(const Kinematics& base, const EstimateConfig& config) {
  EstimateConfig own = config;
  if (!rolls_in_turns(base)) return own;
  own.yaw_slip_sigma = std::min(own.yaw_slip_sigma, kRollingGain);
  own.yaw_slip_walk = std::min(own.yaw_slip_walk, kRollingGainWalk);
  own.turning_shift_m = std::min(own.turning_shift_m, kRollingShift_m);
  own.turning_yaw_rad = std::min(own.turning_yaw_rad, kRollingTurn_rad);
  return own;
}

TurnErrors turn_errors(const Kinematics& base) {
  const auto* const steered = std::get_if<Ackermann>(&base);
  const double pull_radpm = steered != nullptr ? kSteeringZero_rad / steered->wheelbase_m
                                               : kTyreShare / sides_of(base).track_m;
  return {pull_radpm, rolls_in_turns(base) ? kRollingShare : kSkiddingShare};
}

double track_of_turn_m(const Kinematics& base) {
  return sides_of(base).track_m;
}

double fastest_mps(const Kinematics& base, const Twist& twist) {
  return std::abs(twist.vx_mps) + sides_of(base).track_m / 2 * std::abs(twist.wz_radps) +
         std::abs(twist.vy_mps);
}

double max_rim_mps(const Kinematics& base, const LimitsConfig& limits, const Learned& learned) {
  // Straight ahead rims are as fast as the base; in between ahead and aside two of them are faster.
  const double share = std::holds_alternative<Mecanum>(base) ? std::numbers::sqrt2 : 1.0;
  return share * limits.max_speed_mps +
         0.5 * sides_of(base).track_m * learned.yaw_slip_factor * limits.max_yaw_rate_radps;
}

}  // namespace drover::engine
