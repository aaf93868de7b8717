// Any bytes as a GeoJSON file: no crash, and what is taken is a good zone.
#include <cstddef>
#include <cstdint>
#include <string_view>

#include "scene/zone/geojson.h"
#include "tests/fuzz/zone_checked.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::string_view text(reinterpret_cast<const char*>(data), size);
  const auto zone = drover::scene::read_geojson(text);
  if (zone.ok()) {
    drover::fuzz::check_imported(*zone);
  } else {
    drover::fuzz::check_refusal(zone.error());
  }
  return 0;
}
