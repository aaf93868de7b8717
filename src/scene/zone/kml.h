// Zones from KML 2.2: `lon,lat[,alt]`, separated by white space.
#pragma once

#include <string_view>

#include "drover/result.h"
#include "scene/zone/import.h"

namespace drover::scene {

/// Polygons of all Placemarks, in a MultiGeometry or alone, all together one zone. A geometry of
/// another kind is refused, not passed over; so are KMZ, a document type and a NetworkLink: nothing
/// is unpacked, expanded or fetched. Heights and styles are passed over.
Result<ImportedZone, ImportError> read_kml(std::string_view text);

}  // namespace drover::scene
