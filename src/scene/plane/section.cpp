#include "scene/plane/section.h"

#include <algorithm>
#include <limits>
#include <tuple>
#include <utility>

namespace drover::scene {

bool is_interval(Heights heights) {
  return heights.low_m < heights.high_m;
}

bool misses(double lowest_m, double highest_m, Heights heights) {
  return highest_m <= heights.low_m || lowest_m >= heights.high_m;
}

Point2 crossing(const Vector3& a, const Vector3& b, double height_m) {
  if (std::tie(b.x, b.y, b.z) < std::tie(a.x, a.y, a.z)) return crossing(b, a, height_m);
  const double part = (height_m - a.z) / (b.z - a.z);
  return {a.x + part * (b.x - a.x), a.y + part * (b.y - a.y)};
}

Area area_between(const Polyhedron& body, Heights heights) {
  double lowest_m = std::numeric_limits<double>::infinity();
  double highest_m = -lowest_m;
  std::vector<Point2> points;
  for (const Vector3& corner : body.corners_m) {
    lowest_m = std::min(lowest_m, corner.z);
    highest_m = std::max(highest_m, corner.z);
    if (corner.z >= heights.low_m && corner.z <= heights.high_m)
      points.push_back({corner.x, corner.y});
  }
  if (misses(lowest_m, highest_m, heights)) return {};
  for (const auto& [first, second] : body.edges) {
    const Vector3& a = body.corners_m[first];
    const Vector3& b = body.corners_m[second];
    for (const double height_m : {heights.low_m, heights.high_m})
      if ((a.z < height_m) != (b.z < height_m)) points.push_back(crossing(a, b, height_m));
  }
  std::vector<Piece> pieces;
  pieces.push_back(piece_of(std::move(points)));
  return area_of(std::move(pieces));
}

}  // namespace drover::scene
