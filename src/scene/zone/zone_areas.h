// Zones as what sweeps are tested against.
#pragma once

#include <string>
#include <vector>

#include "scene/plane/area.h"
#include "scene/zone/project.h"

namespace drover::scene {

/// One object, the union of the zone's polygons: for a Field. Empty when they are all too far away.
/// A Field goes by names: there zones need others than any object can have, or a message that adds
/// an object of a zone's name takes the zone away.
Area keep_out_area(const MapZone& zone);

struct KeepIn {
  std::vector<std::string> names;  ///< of the zones, one for each area
  std::vector<Area> areas;
};
/// Each polygon of each keep-in zone by itself: for first_exit. Who is wholly inside of one of them
/// is where he may be. Never empty when there is a keep-in zone, since no area at all is no bound:
/// a zone that is too far away gives one that nothing is inside of.
KeepIn keep_in_areas(const std::vector<MapZone>& zones);

}  // namespace drover::scene
