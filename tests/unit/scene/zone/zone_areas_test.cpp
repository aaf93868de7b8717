#include "scene/zone/zone_areas.h"

#include <gtest/gtest.h>

#include <limits>

#include "scene/plane/overlap.h"
#include "scene/plane/sweep.h"
#include "tests/unit/scene/zone/zones.h"

namespace drover::scene {
namespace {

Piece robot_at(double x_m, double y_m) {
  return piece_of({{x_m - 0.5, y_m - 0.4},
                   {x_m + 0.5, y_m - 0.4},
                   {x_m + 0.5, y_m + 0.4},
                   {x_m - 0.5, y_m + 0.4}});
}
/// An L with a hole, and a box apart.
std::vector<GeoPolygon> yard() {
  return {{ring({{0, 0}, {20, 0}, {20, 10}, {10, 10}, {10, 20}, {0, 20}}), {box(3, 3, 4, 4)}},
          {box(30, 0, 5, 5), {}}};
}

bool may_be(const KeepIn& keep_in, const Piece& robot) {
  for (const Area& area : keep_in.areas)
    if (is_inside(area, robot)) return true;
  return false;
}

TEST(ZoneAreas, OfAKeepOutBlockItsInsideButNotItsHolesNorItsBay) {
  const Area area = keep_out_area(project(zone(yard()), kField));
  EXPECT_TRUE(overlaps(robot_at(15, 5), area)) << "wholly inside, away from every edge";
  EXPECT_TRUE(overlaps(robot_at(0, -0.3), area));
  EXPECT_TRUE(overlaps(robot_at(32, 2), area)) << "its second polygon";
  EXPECT_TRUE(overlaps(robot_at(3, 5), area)) << "half in the hole";
  EXPECT_FALSE(overlaps(robot_at(5, 5), area)) << "in the hole";
  EXPECT_FALSE(overlaps(robot_at(15, 15), area)) << "in the bay";
  EXPECT_FALSE(overlaps(robot_at(0, -0.5), area));
}
TEST(ZoneAreas, OfAKeepInHoldTheWholeFootprint) {
  const KeepIn areas = keep_in_areas({project(zone(yard(), Zone::Kind::keep_in), kField)});
  EXPECT_TRUE(may_be(areas, robot_at(15, 5)));
  EXPECT_TRUE(may_be(areas, robot_at(32, 2)));
  EXPECT_FALSE(may_be(areas, robot_at(5, 5))) << "in the hole";
  EXPECT_FALSE(may_be(areas, robot_at(3, 5))) << "half in the hole";
  EXPECT_FALSE(may_be(areas, robot_at(15, 15))) << "in the bay";
  EXPECT_FALSE(may_be(areas, robot_at(19.7, 5))) << "half outside";
  EXPECT_FALSE(may_be(areas, robot_at(25, 2)));
}
TEST(ZoneAreas, OfPolygonsThatOverlapAreTheirUnion) {
  const std::vector<GeoPolygon> both = {{box(0, 0, 10, 10), {}}, {box(5, 0, 10, 10), {}}};
  EXPECT_TRUE(overlaps(robot_at(7.5, 5), keep_out_area(project(zone(both), kField))));
  const KeepIn areas = keep_in_areas({project(zone(both, Zone::Kind::keep_in), kField)});
  EXPECT_TRUE(may_be(areas, robot_at(7.5, 5)));
  EXPECT_TRUE(may_be(areas, robot_at(1, 5)));
  EXPECT_TRUE(may_be(areas, robot_at(14, 5)));
}
TEST(ZoneAreas, OfAFenceThatIsTooFarAwayHoldNobody) {
  const GeodeticPoint elsewhere{10, 11, 0};
  const KeepIn areas = keep_in_areas({project(zone(yard(), Zone::Kind::keep_in), elsewhere)});
  ASSERT_EQ(areas.areas.size(), 1U) << "none at all would be no bound";
  EXPECT_FALSE(may_be(areas, robot_at(0, 0)));
  const Step here{};
  const FreeWay way = first_exit(areas.areas, robot_at(0, 0), {&here, 1});
  EXPECT_TRUE(way.blocked);
  EXPECT_TRUE(way.at_start);
}
TEST(ZoneAreas, OfAKeepInHaveItsNameEach) {
  Zone first = zone(yard(), Zone::Kind::keep_in);
  first.name = "first";
  Zone far = zone({{box(0, 0, 5, 5), {}}}, Zone::Kind::keep_in);
  far.name = "far";
  const GeodeticPoint elsewhere{10, 11, 0};
  const KeepIn keep_in = keep_in_areas(
      {project(zone(yard()), kField), project(first, kField), project(far, elsewhere)});
  EXPECT_EQ(keep_in.names, (std::vector<std::string>{"first", "first", "far"}));
  EXPECT_EQ(keep_in.areas.size(), 3U);
}
TEST(ZoneAreas, OfKeepOutsAloneAreNoFence) {
  EXPECT_TRUE(keep_in_areas({project(zone(yard()), kField)}).areas.empty());
  EXPECT_TRUE(keep_in_areas({}).areas.empty());
}
TEST(ZoneAreas, AboutAnOriginThatIsNoneLetNobodyGo) {
  const GeodeticPoint bad{std::numeric_limits<double>::quiet_NaN(), 11, 0};
  EXPECT_TRUE(overlaps(robot_at(100, 100), keep_out_area(project(zone(yard()), bad))));
  const KeepIn areas = keep_in_areas({project(zone(yard(), Zone::Kind::keep_in), bad)});
  EXPECT_FALSE(may_be(areas, robot_at(5, 5)));
}
TEST(ZoneAreas, StayWithTheFenceWhenTheOriginMoves) {
  const Zone fence = zone({{box(-10, -10, 20, 20), {}}}, Zone::Kind::keep_in);
  const GeoPoint there = at(100, 50);
  const GeodeticPoint moved{there.latitude_deg, there.longitude_deg, kField.altitude_m};
  EXPECT_TRUE(may_be(keep_in_areas({project(fence, kField)}), robot_at(9, 9)));
  EXPECT_TRUE(may_be(keep_in_areas({project(fence, moved)}), robot_at(9 - 100, 9 - 50)));
  EXPECT_FALSE(may_be(keep_in_areas({project(fence, moved)}), robot_at(9, 9)));
  EXPECT_FALSE(may_be(keep_in_areas({project(fence, moved)}), robot_at(10 - 100, 9 - 50)));
}

}  // namespace
}  // namespace drover::scene
