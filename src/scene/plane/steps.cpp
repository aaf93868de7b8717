#include "scene/plane/steps.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace drover::scene {
namespace {

/// More steps than this are made longer instead.
constexpr double kMostSteps = 100'000;
constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();

}  // namespace

std::vector<Step> unknown_way(const Pose2& from) {
  return {{from, 0, 0}, {{kNaN, kNaN, kNaN}, 0, 0}};
}

double stride_m(const Piece& footprint) {
  const double reach_m = length_m(footprint.around.centre) + footprint.around.radius_m;
  return std::clamp(0.25 * reach_m, 0.02, 0.25);
}

Pose2 between(const Pose2& from, const Pose2& to, double part) {
  const double turn_rad = wrap_rad(to.yaw_rad - from.yaw_rad);
  const Point2 chord = place_of(to) - place_of(from);
  // On an arc the chord to a part of it turns by half of what is left, and is longer than its part.
  const double half = 0.5 * turn_rad;
  const double share = std::abs(half) < 1e-9 ? part : std::sin(part * half) / std::sin(half);
  const Point2 turned = direction(half * (part - 1));
  return {from.x_m + share * (turned.x_m * chord.x_m - turned.y_m * chord.y_m),
          from.y_m + share * (turned.y_m * chord.x_m + turned.x_m * chord.y_m),
          from.yaw_rad + part * turn_rad};
}

std::vector<Step> arc_steps(const Pose2& from, double length_m, double turn_rad, double stride_m) {
  if (!is_finite(from) || !std::isfinite(length_m) || !std::isfinite(turn_rad))
    return unknown_way(from);
  const double whole = std::min(1.0, 2 * kPi / std::max(std::abs(turn_rad), 1e-9));
  length_m *= whole;
  turn_rad *= whole;
  // Exactly three degrees more than twice are two steps.
  const double needed = std::max(std::abs(length_m) / std::max(stride_m, 1e-3),
                                 std::abs(turn_rad) / kStepTurn_rad - 1e-9);
  const int count = static_cast<int>(std::clamp(std::ceil(needed), 1.0, kMostSteps));
  std::vector<Step> steps{{from, 0, 0}};
  steps.reserve(static_cast<std::size_t>(count) + 1);
  for (int i = 1; i <= count; ++i) {
    const double part = static_cast<double>(i) / count;
    const double half = 0.5 * part * turn_rad;
    const double chord_m = part * length_m * (std::abs(half) < 1e-9 ? 1 : std::sin(half) / half);
    const Point2 ahead = direction(from.yaw_rad + half);
    steps.push_back(
        {{from.x_m + chord_m * ahead.x_m, from.y_m + chord_m * ahead.y_m, from.yaw_rad + 2 * half},
         std::abs(part * length_m),
         std::abs(part * turn_rad)});
  }
  return steps;
}

std::vector<Step> twist_steps(const Pose2& from, double v_mps, double wz_radps, double length_m,
                              double stride_m) {
  if (!std::isfinite(v_mps) || !std::isfinite(wz_radps) || !std::isfinite(length_m))
    return unknown_way(from);
  const double time_s = std::abs(length_m / v_mps);
  if (!std::isfinite(time_s)) return {{from, 0, 0}};
  return arc_steps(from, v_mps * time_s, wz_radps * time_s, stride_m);
}

std::vector<Step> pivot_steps(const Pose2& from, double turn_rad) {
  return arc_steps(from, 0, turn_rad, 1);
}

}  // namespace drover::scene
