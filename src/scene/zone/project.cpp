// Zones in the plane of `map`, about the origin that is in force now.
#include "scene/zone/project.h"

#include <GeographicLib/LocalCartesian.hpp>
#include <algorithm>
#include <cmath>

#include "scene/zone/ring.h"

namespace drover::scene {
namespace {

constexpr double kLongestPiece_m = 500;

class ZoneProjection {
 public:
  explicit ZoneProjection(const GeodeticPoint& origin)
      : frame_(origin.latitude_deg, origin.longitude_deg, origin.altitude_m),
        altitude_m_(origin.altitude_m) {}

  /// A zone knows no height above the ellipsoid; the origin's own is right to centimetres in x, y.
  Point2 operator()(const GeoPoint& point) {
    Point2 placed;
    double up_m = 0;
    frame_.Forward(point.latitude_deg, point.longitude_deg, altitude_m_, placed.x_m, placed.y_m,
                   up_m);
    // std::hypot of three takes a NaN for 0 at times, or for as far as its other arguments.
    const double away2 = squared(placed) + up_m * up_m;
    is_number_ = is_number_ && std::isfinite(away2);
    is_far_ = is_far_ || away2 > kMaxPlaneReach_m * kMaxPlaneReach_m;
    return placed;
  }
  /// What is no number is nowhere, and not far away.
  bool is_far() const { return is_far_ && is_number_; }

 private:
  GeographicLib::LocalCartesian frame_;
  double altitude_m_;
  bool is_far_ = false;
  bool is_number_ = true;
};

MapRing project_ring(const GeoRing& ring, ZoneProjection& place) {
  MapRing points;
  for (std::size_t i = 0; i < ring.size(); ++i) {
    const GeoPoint& a = ring[i];
    const GeoPoint& b = ring[(i + 1) % ring.size()];
    if (a == b) continue;
    const double pieces = std::max(1.0, std::ceil(length_m(flat(b, a)) / kLongestPiece_m));
    for (double k = 0; k < pieces; ++k) {
      const double part = k / pieces;
      points.push_back(place({a.latitude_deg + part * (b.latitude_deg - a.latitude_deg),
                              a.longitude_deg + part * (b.longitude_deg - a.longitude_deg)}));
    }
  }
  return points;
}

void turn_ring(MapRing& ring, bool counter_clockwise) {
  if ((signed_area_m2(ring) > 0) != counter_clockwise) std::reverse(ring.begin(), ring.end());
}

}  // namespace

std::vector<MapPolygon> project(const std::vector<GeoPolygon>& polygons,
                                const GeodeticPoint& origin) {
  std::vector<MapPolygon> projected;
  for (const GeoPolygon& polygon : polygons) {
    ZoneProjection place(origin);
    MapPolygon to;
    to.outer = project_ring(polygon.outer, place);
    turn_ring(to.outer, true);
    for (const GeoRing& hole : polygon.holes) {
      to.holes.push_back(project_ring(hole, place));
      turn_ring(to.holes.back(), false);
    }
    if (!place.is_far()) projected.push_back(std::move(to));
  }
  return projected;
}

MapZone project(const Zone& zone, const GeodeticPoint& origin) {
  return {zone.name, zone.kind, project(zone.polygons, origin)};
}

GeodeticPoint place_on_earth(const Point2& in_map, const GeodeticPoint& origin) {
  const GeographicLib::LocalCartesian frame(origin.latitude_deg, origin.longitude_deg,
                                            origin.altitude_m);
  GeodeticPoint place;
  frame.Reverse(in_map.x_m, in_map.y_m, 0, place.latitude_deg, place.longitude_deg,
                place.altitude_m);
  return place;
}

}  // namespace drover::scene
