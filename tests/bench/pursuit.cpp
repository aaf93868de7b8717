// Two common path followers, to have something to compare the tracker with.
#include "bench/pursuit.h"

#include <algorithm>
#include <cmath>

namespace drover::bench {

using track::Vector;

namespace {

/// The place is looked for so far along the way from the last one: a track that crosses itself does
/// not confuse them.
constexpr double kSearch_m = 1.0;
constexpr double kArrived_m = 0.02;

}  // namespace

Pursuit::Pursuit(const PursuitConfig& config, const engine::LimitsConfig& limits,
                 double braking_fraction, const Path& path, double speed_mps)
    : config_(config),
      limits_(limits),
      braking_mps2_(braking_fraction * limits.deceleration_mps2),
      path_(path),
      speed_mps_(std::min(speed_mps, limits.max_speed_mps)) {
  for (std::size_t k = 0; k + 1 < path.points.size(); ++k) length_m_ += segment_m(k);
}

double Pursuit::segment_m(std::size_t k) const {
  return std::hypot(path_.points[k + 1].x_m - path_.points[k].x_m,
                    path_.points[k + 1].y_m - path_.points[k].y_m);
}

Vector Pursuit::at(const Place& place) const {
  const PathPoint& a = path_.points[place.segment];
  const PathPoint& b = path_.points[place.segment + 1];
  const double share = place.along_m / std::max(segment_m(place.segment), 1e-9);
  return {a.x_m + share * (b.x_m - a.x_m), a.y_m + share * (b.y_m - a.y_m)};
}

/// Never back: of two equally near places at a corner it takes the later one.
void Pursuit::move_on(Vector robot) {
  Place best = place_;
  double best_m = length(robot - at(place_));
  double best_passed_m = passed_m_;
  double passed_m = passed_m_;
  for (std::size_t k = place_.segment; k + 1 < path_.points.size(); ++k) {
    if (passed_m > passed_m_ + place_.along_m + kSearch_m) break;
    const PathPoint& a = path_.points[k];
    const PathPoint& b = path_.points[k + 1];
    const Vector ab{b.x_m - a.x_m, b.y_m - a.y_m};
    const double ab_m = length(ab);
    double along_m = ab_m > 0 ? dot(robot - Vector{a.x_m, a.y_m}, ab) / ab_m : 0;
    along_m = std::clamp(along_m, k == place_.segment ? place_.along_m : 0.0, ab_m);
    const Place here{k, along_m};
    const double away_m = length(robot - at(here));
    if (away_m <= best_m + 1e-9) {
      best = here;
      best_m = away_m;
      best_passed_m = passed_m;
    }
    passed_m += ab_m;
  }
  place_ = best;
  passed_m_ = best_passed_m;
}

double Pursuit::left_m() const {
  return length_m_ - passed_m_ - place_.along_m;
}

/// Where the line leaves the circle about the robot.
Vector Pursuit::carrot(Vector robot, double lookahead_m) const {
  Place from = place_;
  for (std::size_t k = place_.segment; k + 1 < path_.points.size(); ++k) {
    const PathPoint& end = path_.points[k + 1];
    const bool last = k + 2 == path_.points.size();
    if (last || length(Vector{end.x_m, end.y_m} - robot) >= lookahead_m) {
      // |a + t u - robot| = lookahead, the later of the two.
      const Vector a = at(from);
      const Vector b{end.x_m, end.y_m};
      const Vector u = unit(b - a, unit(b - Vector{path_.points[k].x_m, path_.points[k].y_m}, {}));
      const Vector off = a - robot;
      const double middle = -dot(off, u);
      const double inside_m2 = middle * middle - dot(off, off) + lookahead_m * lookahead_m;
      return a + std::max(middle + std::sqrt(std::max(inside_m2, 0.0)), 0.0) * u;
    }
    from = {k + 1, 0};
  }
  return at(place_);
}

test::Steered Pursuit::steer(const Pose& pose) {
  const Vector robot{pose.x_m, pose.y_m};
  move_on(robot);
  const double left = left_m();
  if (left <= kArrived_m) return {{}, true};
  const double lookahead_m = std::clamp(config_.lookahead_s * std::max(pose.vx_mps, 0.0),
                                        config_.min_lookahead_m, config_.max_lookahead_m);
  const Vector to = carrot(robot, lookahead_m) - robot;
  const double ahead_m = to.x * std::cos(pose.yaw_rad) + to.y * std::sin(pose.yaw_rad);
  const double aside_m = -to.x * std::sin(pose.yaw_rad) + to.y * std::cos(pose.yaw_rad);
  const double curvature_radpm = 2 * aside_m / std::max(dot(to, to), 1e-6);

  constexpr double kCreep_mps = 0.1;
  double vx_mps = std::min(
      speed_mps_, std::sqrt(kCreep_mps * kCreep_mps + 2 * braking_mps2_ * std::max(left, 0.0)));
  if (config_.regulated) {
    const double angle_rad = std::atan2(aside_m, ahead_m);
    if (std::abs(angle_rad) > config_.rotate_angle_rad) {
      const double rate_radps = std::min({config_.rotate_radps, limits_.max_yaw_rate_radps});
      return {{0, std::copysign(rate_radps, angle_rad)}, false};
    }
    const double radius_m = 1 / std::max(std::abs(curvature_radpm), 1e-6);
    if (radius_m < config_.slow_radius_m)
      vx_mps = std::min(vx_mps, std::max(speed_mps_ * radius_m / config_.slow_radius_m,
                                         std::min(config_.slowest_mps, speed_mps_)));
    if (left < config_.approach_m)
      vx_mps = std::min(
          vx_mps, std::max(speed_mps_ * left / config_.approach_m, config_.slowest_approach_mps));
  }
  const double rolling_mps =
      std::max(pose.vx_mps + std::clamp(vx_mps - pose.vx_mps, -0.1, 0.1), 0.0);
  const double most_radps = limits_.max_yaw_rate_radps;
  return {{vx_mps, std::clamp(rolling_mps * curvature_radpm, -most_radps, most_radps)}, false};
}

}  // namespace drover::bench
