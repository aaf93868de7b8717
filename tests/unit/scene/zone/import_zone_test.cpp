#include "scene/zone/import_zone.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/unit/scene/zone/zones.h"

namespace drover::scene {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;

const std::string kGeoJson =
    R"({"type":"Feature","properties":{"name":"yard"},"geometry":{"type":"Polygon",)"
    R"("coordinates":[[[11,48],[11.001,48],[11.001,48.001],[11,48]]]}})";
const std::string kKml =
    "<kml><Placemark><name>pond</name><Polygon><outerBoundaryIs><LinearRing><coordinates>"
    "11,48 11.001,48 11.001,48.001 11,48"
    "</coordinates></LinearRing></outerBoundaryIs></Polygon></Placemark></kml>";

std::string refusal(const std::string& text, const ZoneOrder& order = {}) {
  const auto made = import_zone(text, order);
  return made.ok() ? "taken" : made.error().text();
}

TEST(ZoneImport, TellsGeoJsonFromKmlByTheText) {
  EXPECT_EQ(import_zone(kGeoJson, {})->zone.name, "yard");
  EXPECT_EQ(import_zone(kKml, {})->zone.name, "pond");
  EXPECT_EQ(import_zone(" \r\n" + kKml, {})->zone.name, "pond");
}
TEST(ZoneImport, SaysThatTheAreasHaveDifferentNames) {
  const auto feature = [](const std::string& name, const char* east) {
    return R"({"type":"Feature","properties":{"name":")" + name +
           R"("},"geometry":{"type":"Polygon","coordinates":[[[)" + east + ",48],[" + east +
           "1,48],[" + east + "1,48.001],[" + east + ",48]]]}}";
  };
  const auto file = [&](const char* one, const char* other) {
    return R"({"type":"FeatureCollection","features":[)" + feature(one, "11.00") + "," +
           feature(other, "11.02") + "]}";
  };
  EXPECT_THAT(refusal(file("a", "b")), HasSubstr("have different names: give one"));
  EXPECT_EQ(refusal(file("a", "a")), "taken");
  EXPECT_EQ(refusal(file("a", "b"), {"field"}), "taken");
}
TEST(ZoneImport, PassesOverAByteOrderMark) {
  EXPECT_EQ(refusal("\xEF\xBB\xBF" + kGeoJson), "taken");
  EXPECT_EQ(refusal("\xEF\xBB\xBF" + kKml), "taken");
}
TEST(ZoneImport, KeepsWhatThePersonSaysOfIt) {
  const auto made = import_zone(kGeoJson, {"north", Zone::Kind::keep_in, "a.geojson", kField});
  ASSERT_TRUE(made.ok());
  EXPECT_EQ(made->zone.name, "north") << "before what the file says";
  EXPECT_EQ(made->zone.kind, Zone::Kind::keep_in);
  EXPECT_EQ(made->zone.source, "a.geojson");
  ASSERT_TRUE(made->zone.datum);
  EXPECT_EQ(made->zone.datum->altitude_m, kField.altitude_m);
  EXPECT_EQ(made->zone.polygons[0].outer.size(), 3U);
}
TEST(ZoneImport, WantsANameFromThePersonOrTheFile) {
  std::string unnamed = kGeoJson;
  unnamed.replace(unnamed.find("name"), 4, "nome");
  EXPECT_THAT(refusal(unnamed), HasSubstr("does not name"));
  EXPECT_EQ(refusal(unnamed, {"north", Zone::Kind::keep_in, "", {}}), "taken");
  EXPECT_THAT(refusal(kGeoJson, {"a\nb", Zone::Kind::keep_in, "", {}}), HasSubstr("name: "));
}
TEST(ZoneImport, HandsOnNotesAndReasons) {
  const std::string half = R"({"type":"FeatureCollection","features":[)" + kGeoJson +
                           R"(,{"type":"Feature","properties":null,"geometry":null}]})";
  EXPECT_THAT(import_zone(half, {})->notes, ElementsAre(HasSubstr("without a geometry")));
  EXPECT_THAT(refusal(std::string("PK\x03\x04", 4)), HasSubstr("KMZ"));
  EXPECT_THAT(refusal("<kml></kml>"), HasSubstr("there is none"));
  EXPECT_THAT(refusal("{"), HasSubstr("line 1"));
  EXPECT_NE(refusal(""), "taken");
  EXPECT_NE(refusal("   \n"), "taken");
}

}  // namespace
}  // namespace drover::scene
