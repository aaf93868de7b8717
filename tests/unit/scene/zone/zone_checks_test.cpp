#include "scene/zone/zone_checks.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "tests/unit/scene/zone/zones.h"

namespace drover::scene {
namespace {

using testing::HasSubstr;

ZoneFault fault_of(const std::vector<GeoPolygon>& polygons) {
  return find_fault(polygons).value_or(ZoneFault{{}, {}, {}, "good"});
}

void expect_fault(const std::vector<GeoPolygon>& polygons, const std::string& path,
                  const std::string& why) {
  const ZoneFault fault = fault_of(polygons);
  EXPECT_EQ(fault.path(), path) << fault.why;
  EXPECT_THAT(fault.why, HasSubstr(why));
}

GeoRing circle(int points, double radius_m) {
  GeoRing ring;
  for (int i = 0; i < points; ++i) {
    const double angle_rad = 2 * std::numbers::pi * i / points;
    ring.push_back(at(radius_m * std::cos(angle_rad), radius_m * std::sin(angle_rad)));
  }
  return ring;
}

TEST(ZoneChecks, TakeAPolygonWithHolesInEitherDirection) {
  GeoPolygon polygon{box(0, 0, 20, 10), {box(2, 2, 3, 3), box(10, 2, 3, 3)}};
  EXPECT_FALSE(find_fault({polygon}));
  std::reverse(polygon.outer.begin(), polygon.outer.end());
  std::reverse(polygon.holes[1].begin(), polygon.holes[1].end());
  EXPECT_FALSE(find_fault({polygon, {box(30, 0, 5, 5), {}}}));
}

TEST(ZoneChecks, RefuseNoPolygonAtAll) {
  expect_fault({}, "polygons", "none");
}

TEST(ZoneChecks, RefuseWhatIsNoNumberOrOutOfRangeWithItsPoint) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const double inf = std::numeric_limits<double>::infinity();
  for (const double bad : {nan, inf, -inf, 90.001, -91.0}) {
    GeoRing ring = box(0, 0, 5, 5);
    ring[2].latitude_deg = bad;
    expect_fault({{ring, {}}}, "polygons[0].outer.points[2]", "latitude");
  }
  for (const double bad : {nan, inf, 180.001, -200.0}) {
    GeoRing hole = box(1, 1, 2, 2);
    hole[3].longitude_deg = bad;
    expect_fault({{box(0, 0, 5, 5), {box(3.5, 3.5, 1, 1), hole}}}, "polygons[0].holes[1].points[3]",
                 "longitude");
  }
}

TEST(ZoneChecks, RefuseFewerThanThreeDifferentPoints) {
  for (const GeoRing& ring :
       {GeoRing{}, GeoRing{at(0, 0)}, GeoRing{at(0, 0), at(5, 0)},
        GeoRing{at(0, 0), at(5, 0), at(0, 0), at(5, 0)}, GeoRing(5, at(1, 1))})
    expect_fault({{ring, {}}}, "polygons[0].outer", "three different");
  expect_fault({{box(0, 0, 5, 5), {GeoRing{at(1, 1), at(2, 2)}}}}, "polygons[0].holes[0]",
               "three different");
}

TEST(ZoneChecks, PassOverRepeatedPoints) {
  GeoRing ring = box(0, 0, 5, 5);
  const GeoPoint first = ring[0];
  const GeoPoint second = ring[1];
  ring.insert(ring.begin() + 1, second);
  ring.insert(ring.begin(), first);
  ring.push_back(first);
  EXPECT_FALSE(find_fault({{ring, {}}}));
}

TEST(ZoneChecks, RefuseWhatHasNoArea) {
  expect_fault({{ring({{0, 0}, {5, 0}, {10, 0}}), {}}}, "polygons[0].outer", "no area");
  expect_fault({{box(0, 0, 0.005, 0.005), {}}}, "polygons[0].outer", "no area");
  EXPECT_FALSE(find_fault({{box(0, 0, 0.02, 0.02), {}}}));
}

TEST(ZoneChecks, RefuseEdgesThatCrossWithBothPoints) {
  EXPECT_EQ(fault_of({{ring({{0, 0}, {10, 0}, {5, 3}, {5, 10}}), {}}}).why, "good") << "concave";
  expect_fault({{ring({{0, 0}, {10, 0}, {1, 6}, {10, 8}}), {}}}, "polygons[0].outer.points[1]",
               "polygons[0].outer.points[3]");
}

TEST(ZoneChecks, RefuseAnEdgeThatTouchesAnotherOne) {
  // The fourth point is the middle of the first edge.
  expect_fault({{ring({{0, 0}, {10, 0}, {10, 5}, {5, 0}, {0, 5}}), {}}},
               "polygons[0].outer.points[0]", "crosses or touches");
}

TEST(ZoneChecks, RefuseASpikeThatFoldsBackOntoItself) {
  // Out to the point and back on the same line.
  EXPECT_THAT(fault_of({{ring({{0, 0}, {10, 0}, {10, 5}, {20, 5}, {15, 5}, {10, 10}}), {}}}).why,
              HasSubstr("crosses or touches"));
}

TEST(ZoneChecks, RefuseAHoleThatCrossesLiesOutsideOrInsideAnother) {
  const GeoRing outer = box(0, 0, 10, 10);
  EXPECT_THAT(fault_of({{outer, {box(8, 4, 4, 2)}}}).why, HasSubstr("crosses or touches"));
  expect_fault({{outer, {box(20, 0, 4, 4)}}}, "polygons[0].holes[0]", "outside");
  expect_fault({{outer, {box(1, 1, 8, 8), box(3, 3, 2, 2)}}}, "polygons[0].holes[1]",
               "inside of polygons[0].holes[0]");
}

TEST(ZoneChecks, RefuseMorePointsThanAZoneHas) {
  EXPECT_FALSE(find_fault({{circle(10'000, 100), {}}}));
  expect_fault({{circle(10'001, 100), {}}}, "polygons", "10001 points");
  expect_fault({{circle(6'000, 100), {}}, {circle(6'000, 50), {}}}, "polygons", "12000 points");
}

TEST(ZoneChecks, RefuseWhatReachesTooFar) {
  EXPECT_FALSE(find_fault({{box(0, 0, 12'000, 12'000), {}}}));
  expect_fault({{box(0, 0, 20'000, 5'000), {}}}, "polygons", "at most 20000 m");
  expect_fault({{box(0, 0, 10, 10), {}}, {box(25'000, 0, 10, 10), {}}}, "polygons", "at most");
}

TEST(ZoneChecks, SayThatACrossingOfThe180thMeridianHasToBeCut) {
  const GeoRing across = {{10, 179.999}, {10, -179.999}, {10.001, -179.999}, {10.001, 179.999}};
  expect_fault({{across, {}}}, "polygons", "180th meridian");
}

TEST(ZoneChecks, FindACrossingAmongTenThousandPoints) {
  GeoRing ring = circle(9'998, 100);
  std::swap(ring[4'000], ring[4'001]);
  EXPECT_THAT(fault_of({{ring, {}}}).why, HasSubstr("crosses or touches"));
}

TEST(ZoneChecks, EndInTimeWhereAllEdgesOverlapInX) {
  // A comb whose teeth are all as long as it is wide: every pair of edges is looked at.
  std::vector<Place> comb;
  for (int i = 0; i < 4'990; ++i) {
    comb.push_back({0, i * 0.1});
    comb.push_back({90, i * 0.1 + 0.02});
  }
  comb.push_back({91, 500});
  comb.push_back({91, -1});
  EXPECT_FALSE(find_fault({{ring(comb), {}}}));
}

TEST(ZoneChecks, WantANameThatCanBeShownAndStored) {
  Zone named = zone({{box(0, 0, 5, 5), {}}});
  EXPECT_FALSE(check_zone(named));
  for (const char* name : {"", "line\nbreak", "del\x7F", "latin \xE9"}) {
    named.name = name;
    ASSERT_TRUE(check_zone(named)) << name;
    EXPECT_EQ(check_zone(named)->path, "name");
  }
  named.name = std::string(101, 'x');
  EXPECT_THAT(check_zone(named)->why, HasSubstr("101 bytes"));
}

TEST(ZoneChecks, WantADatumOnTheEarth) {
  Zone bad = zone({{box(0, 0, 5, 5), {}}});
  bad.datum->altitude_m = std::numeric_limits<double>::quiet_NaN();
  ASSERT_TRUE(check_zone(bad));
  EXPECT_EQ(check_zone(bad)->path, "datum");
}

TEST(ZoneChecks, LeaveRoomForAHundredZonesAndAHundredThousandPoints) {
  std::vector<Zone> stored;
  for (int i = 0; i < 100; ++i) {
    stored.push_back(zone({{box(0, 0, 5, 5), {}}}));
    stored.back().name = std::to_string(i);
  }
  Zone added = zone({{box(0, 0, 5, 5), {}}});
  ASSERT_TRUE(check_room(stored, added));
  EXPECT_THAT(check_room(stored, added)->why, HasSubstr("at most 100"));
  added.name = "7";
  EXPECT_FALSE(check_room(stored, added)) << "it replaces one";
  for (std::size_t i = 0; i < 10; ++i) stored[i].polygons = {{circle(9'900, 100), {}}};
  EXPECT_FALSE(check_room(stored, added));
  stored[90].polygons = {{circle(9'900, 100), {}}};
  stored[91].polygons = {{circle(9'900, 100), {}}};
  ASSERT_TRUE(check_room(stored, added));
  EXPECT_THAT(check_room(stored, added)->why, HasSubstr("at most 100000"));
}

}  // namespace
}  // namespace drover::scene
