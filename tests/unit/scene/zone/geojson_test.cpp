#include "scene/zone/geojson.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace drover::scene {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

const std::string kRing = "[[11,48],[11.001,48],[11.001,48.001],[11,48]]";
const std::string kPolygon = R"({"type":"Polygon","coordinates":[)" + kRing + "]}";

std::string feature(const std::string& geometry, const std::string& properties = "null") {
  return R"({"type":"Feature","properties":)" + properties + R"(,"geometry":)" + geometry + "}";
}
std::string collection(const std::string& features) {
  return R"({"type":"FeatureCollection","features":[)" + features + "]}";
}
std::string polygon(const std::string& rings) {
  return R"({"type":"Polygon","coordinates":)" + rings + "}";
}

std::string refusal(const std::string& text) {
  const auto zone = read_geojson(text);
  return zone.ok() ? "taken" : zone.error().text();
}

TEST(GeoJson, HasTheLongitudeFirst) {
  const auto zone = read_geojson(kPolygon);
  ASSERT_TRUE(zone.ok()) << zone.error().text();
  ASSERT_EQ(zone->polygons.size(), 1U);
  EXPECT_EQ(zone->polygons[0].outer, (GeoRing{{48, 11}, {48, 11.001}, {48.001, 11.001}}));
  EXPECT_THAT(zone->polygons[0].holes, IsEmpty());
}
TEST(GeoJson, TakesEveryDigit) {
  const auto zone = read_geojson(
      polygon("[[[113.01963664566671,23.149652496512347],[113.02,23.14],[113.03,23.15],"
              "[113.01963664566671,23.149652496512347]]]"));
  ASSERT_TRUE(zone.ok());
  EXPECT_EQ(zone->polygons[0].outer[0].longitude_deg, 113.01963664566671);
  EXPECT_EQ(zone->polygons[0].outer[0].latitude_deg, 23.149652496512347);
}
TEST(GeoJson, ReadsHolesAndHeights) {
  const auto zone =
      read_geojson(polygon("[[[0,0,5],[0.01,0,5],[0.01,0.01,5],[0,0.01,5],[0,0,5]],"
                           "[[0.002,0.002],[0.004,0.002],[0.004,0.004],[0.002,0.002]]]"));
  ASSERT_TRUE(zone.ok()) << zone.error().text();
  ASSERT_EQ(zone->polygons[0].holes.size(), 1U);
  EXPECT_EQ(zone->polygons[0].holes[0][1], (GeoPoint{0.002, 0.004}));
}
TEST(GeoJson, ReadsAFeatureAFeatureCollectionAndAMultiPolygonAsOneZone) {
  const std::string multi =
      R"({"type":"MultiPolygon","coordinates":[[)" + kRing + "],[" + kRing + "]]}";
  const auto zone = read_geojson(collection(feature(kPolygon) + "," + feature(multi)));
  ASSERT_TRUE(zone.ok()) << zone.error().text();
  EXPECT_EQ(zone->polygons.size(), 3U);
}
TEST(GeoJson, HasTheNameOfItsFeaturesWhereTheyAgree) {
  const auto named = [](const std::string& name) {
    return feature(kPolygon, R"({"name":")" + name + R"(","fill":"#ff0000"})");
  };
  EXPECT_EQ(read_geojson(named("yard"))->name, "yard");
  EXPECT_EQ(read_geojson(collection(named("yard") + "," + feature(kPolygon)))->name, "yard");
  EXPECT_EQ(read_geojson(collection(named("yard") + "," + named("pond")))->name, "");
  EXPECT_EQ(read_geojson(feature(kPolygon, R"({"name":7})"))->name, "");
}
TEST(GeoJson, TellsOfFeaturesWithoutAPlace) {
  const auto zone = read_geojson(collection(feature(kPolygon) + "," + feature("null")));
  ASSERT_TRUE(zone.ok());
  EXPECT_THAT(zone->notes, ElementsAre("1 features without a geometry"));
  EXPECT_THAT(refusal(collection(feature("null"))), HasSubstr("there is none"));
}
TEST(GeoJson, RefusesAFenceThatIsDrawnAsALineAndEverythingElseThatIsNoArea) {
  for (const char* kind : {"Point", "MultiPoint", "LineString", "MultiLineString",
                           "GeometryCollection", "Circle", ""}) {
    const std::string other = R"({"type":")" + std::string(kind) + R"(","coordinates":[]})";
    EXPECT_THAT(refusal(collection(feature(kPolygon) + "," + feature(other))),
                testing::AllOf(HasSubstr("features[1].geometry"), HasSubstr(kind)));
  }
}
TEST(GeoJson, RefusesARingThatIsNotClosed) {
  EXPECT_THAT(refusal(polygon("[[[11,48],[11.1,48],[11.1,48.1],[11,48.1]]]")),
              testing::AllOf(HasSubstr("coordinates[0]"), HasSubstr("not closed")));
  EXPECT_THAT(refusal(polygon("[[[11,48],[11.1,48],[11,48]]]")), HasSubstr("at least four"));
}
TEST(GeoJson, SaysThatLatitudeAndLongitudeAreMostLikelySwapped) {
  const std::string swapped = "[[[23.1,113.0],[23.1,113.001],[23.101,113.001],\n[23.1,113.0]]]";
  EXPECT_THAT(refusal(polygon(swapped)), testing::AllOf(HasSubstr("line 1"), HasSubstr("swapped"),
                                                        HasSubstr("coordinates[0][0]")));
  EXPECT_THAT(refusal(polygon("[[[230,113],[230,114],[231,114],[230,113]]]")),
              testing::Not(HasSubstr("swapped")))
      << "it is none either way";
}
TEST(GeoJson, TellsTheLineAndColumnOfWhatIsNoZone) {
  EXPECT_THAT(refusal(polygon("[[[11,48],[11.001,48.001],\n  [11.001,48],[11,48.002],[11,48]]]")),
              HasSubstr("line 1, column 35 (polygons[0].outer.points[0]): the edge"));
  EXPECT_THAT(refusal(polygon("[[[11,48],[11.001,48],\n  [11.002,48],[11,48]]]")),
              HasSubstr("no area"));
  EXPECT_THAT(refusal(polygon("[[[11,48],[11.001,48],\n  [200,48],[11,48]]]")),
              HasSubstr("line 2, column 3 (polygons[0].outer.points[2]): longitude 200"));
}
TEST(GeoJson, RefusesAnotherSystemOfCoordinates) {
  const auto with_crs = [](const std::string& name) {
    return R"({"crs":{"type":"name","properties":{"name":")" + name + R"("}},)" +
           kPolygon.substr(1);
  };
  EXPECT_THAT(refusal(with_crs("urn:ogc:def:crs:EPSG::25832")), HasSubstr("WGS 84"));
  EXPECT_EQ(refusal(with_crs("urn:ogc:def:crs:OGC:1.3:CRS84")), "taken");
}
TEST(GeoJson, RefusesWhatIsOfAnotherForm) {
  for (const char* bad :
       {"",
        "[]",
        "7",
        "null",
        "{}",
        R"({"type":7})",
        R"({"type":"Polygon"})",
        R"({"type":"Polygon","coordinates":{}})",
        R"({"type":"Polygon","coordinates":[]})",
        R"({"type":"Polygon","coordinates":[[]]})",
        R"({"type":"Polygon","coordinates":[7]})",
        R"({"type":"Polygon","coordinates":[[[11],[11],[11],[11]]]})",
        R"({"type":"Polygon","coordinates":[[["11","48"],[11,48],[11,48],[11,48]]]})",
        R"({"type":"Polygon","coordinates":[[[11,48,1,1],[11,48],[11,48],[11,48]]]})",
        R"({"type":"Polygon","coordinates":[[[null,48],[11,48],[11,48],[11,48]]]})",
        R"({"type":"Polygon","coordinates":[[[1e999,48],[11,48],[11,48],[11,48]]]})",
        R"({"type":"MultiPolygon","coordinates":[]})",
        R"({"type":"Feature"})",
        R"({"type":"Feature","geometry":7})",
        R"({"type":"FeatureCollection"})",
        R"({"type":"FeatureCollection","features":[7]})",
        R"({"type":"FeatureCollection","features":[{"type":"Polygon"}]})",
        R"({"type":"FeatureCollection","features":[]})"}) {
    const std::string said = refusal(bad);
    EXPECT_NE(said, "taken") << bad;
    EXPECT_THAT(said, testing::Not(IsEmpty()));
  }
}
TEST(GeoJson, IsBoundedInDepthAndSize) {
  EXPECT_THAT(refusal(std::string(100'000, '[')), HasSubstr("nested deeper"));
  EXPECT_THAT(refusal(std::string(kMaxImportBytes + 1, ' ')), HasSubstr("limit"));
}

}  // namespace
}  // namespace drover::scene
