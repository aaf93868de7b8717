// A route from one true corner to the next.
#include "track/legs.h"

#include <algorithm>
#include <cmath>

#include "track/line_end.h"

namespace drover::track {
namespace {

constexpr double kCornerSpread_m = 0.3;  // points this close belong to one corner
constexpr double kFold_m = 0.3;          // a longer step back is meant
constexpr double kFoldSpread_m = 0.6;    // there and back, as far as chords see its ends

}  // namespace

Leg leg_to_target(const Route& route, std::size_t first, double first_m, double end_m) {
  const std::size_t last = route.size() - 1;
  const Vector fallback = unit(route.point(last) - route.point(first), {1, 0});
  Leg leg;
  leg.first = first;
  leg.last = last;
  leg.first_m = first_m;
  leg.last_m = end_m;
  leg.enter = unit(chord_after(route, first, last, kEndChord_m), fallback);
  leg.leave = unit(chord_before(route, last, first, kEndChord_m), leg.enter);
  if (const auto end = line_end(route, first)) {
    leg.leave = end->ahead;
    leg.arc_from_m = end_m - kSmoothing_m;
    leg.arc_end = end->point;
    leg.arc_radpm = end->curvature_radpm;
  }
  return leg;
}

Leg leg_to_corner(const Route& route, const Leg& leg, const Station& corner) {
  Leg shorter = leg;
  shorter.last = corner.segment;
  shorter.last_m = corner.start_m;
  shorter.leave = unit(chord_before(route, shorter.last, leg.first, kEndChord_m), leg.enter);
  shorter.arc_from_m = INFINITY;
  return shorter;
}

bool is_backwards(const Route& route, const Leg& leg) {
  double s_m = 0;
  std::size_t k = leg.first;
  while (k + 1 < leg.last) {
    s_m += route.segment_m(k);
    if (s_m > kCornerSpread_m) break;
    ++k;
  }
  return k + 1 < route.size() && route.backwards(k);
}

namespace {

/// Points of corners that lie close together.
struct Cluster {
  Station first;
  Station last;
  Station sharpest;
  double sharpest_rad = 0;
};

/// How far the route goes back between two points, seen along `ahead`.
double step_back_m(const Route& route, std::size_t from, std::size_t to, Vector ahead) {
  double highest_m = 0;
  double back_m = 0;
  for (std::size_t k = from + 1; k <= to; ++k) {
    const double along_m = dot(route.point(k) - route.point(from), ahead);
    highest_m = std::max(highest_m, along_m);
    back_m = std::max(back_m, highest_m - along_m);
  }
  return back_m;
}

/// A short step back in a recording: it turns round twice, and goes on as it came.
bool is_fold(const Route& route, std::size_t leg_first, const Cluster& cluster, double sharp_rad) {
  if (cluster.sharpest_rad < kCusp_rad) return false;
  const Vector before = chord_before(route, cluster.first.segment, leg_first, kEndChord_m);
  const Vector after = chord_after(route, cluster.last.segment, route.size() - 1, kEndChord_m);
  if (dot(before, before) == 0 || dot(after, after) == 0) return false;
  return std::abs(std::atan2(cross(before, after), dot(before, after))) <= sharp_rad &&
         step_back_m(route, cluster.first.segment, cluster.last.segment, before) <= kFold_m;
}

/// The next one that begins before `until_m`, of points within `spread_m` after its first; segment
/// 0: there is none.
Cluster next_cluster(const Route& route, std::size_t leg_first, double sharp_rad, double until_m,
                     double spread_m, CornerScan& scan) {
  Cluster found;
  while (scan.known.segment + 2 < route.size() && scan.known.start_m < until_m) {
    Station& at = scan.known;
    const Station next{at.segment + 1, at.start_m + route.segment_m(at.segment)};
    if (found.first.segment != 0 && next.start_m > until_m) break;
    at = next;
    if (at.start_m - scan.tested_m < kTestSpacing_m) continue;
    scan.tested_m = at.start_m;
    const double angle_rad = corner_rad(route, at.segment, leg_first);
    if (angle_rad <= sharp_rad) continue;
    if (found.first.segment == 0) {
      until_m = at.start_m + spread_m;
      found.first = at;
    }
    found.last = at;
    if (angle_rad <= found.sharpest_rad) continue;
    found.sharpest = at;
    found.sharpest_rad = angle_rad;
  }
  return found;
}

}  // namespace

Station find_corner(const Route& route, const Leg& leg, double sharp_rad, double until_m,
                    CornerScan& scan) {
  while (true) {
    CornerScan farther = scan;
    const Cluster fold = next_cluster(route, leg.first, sharp_rad, until_m, kFoldSpread_m, farther);
    if (fold.first.segment == 0) {
      scan = farther;
      return {};
    }
    if (is_fold(route, leg.first, fold, sharp_rad)) {
      scan = {fold.last, fold.last.start_m};
      continue;
    }
    // Dense points: the sharpest of those around is the corner.
    const Station corner =
        next_cluster(route, leg.first, sharp_rad, until_m, kCornerSpread_m, scan).sharpest;
    scan = {corner, corner.start_m};
    return corner;
  }
}

}  // namespace drover::track
