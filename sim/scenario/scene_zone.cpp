#include "sim/scenario/scene_zone.h"

#include <GeographicLib/LocalCartesian.hpp>

namespace drover::sim {

using nlohmann::json;

ZoneSpec read_zone(JsonReader reader, const json& raw) {
  ZoneSpec zone;
  zone.name = reader.text("name");
  if (zone.name.empty() || zone.name.find_first_of(" \t\r\n/") != std::string::npos)
    reader.fail("name", "must be one word");
  zone.deleted = reader.flag("deleted", false);
  if (!zone.deleted) {
    const auto kind = reader.text("kind");
    if (kind != "keep_in" && kind != "keep_out") reader.fail("kind", "must be keep_in or keep_out");
    zone.keep_in = kind == "keep_in";
    if (!reader.has("polygon")) reader.fail("polygon", "is missing");
    reader.ignore("polygon");
    for (const auto& corner : raw.at("polygon")) {
      if (!corner.is_array() || corner.size() != 2 || !corner[0].is_number() ||
          !corner[1].is_number())
        reader.fail("polygon", "must be a list of [x, y]");
      zone.polygon.push_back({corner[0].get<double>(), corner[1].get<double>(), 0});
    }
    if (zone.polygon.size() < 3) reader.fail("polygon", "must have three corners");
  }
  reader.done();
  return zone;
}

std::string geojson(const ZoneSpec& zone, const Origin& origin) {
  const GeographicLib::LocalCartesian frame(origin.latitude_deg, origin.longitude_deg,
                                            origin.altitude_m);
  auto ring = json::array();
  for (std::size_t i = 0; i <= zone.polygon.size(); ++i) {
    const auto& corner = zone.polygon[i % zone.polygon.size()];
    double latitude_deg = 0;
    double longitude_deg = 0;
    double height_m = 0;
    frame.Reverse(corner.x_m, corner.y_m, 0, latitude_deg, longitude_deg, height_m);
    ring.push_back({longitude_deg, latitude_deg});
  }
  auto rings = json::array();
  rings.push_back(ring);
  const nlohmann::ordered_json feature{{"type", "Feature"},
                                       {"properties", {{"name", zone.name}}},
                                       {"geometry", {{"type", "Polygon"}, {"coordinates", rings}}}};
  return feature.dump(1) + "\n";
}

std::vector<std::string> zone_words(const ZoneSpec& zone, const std::string& file) {
  if (zone.deleted) return {"zone", "delete", zone.name};
  return {"zone",   "import",  file,   zone.keep_in ? "--keep-in" : "--keep-out",
          "--name", zone.name, "--yes"};
}

}  // namespace drover::sim
