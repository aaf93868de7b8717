#include "scene/keeper/track_start.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "drover/angle.h"
#include "scene/keeper/way_line.h"

namespace drover::scene {
namespace {

// As the engine has them.
constexpr double kAboutAsNear_m = 0.3;
constexpr double kAsNear_m = 0.1;
constexpr double kAboutAsTurned_rad = to_rad(10.0);
constexpr double kSameStretch_cos = 0.5;
constexpr double kAtTarget_m = 0.5;
constexpr double kClosed_m = 0.3;
constexpr double kLongestGap_m = 1000;
constexpr double kSamePoint_m = 1e-3;

constexpr double kNowhere_m = std::numeric_limits<double>::infinity();

/// The nearest place of a stretch that passes close by.
struct StartPlace {
  std::size_t segment = 0;  ///< by its first point in the list
  double along_m = 0;       ///< from there towards the end of the list
  bool forwards = true;
  double away_m = kNowhere_m;
  double turned_rad = kNowhere_m;
  double left_m = 0;
};

bool is_better(const StartPlace& a, const StartPlace& b) {
  if (a.turned_rad < b.turned_rad - kAboutAsTurned_rad) return true;
  if (b.turned_rad < a.turned_rad - kAboutAsTurned_rad) return false;
  const bool a_at_target = a.left_m < kAtTarget_m;
  const bool b_at_target = b.left_m < kAtTarget_m;
  if (a_at_target != b_at_target) return b_at_target;
  if (std::abs(a.away_m - b.away_m) < kAsNear_m) return a.left_m > b.left_m;
  return a.away_m < b.away_m;
}

struct FootOnSide {
  Point2 side;
  double share = 0;
  double away2 = 0;
};
FootOnSide foot_on(const Path& path, std::size_t segment, Point2 at) {
  const Point2 from = point_of(path, segment);
  const Point2 side = point_of(path, segment + 1) - from;
  const double length2 = squared(side);
  const double share = length2 > 0 ? std::clamp(dot(at - from, side) / length2, 0.0, 1.0) : 0.0;
  return {side, share, squared(at - from - share * side)};
}

/// Looks at every segment.
StartPlace find_place(const Path& path, std::size_t target, const Pose2& pose) {
  const Point2 at = place_of(pose);
  const std::size_t segments = path.points.size() - 1;
  double least2 = kNowhere_m;
  double target_m = 0;
  for (std::size_t k = 0; k < segments; ++k) {
    const FootOnSide foot = foot_on(path, k, at);
    least2 = std::min(least2, foot.away2);
    if (k < target) target_m += length_m(foot.side);
  }
  const double near_m = std::sqrt(least2) + kAboutAsNear_m;
  StartPlace best;
  StartPlace stretch;
  Point2 stretch_direction;
  bool in_stretch = false;
  double end_m = 0;
  for (std::size_t k = 0; k < segments; ++k) {
    const FootOnSide foot = foot_on(path, k, at);
    const double side_m = length_m(foot.side);
    const double begin_m = end_m;
    end_m += side_m;
    if (side_m <= 0) continue;
    const bool near = foot.away2 <= near_m * near_m;
    const Point2 direction = 1 / side_m * foot.side;
    const bool goes_on =
        in_stretch && near && k != target && dot(direction, stretch_direction) > kSameStretch_cos;
    if (in_stretch && !goes_on) {
      if (is_better(stretch, best)) best = stretch;
      in_stretch = false;
    }
    if (!near) continue;
    if (!in_stretch) {
      in_stretch = true;
      stretch = {};
      stretch_direction = direction;
    }
    const double away_m = std::sqrt(foot.away2);
    if (away_m >= stretch.away_m) continue;
    const bool forwards = k < target;
    const Point2 travel = (forwards ? 1.0 : -1.0) * direction;
    const double along_m = foot.share * side_m;
    stretch = {k,
               along_m,
               forwards,
               away_m,
               std::abs(wrap_rad(std::atan2(travel.y_m, travel.x_m) - pose.yaw_rad)),
               std::abs(target_m - (begin_m + along_m))};
  }
  if (in_stretch && is_better(stretch, best)) best = stretch;
  return best;
}

/// The target's other end of a closed loop, where the way to that is the one ahead.
std::size_t target_ahead(const Path& path, std::size_t target, const Pose2& pose) {
  const std::size_t last = path.points.size() - 1;
  if (target != 0 && target != last) return target;
  const bool closed =
      path.points.size() >= 3 && length_m(point_of(path, last) - point_of(path, 0)) <= kClosed_m;
  if (!closed || length_m(point_of(path, target) - place_of(pose)) <= kAsNear_m) return target;
  const std::size_t other = last - target;
  const bool behind = find_place(path, target, pose).turned_rad > kPi / 2;
  const bool ahead = find_place(path, other, pose).turned_rad < kPi / 2;
  return behind && ahead ? other : target;
}

}  // namespace

bool is_track(const Path& path, std::size_t target) {
  if (path.points.size() < 2 || target >= path.points.size()) return false;
  bool has_length = false;
  for (std::size_t i = 0; i < path.points.size(); ++i) {
    if (!is_finite(point_of(path, i))) return false;
    const double gap2 = i == 0 ? 0 : squared(point_of(path, i) - point_of(path, i - 1));
    if (!(gap2 < kLongestGap_m * kLongestGap_m)) return false;
    has_length = has_length || gap2 > kSamePoint_m * kSamePoint_m;
  }
  return has_length;
}

WayLeft way_of_start(const Path& path, std::size_t target, const Pose2& pose) {
  const std::size_t goal = target_ahead(path, target, pose);
  const StartPlace place = find_place(path, goal, pose);
  WayLeft way;
  way.path = path.number;
  way.forwards = place.forwards;
  way.target = static_cast<std::uint32_t>(goal);
  way.segment = static_cast<std::uint32_t>(place.forwards ? place.segment : place.segment + 1);
  way.along_m = place.along_m;
  if (!place.forwards)
    way.along_m =
        length_m(point_of(path, place.segment + 1) - point_of(path, place.segment)) - place.along_m;
  return way;
}

}  // namespace drover::scene
