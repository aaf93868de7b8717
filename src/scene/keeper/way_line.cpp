#include "scene/keeper/way_line.h"

#include <algorithm>
#include <cmath>

#include "scene/plane/track_line.h"
#include "track/path_geometry.h"

namespace drover::scene {
namespace {

bool is_place(const Path& path, const WayLeft& way) {
  if (way.segment >= path.points.size() || way.target >= path.points.size()) return false;
  if (way.forwards ? way.segment > way.target : way.segment < way.target) return false;
  return std::isfinite(way.along_m);
}

}  // namespace

std::optional<WayLine> line_about(const Path& path, const WayLeft& way, double ahead_m) {
  if (!is_place(path, way)) return std::nullopt;
  WayLine line;
  line.way = way;
  // Against the travel, until there is enough behind the place.
  const std::size_t begin = way.forwards ? 0 : path.points.size() - 1;
  std::size_t i = way.segment;
  double behind_m = std::max(way.along_m, 0.0);
  line.points.push_back(point_of(path, i));
  while (i != begin && behind_m < kLineReach_m) {
    i = way.forwards ? i - 1 : i + 1;
    const Point2 point = point_of(path, i);
    behind_m += length_m(line.points.back() - point);
    line.points.push_back(point);
  }
  line.first = i;
  line.from_m = behind_m + std::min(way.along_m, 0.0);
  std::reverse(line.points.begin(), line.points.end());
  // With the travel.
  double left_m = ahead_m + kLineReach_m + std::max(way.along_m, 0.0);
  for (i = way.segment; i != way.target && left_m > 0;) {
    i = way.forwards ? i + 1 : i - 1;
    const Point2 point = point_of(path, i);
    left_m -= length_m(point - line.points.back());
    line.points.push_back(point);
  }
  line.ends = i == way.target;
  if (path.backwards.empty()) return line;
  const track::Route route(path.points, way.target, way.forwards, path.backwards, way.flipped);
  const std::size_t begin_k = way.forwards ? line.first : path.points.size() - 1 - line.first;
  for (std::size_t k = 0; k + 1 < line.points.size(); ++k)
    line.backwards.push_back(route.backwards(begin_k + k) ? 1 : 0);
  return line;
}

Point2 WayLine::place() const {
  double left_m = from_m;
  for (std::size_t i = 0; i + 1 < points.size(); ++i) {
    const Point2 side = points[i + 1] - points[i];
    const double side_m = length_m(side);
    if (side_m > 0 && left_m <= side_m) return points[i] + left_m / side_m * side;
    left_m -= side_m;
  }
  return points.back();
}

WayLeft WayLine::farther(double by_m) const {
  WayLeft there = way;
  double s_m = 0;
  std::size_t i = 0;
  for (; i + 2 < points.size(); ++i) {
    const double side_m = length_m(points[i + 1] - points[i]);
    if (s_m + side_m > from_m + by_m) break;
    s_m += side_m;
  }
  there.segment = static_cast<std::uint32_t>(way.forwards ? first + i : first - i);
  there.along_m = std::max(from_m + by_m - s_m, 0.0);
  return there;
}

}  // namespace drover::scene
