// What a person sees of a zone before it is imported, so that a fence in the wrong place is seen.
#pragma once

#include <optional>
#include <string>

#include "drover/path.h"
#include "json/located_json.h"
#include "scene/zone/import_zone.h"

namespace drover::cli {

/// Of droverd's status: the origin of its map, and where base_link is. Absent: it does not know.
struct Whereabouts {
  std::optional<GeodeticPoint> origin;
  std::optional<GeodeticPoint> robot;
};
Whereabouts whereabouts_of(const json::Node& status);

/// Kind, size, distance to the robot, what was passed over in the file, and what is odd. `old`: of
/// zone_list, the zone that it takes the place of; null: none.
std::string preview_text(const scene::NewZone& zone, const Whereabouts& from,
                         const json::Node* old);

}  // namespace drover::cli
