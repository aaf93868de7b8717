// Whether two things of the plane have a point in common: boolean, exact, no iteration. Touching
// is overlapping, and so is what is not a number.
#pragma once

#include "scene/plane/area.h"
#include "scene/plane/piece.h"

namespace drover::scene {

bool overlaps(const Piece& a, const Piece& b);
bool overlaps(const Piece& body, const Strip& strip);
bool overlaps(const Piece& body, const Area& area);

/// The point is inside one of the area's outlines.
bool is_inside(const Area& area, Point2 point);
/// The whole body is inside the outlines and touches no wall: what a keep-in zone asks for.
bool is_inside(const Area& area, const Piece& body);

}  // namespace drover::scene
