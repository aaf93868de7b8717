// The files in config/zones are what the README shows: each can be imported.
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <iterator>

#include "scene/zone/import_zone.h"

namespace drover::scene {
namespace {

Result<NewZone, ImportError> import(const std::filesystem::path& path) {
  std::ifstream stream(path, std::ios::binary);
  const std::string text(std::istreambuf_iterator<char>(stream), {});
  const bool keep_in = path.filename().string().starts_with("keep_in_");
  return import_zone(text, {"", keep_in ? Zone::Kind::keep_in : Zone::Kind::keep_out,
                            path.filename(), std::nullopt});
}

const std::filesystem::path kFolder = std::filesystem::path(DROVER_SOURCE_DIR) / "config/zones";

TEST(ZoneSamples, AreAllImported) {
  int samples = 0;
  for (const auto& file : std::filesystem::directory_iterator(kFolder)) {
    const auto zone = import(file.path());
    ASSERT_TRUE(zone.ok()) << file.path() << ": " << zone.error().text();
    EXPECT_TRUE(zone->notes.empty()) << file.path();
    const std::string name = file.path().filename();
    EXPECT_TRUE(name.starts_with("keep_in_") || name.starts_with("keep_out_")) << name;
    ++samples;
  }
  EXPECT_EQ(samples, 2);
}
TEST(ZoneSamples, AreWhatTheirNamesSay) {
  const auto yard = import(kFolder / "keep_in_yard_with_pond.geojson");
  ASSERT_TRUE(yard.ok());
  EXPECT_EQ(yard->zone.name, "yard");
  ASSERT_EQ(yard->zone.polygons.size(), 1U);
  EXPECT_EQ(yard->zone.polygons[0].holes.size(), 1U);
  const auto greenhouse = import(kFolder / "keep_out_greenhouse.kml");
  ASSERT_TRUE(greenhouse.ok());
  EXPECT_EQ(greenhouse->zone.name, "greenhouse");
}

}  // namespace
}  // namespace drover::scene
