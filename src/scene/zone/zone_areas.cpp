// Zones as what sweeps are tested against.
#include "scene/zone/zone_areas.h"

#include <utility>

namespace drover::scene {
namespace {

Area area_of_polygon(const MapPolygon& polygon) {
  std::vector<MapRing> rings = {polygon.outer};
  rings.insert(rings.end(), polygon.holes.begin(), polygon.holes.end());
  return area_of_rings(rings);
}

}  // namespace

Area keep_out_area(const MapZone& zone) {
  std::vector<Area> areas;
  for (const MapPolygon& polygon : zone.polygons) areas.push_back(area_of_polygon(polygon));
  return union_of(std::move(areas));
}

KeepIn keep_in_areas(const std::vector<MapZone>& zones) {
  KeepIn keep_in;
  for (const MapZone& zone : zones) {
    if (zone.kind != Zone::Kind::keep_in) continue;
    for (const MapPolygon& polygon : zone.polygons)
      keep_in.areas.push_back(area_of_polygon(polygon));
    if (zone.polygons.empty()) keep_in.areas.emplace_back();
    keep_in.names.resize(keep_in.areas.size(), zone.name);
  }
  return keep_in;
}

}  // namespace drover::scene
