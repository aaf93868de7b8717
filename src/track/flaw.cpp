#include "track/flaw.h"

#include <cmath>

#include "track/path_geometry.h"

namespace drover::track {
namespace {

// Nobody records a track like this; two tracks or two origins in one file look so.
constexpr double kLongestGap_m = 1000;
constexpr double kSamePoint_m = 1e-3;
// A recorder that did not notice that the robot stood. Each point's surroundings are looked at
// again and again while driving: thousands of points in them would hold up the control loop.
constexpr std::size_t kMostAtOnePlace = 64;

double square_m2(const PathPoint& from, const PathPoint& to) {
  const Vector way = {to.x_m - from.x_m, to.y_m - from.y_m};
  return dot(way, way);
}

}  // namespace

Flaw find_flaw(std::span<const PathPoint> points) {
  using Kind = Flaw::Kind;
  if (points.size() < 2) return {.kind = Kind::too_few};
  bool has_length = false;
  std::size_t place = 0;  // first of the points that are within a millimetre of it
  Flaw crowd;             // the first place with too many points
  for (std::size_t k = 0; k < points.size(); ++k) {
    if (!std::isfinite(points[k].x_m) || !std::isfinite(points[k].y_m))
      return {.kind = Kind::not_finite, .point = k};
    if (k == 0) continue;
    const double gap_m2 = square_m2(points[k - 1], points[k]);
    if (gap_m2 >= kLongestGap_m * kLongestGap_m)
      return {.kind = Kind::far_apart, .point = k, .gap_m = std::sqrt(gap_m2)};
    has_length = has_length || gap_m2 > kSamePoint_m * kSamePoint_m;
    if (square_m2(points[place], points[k]) > kSamePoint_m * kSamePoint_m) {
      place = k;
    } else if (k - place >= kMostAtOnePlace && (crowd.kind == Kind::none || crowd.point == place)) {
      crowd = {.kind = Kind::crowd, .point = place, .last = k};
    }
  }
  return has_length ? crowd : Flaw{.kind = Kind::one_place};
}

}  // namespace drover::track
