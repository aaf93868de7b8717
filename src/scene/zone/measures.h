// How large polygons are, and how far away.
#pragma once

#include <vector>

#include "scene/plane/point.h"
#include "scene/zone/project.h"

namespace drover::scene {

/// Without its holes.
double area_m2(const MapPolygon& polygon);
/// Of the outer ring and the holes.
double perimeter_m(const MapPolygon& polygon);

/// For people, not for stopping: what the robot may not touch is tested without distances.
struct Nearest {
  double distance_m = 0;   ///< 0 inside, infinite without a polygon
  double bearing_rad = 0;  ///< from north, clockwise, 0 to 2 pi; 0 inside
};
Nearest nearest(const std::vector<MapPolygon>& polygons, const Point2& from);

}  // namespace drover::scene
