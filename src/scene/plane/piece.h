// A convex piece of the plane: a polygon, a wall without thickness or a disc, and what is within a
// distance of one.
#pragma once

#include <span>
#include <vector>

#include "scene/plane/point.h"

namespace drover::scene {

/// All points within `radius_m` of a convex polygon. Three corners and more are counter-clockwise;
/// two are a wall, one is the centre of a disc. Made by the functions below only: they see to it
/// that what is not a number covers everything.
struct Piece {
  std::vector<Point2> corners;
  double radius_m = 0;
  Circle around;  ///< of the whole piece
};

/// Whatever is tested against it overlaps.
Piece piece_of_everything();
/// The convex hull of the points, and what is within `radius_m` of it: the exact Minkowski sum with
/// a disc. No point at all, a number that is not finite, a negative radius: everything.
Piece piece_of(std::vector<Point2> points, double radius_m = 0);
Piece disc(Point2 centre, double radius_m);

/// All that is within `by_m` of it; a width that is no number, or negative, makes it everything.
Piece widened(Piece piece, double by_m);

/// From base_link to the farthest of its corners.
double reach_m(std::span<const Point2> corners);

/// From base_link into `map`.
Piece placed(const Piece& in_base, const Pose2& at);
/// The point of the side from `a` to `b` that is nearest to `from`.
Point2 nearest_on_side(Point2 from, Point2 a, Point2 b);
/// The point of the piece that is nearest to `from`; that itself where it is inside.
Point2 nearest(const Piece& piece, Point2 from);

}  // namespace drover::scene
