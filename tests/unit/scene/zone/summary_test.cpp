#include "scene/zone/summary.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "tests/unit/scene/zone/zones.h"

namespace drover::scene {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

constexpr double kQuarter_rad = std::numbers::pi / 2;

GeodeticPoint robot_at(double x_m, double y_m) {
  const GeoPoint point = at(x_m, y_m);
  return {point.latitude_deg, point.longitude_deg, kField.altitude_m};
}

TEST(ZoneSummary, CountsAndMeasures) {
  const auto summary = summarise(
      zone({{box(0, 0, 100, 50), {box(10, 10, 5, 5)}}, {box(200, 0, 10, 10), {}}}), std::nullopt);
  EXPECT_EQ(summary.polygons, 2U);
  EXPECT_EQ(summary.holes, 1U);
  EXPECT_EQ(summary.points, 12U);
  EXPECT_NEAR(summary.area_m2, 5000 - 25 + 100, 5);
  EXPECT_NEAR(summary.perimeter_m, 300 + 20 + 40, 0.5);
  EXPECT_FALSE(summary.from_robot);
  EXPECT_THAT(summary.warnings, IsEmpty());
}
TEST(ZoneSummary, TellsDistanceAndBearingFromTheRobot) {
  const auto summary = summarise(zone({{box(0, 0, 10, 10), {}}}), robot_at(-30, 5));
  ASSERT_TRUE(summary.from_robot);
  EXPECT_NEAR(summary.from_robot->distance_m, 30, 0.05);
  EXPECT_NEAR(summary.from_robot->bearing_rad, kQuarter_rad, 0.01);
  EXPECT_THAT(summary.warnings, IsEmpty());
}
TEST(ZoneSummary, WarnsOfARobotOutsideOfItsFenceOrInsideOfAKeepOut) {
  const std::vector<GeoPolygon> polygons = {{box(0, 0, 10, 10), {box(4, 4, 2, 2)}}};
  const auto warnings = [&](Zone::Kind kind, double x_m, double y_m) {
    return summarise(zone(polygons, kind), robot_at(x_m, y_m)).warnings;
  };
  EXPECT_THAT(warnings(Zone::Kind::keep_in, -5, 5), ElementsAre(HasSubstr("outside")));
  EXPECT_THAT(warnings(Zone::Kind::keep_in, 5, 5), ElementsAre(HasSubstr("outside"))) << "a hole";
  EXPECT_THAT(warnings(Zone::Kind::keep_in, 2, 2), IsEmpty());
  EXPECT_THAT(warnings(Zone::Kind::keep_out, 2, 2), ElementsAre(HasSubstr("inside")));
  EXPECT_THAT(warnings(Zone::Kind::keep_out, -5, 5), IsEmpty());
}
TEST(ZoneSummary, SeesThatLatitudeAndLongitudeAreSwappedWhereBothArePlausible) {
  GeoRing swapped;
  for (const GeoPoint& point : box(20, 0, 10, 10))
    swapped.push_back({point.longitude_deg, point.latitude_deg});
  const auto summary = summarise(zone({{swapped, {}}}), robot_at(0, 0));
  EXPECT_GT(summary.from_robot->distance_m, 1e6);
  ASSERT_EQ(summary.warnings.size(), 1U);
  EXPECT_THAT(summary.warnings[0], HasSubstr("swapped it would be 20"));
}
TEST(ZoneSummary, WarnsOfAZoneThatIsElsewhere) {
  const auto summary = summarise(zone({{box(0, 300'000, 10, 10), {}}}), robot_at(0, 0));
  ASSERT_EQ(summary.warnings.size(), 1U);
  EXPECT_EQ(summary.warnings[0], "is 300 km from the robot");
  EXPECT_NEAR(summary.from_robot->bearing_rad, 0, 0.01);
}

TEST(DatumShift, IsNothingUnderTheSameOriginOrWithoutOne) {
  Zone fence = zone({{box(0, 0, 10, 10), {}}});
  EXPECT_FALSE(datum_shift(fence, kField));
  EXPECT_EQ(datum_shift_text(fence, kField), "");
  fence.datum.reset();
  EXPECT_FALSE(datum_shift(fence, robot_at(1, 1)));
}
TEST(DatumShift, TellsWhereThePresentOriginIs) {
  const Zone fence = zone({{box(0, 0, 10, 10), {}}});
  GeodeticPoint moved = robot_at(1.5, -2);
  moved.altitude_m += 0.3;
  const auto shift = datum_shift(fence, moved);
  ASSERT_TRUE(shift);
  EXPECT_NEAR(shift->east_m, 1.5, 0.005);
  EXPECT_NEAR(shift->north_m, -2, 0.005);
  EXPECT_NEAR(shift->up_m, 0.3, 0.001);
  EXPECT_NEAR(shift->horizontal_m, 2.5, 0.005);
}
TEST(DatumShift, IsToldWhereItMayBeAMovedBaseStationOnly) {
  const Zone fence = zone({{box(0, 0, 10, 10), {}}});
  EXPECT_THAT(datum_shift_text(fence, robot_at(1.5, -2)),
              testing::AllOf(HasSubstr("2.5 m beside"), HasSubstr("1.5 m east"),
                             HasSubstr("base station")));
  EXPECT_EQ(datum_shift_text(fence, robot_at(500, 0)), "") << "another place";
  GeodeticPoint higher = kField;
  higher.altitude_m += 0.5;
  EXPECT_EQ(datum_shift_text(fence, higher), "") << "no fence stands elsewhere by it";
}

}  // namespace
}  // namespace drover::scene
