// Where on a whole path a robot begins: the only search that looks at every point.
#include "track/path_search.h"

#include <algorithm>

#include "drover/angle.h"

namespace drover::track {
namespace {

constexpr double kAboutAsNear_m = 0.3;
constexpr double kAsNear_m = 0.1;
constexpr double kAboutAsTurned_rad = 10 * kPi / 180;
constexpr double kSameStretch_cos = 0.5;  // within 60 degrees: one leg, not two
constexpr double kAtTarget_m = 0.5;
constexpr double kClosed_m = 0.3;

/// The place on a segment nearest to a point. Squares only: this runs for every segment.
struct Foot {
  Vector segment;
  double share = 0;  ///< of the segment, 0..1
  double distance_m2 = 0;
};

inline Foot foot_on(Vector a, Vector b, Vector at) {
  const Vector ab = b - a;
  const double ab_m2 = dot(ab, ab);
  const double share = ab_m2 > 0 ? std::clamp(dot(at - a, ab) / ab_m2, 0.0, 1.0) : 0.0;
  const Vector off = at - a - share * ab;
  return {ab, share, dot(off, off)};
}

Vector vector(const PathPoint& p) {
  return {p.x_m, p.y_m};
}

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
                     double yaw_rad, const Gears& gears) {
  double least_m2 = INFINITY;
  double target_m = 0;
  double s_m = 0;
  for (std::size_t k = 0; k + 1 < points.size(); ++k) {
    const Foot foot = foot_on(vector(points[k]), vector(points[k + 1]), at);
    least_m2 = std::min(least_m2, foot.distance_m2);
    s_m += length(foot.segment);
    if (k < target) target_m = s_m;
  }
  const double near_m = std::sqrt(least_m2) + kAboutAsNear_m;

  Candidate best;
  Candidate leg;
  Vector leg_direction;
  bool in_leg = false;
  s_m = 0;
  for (std::size_t k = 0; k + 1 < points.size(); ++k) {
    const Foot foot = foot_on(vector(points[k]), vector(points[k + 1]), at);
    const double segment_m = length(foot.segment);
    const double start_m = s_m;
    s_m += segment_m;
    if (segment_m <= 0) continue;
    const bool near = foot.distance_m2 <= near_m * near_m;
    if (!near && !in_leg) continue;
    const Vector direction = 1 / segment_m * foot.segment;
    const bool goes_on =
        in_leg && near && k != target && dot(direction, leg_direction) > kSameStretch_cos;
    if (in_leg && !goes_on) {
      if (better(leg, best)) best = leg;
      in_leg = false;
    }
    if (!near) continue;
    if (!in_leg) {
      in_leg = true;
      leg = {};
      leg_direction = direction;
    }
    const double distance_m = std::sqrt(foot.distance_m2);
    if (distance_m >= leg.distance_m) continue;
    const bool forwards = k < target;
    const Vector travel = (forwards ? 1.0 : -1.0) * direction;
    const double along_m = foot.share * segment_m;
    leg.start = {k, along_m, 0, forwards};
    leg.distance_m = distance_m;
    leg.turned_rad = std::abs(wrap_rad(std::atan2(travel.y, travel.x) - yaw_rad));
    if (k < gears.backwards.size() && gears.backwards[k] != 0)
      leg.turned_rad = kPi - leg.turned_rad;
    leg.start.flipped = gears.either && leg.turned_rad > kPi / 2;
    if (leg.start.flipped) leg.turned_rad = kPi - leg.turned_rad;
    leg.left_m = std::abs(target_m - (start_m + along_m));
  }
  if (in_leg && better(leg, best)) best = leg;
  best.start.left_m = best.left_m;
  best.start.turned_rad = best.turned_rad;
  return best.start;
}

bool is_closed(std::span<const PathPoint> points) {
  return points.size() >= 3 && length(vector(points.back()) - vector(points.front())) <= kClosed_m;
}

std::size_t target_ahead(std::span<const PathPoint> points, std::size_t target, Vector at,
                         double yaw_rad, const Gears& gears) {
  const std::size_t last = points.size() - 1;
  if (target != 0 && target != last) return target;
  if (!is_closed(points) || length(vector(points[target]) - at) <= kAsNear_m) return target;
  const std::size_t other = last - target;
  const bool behind = find_start(points, target, at, yaw_rad, gears).turned_rad > kPi / 2;
  const bool ahead = find_start(points, other, at, yaw_rad, gears).turned_rad < kPi / 2;
  return behind && ahead ? other : target;
}

}  // namespace drover::track
