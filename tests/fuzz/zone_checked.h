// What holds of every zone that an import takes, whatever the file was.
#pragma once

#include <cmath>
#include <cstdlib>
#include <string>

#include "scene/zone/import.h"
#include "scene/zone/measures.h"
#include "scene/zone/project.h"
#include "scene/zone/summary.h"
#include "scene/zone/zone_checks.h"
#include "scene/zone/zone_text.h"

namespace drover::fuzz {

inline void require(bool holds) {
  if (!holds) std::abort();
}

/// Good, the same when it is stored and read again, and of some size in the plane.
inline void check_imported(const scene::ImportedZone& imported) {
  using namespace scene;
  require(!find_fault(imported.polygons));
  const GeoPoint& corner = imported.polygons.front().outer.front();
  const GeodeticPoint origin{corner.latitude_deg, corner.longitude_deg, 100};
  const Zone zone{"zone", Zone::Kind::keep_in, imported.polygons, origin, "file"};
  require(!check_zone(zone));
  const auto again = read_zone_text(zone_text(zone));
  require(again.ok() && again->polygons == zone.polygons);
  const auto placed = project(zone, origin);
  require(placed.polygons.size() == zone.polygons.size());
  for (const MapPolygon& polygon : placed.polygons) {
    require(std::isfinite(area_m2(polygon)) && std::isfinite(perimeter_m(polygon)));
    for (const Point2& point : polygon.outer) require(is_finite(point));
  }
  const auto summary = summarise(zone, origin);
  require(summary.from_robot && std::isfinite(summary.from_robot->distance_m));
}

inline void check_refusal(const scene::ImportError& error) {
  require(!error.what.empty() && error.text().size() < 1000);
}

}  // namespace drover::fuzz
