// Which paths are refused before anything moves.
#include <cmath>
#include <cstddef>

#include "engine/navigate/tracker.h"
#include "track/path_geometry.h"

namespace drover::engine {
namespace {

// Nobody records a track like this; two tracks or two origins in one file look so.
constexpr double kLongestGap_m = 1000;
constexpr double kSamePoint_m = 1e-3;
// A recorder that did not notice that the robot stood. Each point's surroundings are looked at
// again and again while driving: thousands of points in them would hold up the control loop.
constexpr std::size_t kMostAtOnePlace = 64;

double square_m2(const PathPoint& from, const PathPoint& to) {
  const track::Vector way = {to.x_m - from.x_m, to.y_m - from.y_m};
  return dot(way, way);
}

}  // namespace

Reason check_path(const Path& path, std::uint32_t target) {
  Reason reason;
  const auto& points = path.points;
  if (points.size() < 2) {
    reason = points.empty() ? "the track has no points" : "the track has only one point";
    return reason;
  }
  if (target >= points.size()) {
    reason.format("the track has no point %llu, only 1 to %zu",
                  static_cast<unsigned long long>(target) + 1, points.size());
    return reason;
  }
  bool has_length = false;
  std::size_t place = 0;        // first of the points that are within a millimetre of it
  std::size_t crowd_first = 0;  // the first place with too many points,
  std::size_t crowd_last = 0;   // and the last of them
  for (std::size_t k = 0; k < points.size(); ++k) {
    if (!std::isfinite(points[k].x_m) || !std::isfinite(points[k].y_m)) {
      reason.format("point %zu of the track has no valid position", k + 1);
      return reason;
    }
    if (k == 0) continue;
    const double gap_m2 = square_m2(points[k - 1], points[k]);
    if (gap_m2 >= kLongestGap_m * kLongestGap_m) {
      reason.format("point %zu of the track is %.0f m away from the one before it", k + 1,
                    std::sqrt(gap_m2));
      return reason;
    }
    has_length = has_length || gap_m2 > kSamePoint_m * kSamePoint_m;
    if (square_m2(points[place], points[k]) > kSamePoint_m * kSamePoint_m) {
      place = k;
    } else if (k - place >= kMostAtOnePlace && (crowd_last == 0 || crowd_first == place)) {
      crowd_first = place;
      crowd_last = k;
    }
  }
  if (!has_length) {
    reason = "all points of the track are the same";
  } else if (crowd_last != 0) {
    reason.format("points %zu to %zu of the track are one place", crowd_first + 1, crowd_last + 1);
  }
  return reason;
}

}  // namespace drover::engine
