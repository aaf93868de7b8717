// Zones for tests, about a point on the grass.
#pragma once

#include <utility>
#include <vector>

#include "scene/zone/zone.h"

namespace drover::scene {

inline const GeodeticPoint kField{48.0, 11.0, 500};

/// `x_m` east and `y_m` north of kField, good to a thousandth.
inline GeoPoint at(double x_m, double y_m) {
  return {kField.latitude_deg + y_m / 111'200.0, kField.longitude_deg + x_m / 74'626.0};
}

struct Place {
  double x_m;
  double y_m;
};
inline GeoRing ring(const std::vector<Place>& places) {
  GeoRing points;
  for (const Place& place : places) points.push_back(at(place.x_m, place.y_m));
  return points;
}
inline GeoRing box(double x_m, double y_m, double wide_m, double high_m) {
  return ring({{x_m, y_m}, {x_m + wide_m, y_m}, {x_m + wide_m, y_m + high_m}, {x_m, y_m + high_m}});
}
inline Zone zone(std::vector<GeoPolygon> polygons, Zone::Kind kind = Zone::Kind::keep_out) {
  return {"zone", kind, std::move(polygons), kField, "zone.geojson"};
}

}  // namespace drover::scene
