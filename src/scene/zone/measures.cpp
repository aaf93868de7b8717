// How large polygons are, and how far away.
#include "scene/zone/measures.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "scene/zone/ring.h"

namespace drover::scene {
namespace {

double length_of(const MapRing& ring) {
  double sum_m = 0;
  for (std::size_t i = 0; i < ring.size(); ++i)
    sum_m += length_m(ring[(i + 1) % ring.size()] - ring[i]);
  return sum_m;
}

/// From `from` to the nearest point of the edge ab.
Point2 way_to(const Point2& from, const Point2& a, const Point2& b) {
  const Point2 along = b - a;
  const double square_m2 = squared(along);
  const double part = square_m2 > 0 ? std::clamp(dot(from - a, along) / square_m2, 0.0, 1.0) : 0.0;
  return a + part * along - from;
}

bool contains(const MapPolygon& polygon, const Point2& point) {
  return ring_contains(point, polygon.outer) &&
         std::none_of(polygon.holes.begin(), polygon.holes.end(),
                      [&](const MapRing& hole) { return ring_contains(point, hole); });
}

double bearing_of(const Point2& way) {
  const double bearing_rad = std::atan2(way.x_m, way.y_m);
  return bearing_rad < 0 ? bearing_rad + 2 * std::numbers::pi : bearing_rad;
}

void look_along(const MapRing& ring, const Point2& from, Nearest& best) {
  for (std::size_t i = 0; i < ring.size(); ++i) {
    const Point2 way = way_to(from, ring[i], ring[(i + 1) % ring.size()]);
    const double distance_m = length_m(way);
    if (distance_m < best.distance_m) best = {distance_m, bearing_of(way)};
  }
}

}  // namespace

double area_m2(const MapPolygon& polygon) {
  double area_m2 = std::abs(signed_area_m2(polygon.outer));
  for (const MapRing& hole : polygon.holes) area_m2 -= std::abs(signed_area_m2(hole));
  return area_m2;
}

double perimeter_m(const MapPolygon& polygon) {
  double sum_m = length_of(polygon.outer);
  for (const MapRing& hole : polygon.holes) sum_m += length_of(hole);
  return sum_m;
}

Nearest nearest(const std::vector<MapPolygon>& polygons, const Point2& from) {
  Nearest best{std::numeric_limits<double>::infinity(), 0};
  for (const MapPolygon& polygon : polygons) {
    if (contains(polygon, from)) return {};
    look_along(polygon.outer, from, best);
    for (const MapRing& hole : polygon.holes) look_along(hole, from, best);
  }
  return best;
}

}  // namespace drover::scene
