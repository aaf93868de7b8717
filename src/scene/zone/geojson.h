// Zones from GeoJSON (RFC 7946): longitude first.
#pragma once

#include <string_view>

#include "drover/result.h"
#include "scene/zone/import.h"

namespace drover::scene {

/// Polygon and MultiPolygon, in a Feature or FeatureCollection or bare, all together one zone. A
/// geometry of another kind is refused, not passed over: it may be a fence drawn as a line.
/// Heights are passed over.
Result<ImportedZone, ImportError> read_geojson(std::string_view text);

}  // namespace drover::scene
