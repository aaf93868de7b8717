// Where on a whole path a robot begins: the only search that looks at every point.
#include "engine/navigate/path_search.h"

#include <algorithm>

#include "drover/angle.h"

namespace drover::engine {
namespace {

constexpr double kAboutAsNear_m = 0.3;
constexpr double kAsNear_m = 0.1;
constexpr double kAboutAsTurned_rad = 10 * kPi / 180;
constexpr double kSameStretch_cos = 0.5;  // within 60 degrees: one leg, not two
constexpr double kAtTarget_m = 0.5;

struct Foot {
  double along_m = 0;
  double distance_m = 0;
  double segment_m = 0;
  Vector direction;
};

Foot foot_on(Vector a, Vector b, Vector at) {
  Foot foot;
  foot.segment_m = length(b - a);
  if (foot.segment_m <= 0) {
    foot.distance_m = length(at - a);
    return foot;
  }
  foot.direction = 1 / foot.segment_m * (b - a);
  foot.along_m = std::clamp(dot(at - a, foot.direction), 0.0, foot.segment_m);
  foot.distance_m = length(at - (a + foot.along_m * foot.direction));
  return foot;
}

Vector vector(const PathPoint& p) { return {p.x_m, p.y_m}; }

/// The nearest place of one leg that passes close by.
struct Candidate {
  PathStart start;
  double distance_m = INFINITY;
  double turned_rad = INFINITY;
  double left_m = 0;
};

bool better(const Candidate& a, const Candidate& b) {
  if (a.turned_rad < b.turned_rad - kAboutAsTurned_rad) return true;
  if (b.turned_rad < a.turned_rad - kAboutAsTurned_rad) return false;
  const bool a_at_target = a.left_m < kAtTarget_m;
  const bool b_at_target = b.left_m < kAtTarget_m;
  if (a_at_target != b_at_target) return b_at_target;
  // The same place passed twice the same way: the first pass, so that nothing is left out.
  if (std::abs(a.distance_m - b.distance_m) < kAsNear_m) return a.left_m > b.left_m;
  return a.distance_m < b.distance_m;
}

}  // namespace

PathStart find_start(std::span<const PathPoint> points, std::size_t target, Vector at,
                     double yaw_rad) {
  double least_m = INFINITY;
  double target_m = 0;
  double s_m = 0;
  for (std::size_t k = 0; k + 1 < points.size(); ++k) {
    const Foot foot = foot_on(vector(points[k]), vector(points[k + 1]), at);
    least_m = std::min(least_m, foot.distance_m);
    if (k == target) target_m = s_m;
    s_m += foot.segment_m;
  }
  if (target + 1 >= points.size()) target_m = s_m;

  Candidate best;
  Candidate leg;
  Vector leg_direction;
  bool in_leg = false;
  s_m = 0;
  for (std::size_t k = 0; k + 1 < points.size(); ++k) {
    const Foot foot = foot_on(vector(points[k]), vector(points[k + 1]), at);
    const double start_m = s_m;
    s_m += foot.segment_m;
    if (foot.segment_m <= 0) continue;
    const bool near = foot.distance_m <= least_m + kAboutAsNear_m;
    const bool goes_on = in_leg && near && k != target &&
                         dot(foot.direction, leg_direction) > kSameStretch_cos;
    if (in_leg && !goes_on) {
      if (better(leg, best)) best = leg;
      in_leg = false;
    }
    if (!near) continue;
    if (!in_leg) {
      in_leg = true;
      leg = {};
      leg_direction = foot.direction;
    }
    if (foot.distance_m >= leg.distance_m) continue;
    const bool forwards = k < target;
    const Vector travel = (forwards ? 1.0 : -1.0) * foot.direction;
    leg.start = {k, foot.along_m, forwards};
    leg.distance_m = foot.distance_m;
    leg.turned_rad = std::abs(wrap_rad(std::atan2(travel.y, travel.x) - yaw_rad));
    leg.left_m = std::abs(target_m - (start_m + foot.along_m));
  }
  if (in_leg && better(leg, best)) best = leg;
  return best.start;
}

}  // namespace drover::engine
