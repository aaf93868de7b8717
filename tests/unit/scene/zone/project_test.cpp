#include "scene/zone/project.h"

#include <gtest/gtest.h>

#include <GeographicLib/LocalCartesian.hpp>
#include <algorithm>
#include <cmath>
#include <limits>
#include <random>

#include "scene/zone/measures.h"
#include "scene/zone/ring.h"
#include "tests/unit/scene/zone/zones.h"

namespace drover::scene {
namespace {

TEST(ZoneProjection, PutsCornersWhereTheirLatitudeAndLongitudeAre) {
  const auto polygons = project(std::vector<GeoPolygon>{{box(10, 20, 30, 5), {}}}, kField);
  ASSERT_EQ(polygons.size(), 1U);
  ASSERT_EQ(polygons[0].outer.size(), 4U);
  EXPECT_NEAR(polygons[0].outer[0].x_m, 10, 0.02);
  EXPECT_NEAR(polygons[0].outer[0].y_m, 20, 0.02);
  EXPECT_NEAR(polygons[0].outer[2].x_m, 40, 0.05);
  EXPECT_NEAR(polygons[0].outer[2].y_m, 25, 0.05);
}
TEST(ZoneProjection, IsThatOfTracks) {
  const GeographicLib::LocalCartesian frame(kField.latitude_deg, kField.longitude_deg,
                                            kField.altitude_m);
  const GeoPoint corner = at(123, 45);
  double x_m = 0;
  double y_m = 0;
  double z_m = 0;
  frame.Forward(corner.latitude_deg, corner.longitude_deg, kField.altitude_m, x_m, y_m, z_m);
  const auto polygons = project(std::vector<GeoPolygon>{{box(123, 45, 9, 9), {}}}, kField);
  EXPECT_EQ(polygons[0].outer[0], (Point2{x_m, y_m}));
}
TEST(ZoneProjection, StaysOnEarthWhenTheOriginMoves) {
  const GeoPoint there = at(-200, 150);
  const GeodeticPoint moved{there.latitude_deg, there.longitude_deg, 480};
  const std::vector<GeoPolygon> zone = {{box(10, 20, 30, 5), {}}};
  const auto before = project(zone, kField)[0].outer;
  const auto after = project(zone, moved)[0].outer;
  ASSERT_EQ(before.size(), after.size());
  for (std::size_t i = 0; i < before.size(); ++i) {
    EXPECT_NEAR(after[i].x_m, before[i].x_m + 200, 0.1);
    EXPECT_NEAR(after[i].y_m, before[i].y_m - 150, 0.1);
  }
  EXPECT_NEAR(length_m(after[1] - after[0]), length_m(before[1] - before[0]), 1e-3);
}
TEST(ZoneProjection, TurnsTheOuterRingLeftAndHolesRight) {
  GeoPolygon polygon{box(0, 0, 20, 20), {box(5, 5, 5, 5)}};
  for (int i = 0; i < 2; ++i) {
    const auto to = project(std::vector<GeoPolygon>{polygon}, kField);
    EXPECT_GT(signed_area_m2(to[0].outer), 0);
    EXPECT_LT(signed_area_m2(to[0].holes[0]), 0);
    std::reverse(polygon.outer.begin(), polygon.outer.end());
    std::reverse(polygon.holes[0].begin(), polygon.holes[0].end());
  }
}
TEST(ZoneProjection, LeavesOutRepeatedCorners) {
  GeoRing repeated = box(0, 0, 5, 5);
  const GeoPoint first = repeated[0];
  repeated.insert(repeated.begin(), first);
  repeated.push_back(first);
  EXPECT_EQ(project(std::vector<GeoPolygon>{{repeated, {}}}, kField)[0].outer.size(), 4U);
}
TEST(ZoneProjection, KeepsLongEdgesWithinACentimetreOfTheirLatitude) {
  // Ten kilometres along a parallel: a straight line in `map` would be 2 m beside its middle.
  const GeoPolygon polygon{box(-5000, 3000, 10'000, 1000), {}};
  const auto outer = project(std::vector<GeoPolygon>{polygon}, kField)[0].outer;
  const GeographicLib::LocalCartesian frame(kField.latitude_deg, kField.longitude_deg,
                                            kField.altitude_m);
  for (double part = 0; part <= 1; part += 0.001) {
    const double longitude_deg =
        polygon.outer[0].longitude_deg +
        part * (polygon.outer[1].longitude_deg - polygon.outer[0].longitude_deg);
    Point2 true_place;
    double up_m = 0;
    frame.Forward(polygon.outer[0].latitude_deg, longitude_deg, kField.altitude_m, true_place.x_m,
                  true_place.y_m, up_m);
    const MapPolygon line{outer, {}};
    double off_m = 1e9;
    for (std::size_t i = 0; i + 1 < outer.size(); ++i) {
      const Point2 a = outer[i];
      const Point2 b = outer[i + 1];
      const double k = std::clamp(dot(true_place - a, b - a) / squared(b - a), 0.0, 1.0);
      off_m = std::min(off_m, length_m(true_place - (a + k * (b - a))));
    }
    ASSERT_LT(off_m, 0.01) << part;
  }
}
TEST(ZoneProjection, HasNothingOfTheOtherSideOfTheEarth) {
  const GeodeticPoint antipode{-48.0, -169.0, 500};
  EXPECT_TRUE(project(std::vector<GeoPolygon>{{box(-5, -5, 10, 10), {}}}, antipode).empty())
      << "a straight look through the earth would put it around the robot";
  const GeodeticPoint far{49.0, 11.0, 500};
  EXPECT_TRUE(project(std::vector<GeoPolygon>{{box(0, 0, 10, 10), {}}}, far).empty());
  const GeodeticPoint near{48.8, 11.0, 500};
  EXPECT_EQ(project(std::vector<GeoPolygon>{{box(0, 0, 10, 10), {}}}, near).size(), 1U);
}
TEST(ZoneProjection, AboutAnOriginThatIsNoneIsNotTakenForFree) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const double inf = std::numeric_limits<double>::infinity();
  for (const GeodeticPoint& bad :
       {GeodeticPoint{nan, 11, 0}, GeodeticPoint{48, nan, 0}, GeodeticPoint{91, 11, 0},
        GeodeticPoint{48, 11, nan}, GeodeticPoint{48, 11, inf}, GeodeticPoint{48, 11, -inf},
        GeodeticPoint{-48, -169, inf}}) {
    const auto polygons = project(std::vector<GeoPolygon>{{box(0, 0, 10, 10), {}}}, bad);
    ASSERT_EQ(polygons.size(), 1U);
    for (const Point2& corner : polygons[0].outer) EXPECT_FALSE(is_finite(corner));
  }
}
TEST(ZoneProjection, KeepsNameAndKind) {
  const MapZone placed =
      project(zone({{box(0, 0, 5, 5), {}}, {box(9, 9, 5, 5), {}}}, Zone::Kind::keep_in), kField);
  EXPECT_EQ(placed.name, "zone");
  EXPECT_EQ(placed.kind, Zone::Kind::keep_in);
  EXPECT_EQ(placed.polygons.size(), 2U);
}

MapPolygon square_with_a_hole() {
  return {{{0, 0}, {10, 0}, {10, 10}, {0, 10}}, {{{4, 4}, {4, 6}, {6, 6}, {6, 4}}}};
}

TEST(ZoneMeasures, AreaIsWithoutAndPerimeterWithTheHoles) {
  EXPECT_DOUBLE_EQ(area_m2(square_with_a_hole()), 96);
  EXPECT_DOUBLE_EQ(perimeter_m(square_with_a_hole()), 48);
}
TEST(ZoneMeasures, NothingIsFartherThanAnyDistance) {
  EXPECT_EQ(nearest({}, {0, 0}).distance_m, std::numeric_limits<double>::infinity());
}
TEST(ZoneMeasures, InsideIsNoDistanceInAHoleIsTheOneToItsEdge) {
  EXPECT_EQ(nearest({square_with_a_hole()}, {1, 1}).distance_m, 0);
  EXPECT_DOUBLE_EQ(nearest({square_with_a_hole()}, {5.25, 5}).distance_m, 0.75);
}
TEST(ZoneMeasures, BearingCountsFromNorthClockwise) {
  const double quarter_rad = std::acos(0.0);
  const std::vector<MapPolygon> one = {square_with_a_hole()};
  EXPECT_NEAR(nearest(one, {5, -3}).bearing_rad, 0, 1e-12);
  EXPECT_NEAR(nearest(one, {-3, 5}).bearing_rad, quarter_rad, 1e-12);
  EXPECT_NEAR(nearest(one, {5, 13}).bearing_rad, 2 * quarter_rad, 1e-12);
  EXPECT_NEAR(nearest(one, {13, 5}).bearing_rad, 3 * quarter_rad, 1e-12);
  EXPECT_DOUBLE_EQ(nearest(one, {13, 14}).distance_m, 5);
}
TEST(ZoneMeasures, TheNearestOfSeveralCounts) {
  const MapPolygon far{{{100, 0}, {110, 0}, {110, 10}}, {}};
  EXPECT_DOUBLE_EQ(nearest({far, square_with_a_hole()}, {12, 5}).distance_m, 2);
}

}  // namespace
}  // namespace drover::scene
