// Separating axes: two convex polygons are apart exactly if they are apart along the normal of one
// of their sides. With a radius around them, corners count too: then the distance of each corner
// from each side tells, which is a closed formula as well.
#include "scene/plane/overlap.h"

#include <algorithm>
#include <limits>

namespace drover::scene {
namespace {

enum class Apart { by_more, by_less, no };

/// Whether all of `corners` are beyond the line through `at` along `axis` (any length), and whether
/// by more than `reach_m`.
Apart apart_along(Point2 axis, Point2 at, const std::vector<Point2>& corners, double reach_m) {
  double gap = std::numeric_limits<double>::infinity();
  for (const Point2 corner : corners) gap = std::min(gap, dot(axis, corner - at));
  if (!(gap > 0)) return Apart::no;
  return gap * gap > reach_m * reach_m * squared(axis) ? Apart::by_more : Apart::by_less;
}

/// The most that the sides of `a` have to say. (A wall has two. What lies beyond its end in its own
/// line is beyond its circle.)
Apart apart_by_sides(const Piece& a, const Piece& b, double reach_m) {
  Apart most = Apart::no;
  const std::size_t count = a.corners.size();
  if (count < 2) return most;
  for (std::size_t i = 0; i < count; ++i) {
    const Point2 from = a.corners[i];
    const Point2 to = a.corners[(i + 1) % count];
    const Point2 side = to - from;
    const Apart outside = apart_along({side.y_m, -side.x_m}, from, b.corners, reach_m);
    if (outside == Apart::by_more) return outside;
    if (outside == Apart::by_less) most = outside;
  }
  return most;
}

/// Of polygons that are apart: from a corner of one to a side of the other.
double squared_distance_of_corners(const Piece& a, const Piece& b) {
  double least = std::numeric_limits<double>::infinity();
  const std::size_t count = b.corners.size();
  for (const Point2 corner : a.corners)
    for (std::size_t i = 0; i < count; ++i)
      least = std::min(
          least,
          squared(nearest_on_side(corner, b.corners[i], b.corners[(i + 1) % count]) - corner));
  return least;
}

/// Crossings of the ray from `point` towards +x. A corner on the ray belongs to one of its sides.
bool is_inside_outline(const Outline& outline, Point2 point) {
  bool odd = false;
  int turns = 0;
  for (const auto& [from, to] : outline.sides) {
    const bool up = from.y_m <= point.y_m && to.y_m > point.y_m;
    const bool down = to.y_m <= point.y_m && from.y_m > point.y_m;
    if (!up && !down) continue;
    const bool left_of_it = cross(to - from, point - from) > 0;
    if (up != left_of_it) continue;
    odd = !odd;
    turns += up ? 1 : -1;
  }
  return odd || (outline.directed && turns != 0);
}

}  // namespace

bool overlaps(const Piece& a, const Piece& b) {
  if (apart(a.around, b.around)) return false;
  const double reach_m = a.radius_m + b.radius_m;
  const Apart by_a = apart_by_sides(a, b, reach_m);
  if (by_a == Apart::by_more) return false;
  const Apart by_b = apart_by_sides(b, a, reach_m);
  if (by_b == Apart::by_more) return false;
  const bool points = a.corners.size() < 2 && b.corners.size() < 2;
  if (by_a == Apart::no && by_b == Apart::no && !points) return true;
  const double distance2 =
      std::min(squared_distance_of_corners(a, b), squared_distance_of_corners(b, a));
  return !(distance2 > reach_m * reach_m);
}

bool overlaps(const Piece& body, const Strip& strip) {
  double low_m = std::numeric_limits<double>::infinity();
  double high_m = -low_m;
  for (const Point2 corner : body.corners) {
    low_m = std::min(low_m, dot(strip.normal, corner));
    high_m = std::max(high_m, dot(strip.normal, corner));
  }
  return !(low_m - body.radius_m > strip.high_m) && !(high_m + body.radius_m < strip.low_m);
}

bool overlaps(const Piece& body, const Area& area) {
  if (area.empty() || apart(body.around, area.around)) return false;
  for (const Strip& strip : area.strips)
    if (overlaps(body, strip)) return true;
  for (const Piece& piece : area.pieces)
    if (overlaps(body, piece)) return true;
  return is_inside(area, body.corners.front());
}

bool is_inside(const Area& area, Point2 point) {
  for (const Outline& outline : area.outlines)
    if (is_inside_outline(outline, point)) return true;
  return false;
}

bool is_inside(const Area& area, const Piece& body) {
  for (const Piece& wall : area.pieces)
    if (overlaps(body, wall)) return false;
  return is_inside(area, body.corners.front());
}

}  // namespace drover::scene
