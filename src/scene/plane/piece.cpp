#include "scene/plane/piece.h"

#include <algorithm>
#include <limits>

namespace drover::scene {
namespace {

/// The middle of the bounding box is good enough, and no iteration.
Circle circle_around(const std::vector<Point2>& corners, double radius_m) {
  Point2 low = corners.front();
  Point2 high = low;
  for (const Point2 corner : corners) {
    low = {std::min(low.x_m, corner.x_m), std::min(low.y_m, corner.y_m)};
    high = {std::max(high.x_m, corner.x_m), std::max(high.y_m, corner.y_m)};
  }
  const Point2 centre = 0.5 * (low + high);
  double farthest = 0;
  for (const Point2 corner : corners) farthest = std::max(farthest, squared(corner - centre));
  return {centre, std::sqrt(farthest) + radius_m};
}

/// One chain of Andrew's monotone hull, of points that are sorted; without its last point.
template <class Iterator>
void add_chain(Iterator begin, Iterator end, std::vector<Point2>& hull) {
  const std::size_t first = hull.size();
  for (; begin != end; ++begin) {
    while (hull.size() >= first + 2 &&
           cross(hull.back() - hull[hull.size() - 2], *begin - hull.back()) <= 0)
      hull.pop_back();
    hull.push_back(*begin);
  }
  hull.pop_back();
}

std::vector<Point2> convex_hull(std::vector<Point2> points) {
  std::sort(points.begin(), points.end(),
            [](Point2 a, Point2 b) { return a.x_m < b.x_m || (a.x_m == b.x_m && a.y_m < b.y_m); });
  points.erase(std::unique(points.begin(), points.end()), points.end());
  if (points.size() < 3) return points;
  std::vector<Point2> hull;
  hull.reserve(points.size() + 1);
  add_chain(points.begin(), points.end(), hull);
  add_chain(points.rbegin(), points.rend(), hull);
  return hull;
}

}  // namespace

Piece piece_of_everything() {
  constexpr double kEndless = std::numeric_limits<double>::infinity();
  return {{{0, 0}}, kEndless, {{0, 0}, kEndless}};
}

Piece piece_of(std::vector<Point2> points, double radius_m) {
  const bool sound =
      !points.empty() && std::isfinite(radius_m) && radius_m >= 0 &&
      std::all_of(points.begin(), points.end(), [](Point2 p) { return is_finite(p); });
  if (!sound) return piece_of_everything();
  Piece piece{convex_hull(std::move(points)), radius_m, {}};
  piece.around = circle_around(piece.corners, radius_m);
  return piece;
}

Piece disc(Point2 centre, double radius_m) {
  return piece_of({centre}, radius_m);
}

Piece widened(Piece piece, double by_m) {
  if (!(by_m >= 0)) return piece_of_everything();
  piece.radius_m += by_m;
  piece.around.radius_m += by_m;
  return piece;
}

double reach_m(std::span<const Point2> corners) {
  double reach_m = 0;
  for (const Point2 corner : corners) reach_m = std::max(reach_m, length_m(corner));
  return reach_m;
}

Piece placed(const Piece& in_base, const Pose2& at) {
  if (!is_finite(at)) return piece_of_everything();
  const Point2 ahead = direction(at.yaw_rad);
  const auto place = [&](Point2 p) {
    return Point2{at.x_m + ahead.x_m * p.x_m - ahead.y_m * p.y_m,
                  at.y_m + ahead.y_m * p.x_m + ahead.x_m * p.y_m};
  };
  // A turn keeps the hull, its order and its circle.
  Piece piece{{}, in_base.radius_m, {place(in_base.around.centre), in_base.around.radius_m}};
  piece.corners.reserve(in_base.corners.size());
  for (const Point2 corner : in_base.corners) piece.corners.push_back(place(corner));
  return piece;
}

Point2 nearest_on_side(Point2 from, Point2 a, Point2 b) {
  const Point2 side = b - a;
  const double length2 = squared(side);
  if (!(length2 > 0)) return a;
  return a + std::clamp(dot(from - a, side) / length2, 0.0, 1.0) * side;
}

Point2 nearest(const Piece& piece, Point2 from) {
  const std::size_t count = piece.corners.size();
  Point2 best = piece.corners.front();
  bool inside = count >= 3;
  for (std::size_t i = 0; i < count; ++i) {
    const Point2 a = piece.corners[i];
    const Point2 b = piece.corners[(i + 1) % count];
    const Point2 there = nearest_on_side(from, a, b);
    if (squared(there - from) < squared(best - from)) best = there;
    inside = inside && cross(b - a, from - a) >= 0;
  }
  const double away_m = length_m(best - from);
  if (inside || !(away_m > piece.radius_m)) return from;
  return best + piece.radius_m / away_m * (from - best);
}

}  // namespace drover::scene
