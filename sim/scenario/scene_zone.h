// A zone of a scenario: a file as a person would have drawn it, and the words that import it.
#pragma once

#include <nlohmann/json.hpp>

#include <string>
#include <vector>

#include "sim/robot/json_reader.h"
#include "sim/scenario/track.h"

namespace drover::sim {

///   {"zone": {"name": "pond", "kind": "keep_out", "polygon": [[3, -1], [4, -1], [4, 1], [3, 1]]}}
///   {"zone": {"name": "pond", "deleted": true}}
struct ZoneSpec {
  std::string name;
  bool keep_in = false;
  bool deleted = false;
  std::vector<TrackPose> polygon;  ///< in the simulator's frame
};

/// `raw` is what the reader reads. Throws std::runtime_error naming the key.
ZoneSpec read_zone(JsonReader reader, const nlohmann::json& raw);

/// GeoJSON: where it is on the earth.
std::string geojson(const ZoneSpec& zone, const Origin& origin);
/// The arguments of `drover`; `file` holds geojson().
std::vector<std::string> zone_words(const ZoneSpec& zone, const std::string& file);

}  // namespace drover::sim
