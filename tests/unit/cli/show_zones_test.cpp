// Answers about the zones as a person reads them.
#include "cli/show_zones.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "unit/cli/parsed.h"

namespace drover::cli {
namespace {

TEST(ZoneList, HasALineForEachZoneAndItsWarnings) {
  EXPECT_EQ(
      show_zones(
          parsed(R"({"ok":true,"zones":[{"name":"yard","kind":"keep_in","source":"yard.geojson",)"
                 R"("polygons":1,"holes":0,"points":5,"area_m2":1200.5,"perimeter_m":140.2,)"
                 R"("distance_m":0,"bearing_deg":null,"warnings":["it moved"]},)"
                 R"({"name":"pond","kind":"keep_out","source":"pond.kml","polygons":1,"holes":0,)"
                 R"("points":5,"area_m2":10,"perimeter_m":14,"distance_m":3.25,"bearing_deg":90,)"
                 R"("warnings":[]},{"name":"old","unreadable":"kind: is missing"}],)"
                 R"("problem":"zone old cannot be read"})")),
      "NOTHING IS FREE, no task moves: zone old cannot be read\n"
      "  the way out: drover zone delete NAME of a zone that cannot be read, or drover zone "
      "forget-unreadable when the whole file cannot; then import them anew\n"
      "yard                  keep-in         1200.5 m2     140.2 m around  the robot is inside  "
      "yard.geojson\n"
      "  warning: it moved\n"
      "pond                  keep-out          10.0 m2      14.0 m around  3.25 m from the robot, "
      "90 deg from north  pond.kml\n"
      "old                   CANNOT BE READ: kind: is missing\n");
}

TEST(ZoneList, SaysThatThereIsNone) {
  EXPECT_EQ(show_zones(parsed(R"({"ok":true,"zones":[],"problem":""})")), "no zone\n");
}

TEST(TheZones, AreTensOfKilometresAwayAndNotHundredThousandsOfMetres) {
  EXPECT_THAT(show_zones(parsed(R"({"ok":true,"zones":[{"name":"far","kind":"keep_in",)"
                                R"("distance_m":102406.69}],"problem":""})")),
              testing::HasSubstr("  102.4 km from the robot"));
}

TEST(TheZones, SayWhenTheLastFenceIsGone) {
  EXPECT_EQ(bounds_nothing(parsed(R"({"ok":true,"zones":[]})")),
            "NO ZONE IS LEFT: nothing bounds the robot now\n");
  EXPECT_THAT(bounds_nothing(parsed(R"({"ok":true,"zones":[{"kind":"keep_out"}]})")),
              testing::HasSubstr("NO KEEP-IN IS LEFT"));
  EXPECT_EQ(bounds_nothing(parsed(R"({"ok":true,"zones":[{"kind":"keep_in"}]})")), "");
  EXPECT_EQ(bounds_nothing(parsed(R"({"ok":true,"zones":[{"unreadable":"why"}]})")), "");
  EXPECT_EQ(bounds_nothing(parsed(R"({"ok":false})")), "");
}

}  // namespace
}  // namespace drover::cli
