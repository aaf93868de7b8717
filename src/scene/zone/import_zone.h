// A file of a person's to a zone that may be stored: the one way in, whatever the format.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "drover/result.h"
#include "scene/zone/import.h"
#include "scene/zone/zone.h"

namespace drover::scene {

/// What the person says of it.
struct ZoneOrder {
  std::string name;  ///< empty: as the file names it
  Zone::Kind kind = Zone::Kind::keep_out;
  std::string source;                  ///< name of the file, without folders
  std::optional<GeodeticPoint> datum;  ///< the origin that is in force; absent: there is none
};

struct NewZone {
  Zone zone;                       ///< good (check_zone)
  std::vector<std::string> notes;  ///< what was passed over, a sentence each
};

/// GeoJSON or KML by what the text begins with, not by the name of the file; with or without a byte
/// order mark. Whether there is room for it beside the stored ones, check_room tells.
Result<NewZone, ImportError> import_zone(std::string_view text, const ZoneOrder& order);

}  // namespace drover::scene
