#include "scene/zone/kml.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace drover::scene {
namespace {

using testing::HasSubstr;
using testing::IsEmpty;

const std::string kCoordinates = "11,48,0 11.001,48,0\n 11.001,48.001,0\t11,48,0";

std::string ring(const std::string& coordinates) {
  return "<LinearRing><coordinates>" + coordinates + "</coordinates></LinearRing>";
}
std::string polygon(const std::string& coordinates, const std::string& holes = "") {
  return "<Polygon><extrude>1</extrude><outerBoundaryIs>" + ring(coordinates) +
         "</outerBoundaryIs>" + holes + "</Polygon>";
}
std::string kml(const std::string& inside) {
  return "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n"
         "<kml xmlns=\"http://www.opengis.net/kml/2.2\"><Document>" +
         inside + "</Document></kml>\n";
}
std::string placemark(const std::string& inside, const std::string& name = "yard") {
  return "<Placemark><name>" + name + "</name>" + inside + "</Placemark>";
}

std::string refusal(const std::string& text) {
  const auto zone = read_kml(text);
  return zone.ok() ? "taken" : zone.error().text();
}

TEST(Kml, HasTheLongitudeFirstAndPassesOverHeights) {
  const auto zone = read_kml(kml(placemark(polygon(kCoordinates))));
  ASSERT_TRUE(zone.ok()) << zone.error().text();
  ASSERT_EQ(zone->polygons.size(), 1U);
  EXPECT_EQ(zone->polygons[0].outer, (GeoRing{{48, 11}, {48, 11.001}, {48.001, 11.001}}));
  EXPECT_EQ(zone->name, "yard");
}
TEST(Kml, TakesEveryDigit) {
  const auto zone =
      read_kml(kml(polygon("113.01963664566671,23.149652496512347 113.02,23.14 "
                           "113.03,23.15 113.01963664566671,23.149652496512347")));
  ASSERT_TRUE(zone.ok()) << zone.error().text();
  EXPECT_EQ(zone->polygons[0].outer[0].longitude_deg, 113.01963664566671);
  EXPECT_EQ(zone->polygons[0].outer[0].latitude_deg, 23.149652496512347);
}
TEST(Kml, ReadsHolesMultiGeometriesAndFolders) {
  const std::string hole = "11.0004,48.0001 11.0006,48.0001 11.0006,48.0002 11.0004,48.0001";
  const std::string with_hole =
      polygon(kCoordinates, "<innerBoundaryIs>" + ring(hole) + "</innerBoundaryIs>");
  const auto zone = read_kml(
      kml("<Folder>" +
          placemark("<MultiGeometry>" + with_hole + polygon(kCoordinates) + "</MultiGeometry>") +
          "</Folder>" + placemark(polygon(kCoordinates), "pond")));
  ASSERT_TRUE(zone.ok()) << zone.error().text();
  ASSERT_EQ(zone->polygons.size(), 3U);
  ASSERT_EQ(zone->polygons[0].holes.size(), 1U);
  EXPECT_EQ(zone->polygons[0].holes[0][2], (GeoPoint{48.0002, 11.0006}));
  EXPECT_EQ(zone->name, "") << "they do not agree";
}
TEST(Kml, FindsAreasWithAPrefixAndInElementsThatItDoesNotKnow) {
  const std::string prefixed =
      "<k:kml xmlns:k=\"http://www.opengis.net/kml/2.2\"><k:Later><k:Polygon><k:outerBoundaryIs>"
      "<k:LinearRing><k:coordinates>" +
      kCoordinates +
      "</k:coordinates></k:LinearRing></k:outerBoundaryIs></k:Polygon></k:Later></k:kml>";
  EXPECT_EQ(refusal(prefixed), "taken");
}
TEST(Kml, ReadsCoordinatesToTheirEndAcrossCommentsAndCData) {
  const auto zone = read_kml(
      kml(polygon("11,48 11.001,48 <!-- half --> 11.001,48.001 <![CDATA[11,48.001 11,48]]>")));
  ASSERT_TRUE(zone.ok()) << zone.error().text();
  EXPECT_EQ(zone->polygons[0].outer.size(), 4U);
  EXPECT_THAT(refusal(kml(polygon("11,48 11.001,48 <b/> 11.001,48.001 11,48"))),
              HasSubstr("has to be text"));
}
TEST(Kml, RefusesAFenceThatIsDrawnAsALineAndEverythingElseThatIsNoArea) {
  for (const char* kind : {"Point", "LineString", "LinearRing", "Model", "gx:Track"}) {
    const std::string other = "<" + std::string(kind) + "/>";
    EXPECT_THAT(refusal(kml(placemark(polygon(kCoordinates)) + placemark(other))),
                HasSubstr("is no area"))
        << kind;
  }
  EXPECT_THAT(refusal(kml("")), HasSubstr("there is none"));
}
TEST(Kml, FetchesNothing) {
  EXPECT_THAT(refusal(kml(polygon(kCoordinates) + "<NetworkLink><Link><href>http://a</href>"
                                                  "</Link></NetworkLink>")),
              HasSubstr("not followed"));
}
TEST(Kml, RefusesAKmzByItsName) {
  EXPECT_THAT(refusal(std::string("PK\x03\x04\x14\0\0\0", 8)), HasSubstr("KMZ"));
}
TEST(Kml, ExpandsNoEntities) {
  const std::string bomb = "<!DOCTYPE kml [<!ENTITY a \"1\"><!ENTITY b \"&a;&a;\">]>";
  EXPECT_THAT(refusal(bomb + kml(polygon(kCoordinates))), HasSubstr("document type"));
}
TEST(Kml, RefusesARingThatIsNotClosedWithItsLine) {
  EXPECT_THAT(refusal(kml(polygon("11,48 11.1,48 11.1,48.1 11,48.1"))),
              testing::AllOf(HasSubstr("line 2"), HasSubstr("not closed")));
  EXPECT_THAT(refusal(kml(polygon("11,48 11.1,48 11,48"))), HasSubstr("at least four"));
  EXPECT_THAT(refusal(kml(polygon(""))), HasSubstr("at least four"));
}
TEST(Kml, TellsTheLineAndThePointOfWhatIsNoNumber) {
  for (const char* bad : {"11", "11,", ",48", "11,48,", "11,48,0,0", "11;48", "11,4x8", "x11,48",
                          "nan,48", "inf,48", "1e999,48", "11,,48", "11,48,m"}) {
    EXPECT_THAT(refusal(kml(polygon("11,48\n11.001,48\n" + std::string(bad) + "\n11,48"))),
                testing::AllOf(HasSubstr("line 2"), HasSubstr("point 2"), HasSubstr(bad)));
  }
  EXPECT_THAT(refusal(kml(polygon("11, 48 11.001, 48 11.001, 48.001 11, 48"))),
              HasSubstr("without white space"));
}
TEST(Kml, TellsTheRingOfWhatIsNoZone) {
  EXPECT_THAT(refusal(kml("\n\n" + polygon("11,48 11.001,48.001 11.001,48 11,48.0015 11,48"))),
              testing::AllOf(HasSubstr("line 4"), HasSubstr("polygons[0].outer.points[")));
  EXPECT_THAT(refusal(kml(polygon("11,98 11.001,98 11.001,98.001 11,98"))),
              HasSubstr("latitude 98"));
}
TEST(Kml, RefusesWhatIsOfAnotherForm) {
  const std::string two = "<Polygon><outerBoundaryIs>" + ring(kCoordinates) + ring(kCoordinates) +
                          "</outerBoundaryIs></Polygon>";
  for (const std::string& bad :
       {std::string(), std::string("x"), std::string("<kml"), std::string("<gpx></gpx>"),
        std::string("<kml/><kml/>"), std::string("<kml>\0</kml>", 12), kml("<Polygon/>"),
        kml("<Polygon><outerBoundaryIs/></Polygon>"), kml(two),
        kml("<Polygon><outerBoundaryIs><Circle/></outerBoundaryIs></Polygon>"),
        kml("<Polygon><outerBoundaryIs><LinearRing/></outerBoundaryIs></Polygon>"),
        kml("<Polygon><outerBoundaryIs><LinearRing><coordinates/><coordinates/></LinearRing>"
            "</outerBoundaryIs></Polygon>")}) {
    EXPECT_NE(refusal(bad), "taken") << bad;
  }
}
TEST(Kml, IsBoundedInDepthSizeAndAttributes) {
  std::string deep;
  for (int i = 0; i < 50'000; ++i) deep += "<a>";
  EXPECT_NE(refusal(deep), "taken");
  std::string less;
  for (int i = 0; i < 60; ++i) less = "<a>" + less + "</a>";
  EXPECT_THAT(refusal(kml(less)), HasSubstr("nested deeper than 32"));
  EXPECT_THAT(refusal(std::string(kMaxImportBytes + 1, ' ')), HasSubstr("limit"));
  std::string attributes = "<kml ";
  for (int i = 0; i < 100'000; ++i) attributes += "a" + std::to_string(i) + "=\">\" ";
  EXPECT_THAT(refusal(attributes + "/>"), HasSubstr("attributes"));
}

}  // namespace
}  // namespace drover::scene
