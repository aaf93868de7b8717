// Zones in the plane of `map`, about the origin that is in force now.
#pragma once

#include <string>
#include <vector>

#include "drover/path.h"
#include "scene/plane/point.h"
#include "scene/zone/zone.h"

namespace drover::scene {

/// `map`, metres. No corner is repeated.
using MapRing = std::vector<Point2>;

struct MapPolygon {
  MapRing outer;               ///< counter-clockwise
  std::vector<MapRing> holes;  ///< each clockwise
};

struct MapZone {
  std::string name;
  Zone::Kind kind = Zone::Kind::keep_out;
  /// Those within kMaxPlaneReach_m. A keep-in zone without any has nothing inside.
  std::vector<MapPolygon> polygons;
};

/// Farther from the origin `map` is no plane any more, and the other side of the earth would fold
/// onto this one.
inline constexpr double kMaxPlaneReach_m = 100'000;

/// To be done anew whenever the origin moves. Edges that are straight in latitude and longitude are
/// bent in `map` (2 cm in 1 km at 45 degrees): they become pieces of at most 500 m, bent by less
/// than 1 cm up to 60 degrees. An origin that is none gives corners that are no numbers.
std::vector<MapPolygon> project(const std::vector<GeoPolygon>& polygons,
                                const GeodeticPoint& origin);
MapZone project(const Zone& zone, const GeodeticPoint& origin);

/// The other way: where on earth a place of `map` is, at the height of the origin.
GeodeticPoint place_on_earth(const Point2& in_map, const GeodeticPoint& origin);

}  // namespace drover::scene
