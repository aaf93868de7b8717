// What an object takes of the plane.
#pragma once

#include <limits>
#include <vector>

#include "scene/plane/piece.h"

namespace drover::scene {

/// Of a plane that is tilted or upright: low <= normal . point <= high, without an end to its
/// sides. The normal is of unit length.
struct Strip {
  Point2 normal{1, 0};
  double low_m = -std::numeric_limits<double>::infinity();
  double high_m = std::numeric_limits<double>::infinity();
};

struct Side {
  Point2 from;
  Point2 to;
};
/// The closed outline of something solid, holes too, in any order: a point is inside when a ray
/// from it crosses an odd number of sides, or, if they are `directed`, not as many to the left as
/// to the right (so that two solids that overlap do not cancel each other). The sides themselves
/// stand among the area's pieces as walls: who touches no wall is inside or outside as a whole.
struct Outline {
  std::vector<Side> sides;
  bool directed = false;
};

/// The union of all that it lists; nothing when it lists nothing.
struct Area {
  std::vector<Piece> pieces;
  std::vector<Strip> strips;
  std::vector<Outline> outlines;
  Circle around;  ///< of all: infinite with a strip

  bool empty() const { return pieces.empty() && strips.empty() && outlines.empty(); }
};

/// Blocks whatever it is tested against: what cannot be judged.
Area area_of_everything();
Area area_of(std::vector<Piece> pieces);
/// Polygon and holes, each ring with or without its first point again at its end; also concave.
/// A keep-out zone is such an object; a keep-in zone is one that the robot has to be inside of.
Area area_of_rings(const std::vector<std::vector<Point2>>& rings);
/// One object of several shapes.
Area union_of(std::vector<Area> areas);

/// All that is within `by_m` of it: of what is known to be there or that much beside it.
Area widened(Area area, double by_m);

/// Of the area's points about the one that is nearest to `from`.
Point2 nearest(const Area& area, Point2 from);

}  // namespace drover::scene
