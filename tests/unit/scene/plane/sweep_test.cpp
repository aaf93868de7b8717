#include "scene/plane/sweep.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <limits>

#include "tests/unit/scene/plane/shapes.h"

namespace drover::scene {
namespace {

constexpr double kStride_m = 0.1;

Field field_of(std::initializer_list<std::pair<const char*, Area>> objects) {
  Field field;
  for (const auto& [name, area] : objects) field.put(name, area);
  return field;
}
Area pole(double x_m, double y_m) {
  return area_of(cylinder(2, 0.01), pose(x_m, y_m, 1), kRobot);
}
std::vector<Step> ahead(double length_m) {
  return arc_steps({0, 0, 0}, length_m, 0, kStride_m);
}

TEST(Sweep, EndsAtAWallAcrossTheWay) {
  const Field field = field_of({{"wall", area_of(box(0.2, 4, 1), pose(2, 0, 0.5), kRobot)}});
  const FreeWay way = first_contact(field, footprint(0.05), ahead(5));
  EXPECT_TRUE(way.blocked);
  EXPECT_FALSE(way.at_start);
  EXPECT_LE(way.free_m, 1.9 - 0.5);
  EXPECT_GE(way.free_m, 1.9 - 0.5 - kResolution_m);
  EXPECT_EQ(field.name(way.object), "wall");
  EXPECT_NEAR(way.where.x_m, 1.9, 1e-9);
  EXPECT_NEAR(way.pose.x_m, way.free_m, 1e-12);
}

TEST(Sweep, FindsWhatTheRobotMayComeToBesideItsWay) {
  const Field field = field_of({{"pole", pole(3, 0.35 + 0.01 + 0.1)}});
  auto steps = ahead(5);
  EXPECT_FALSE(first_contact(field, footprint(), steps).blocked);
  for (Step& step : steps) step.off_m = 0.05 * step.driven_m;
  const FreeWay way = first_contact(field, footprint(), steps);
  EXPECT_TRUE(way.blocked);
  EXPECT_NEAR(way.free_m, 2.5, 0.06) << "there it is off by 12 cm, and its front is 0.45 m ahead";
  EXPECT_EQ(way.pose.y_m, 0);
  for (Step& step : steps) step.off_m = 0.03 * step.driven_m;
  EXPECT_GT(first_contact(field, footprint(), steps).free_m, way.free_m);
  // Between two steps, however far apart.
  const std::vector<Step> long_step{{{0, 0, 0}, 0, 0, 0}, {{5, 0, 0}, 5, 0, 0.25}};
  EXPECT_NEAR(first_contact(field, footprint(), long_step).free_m, way.free_m, 0.05);
  steps.front().off_m = 4;
  EXPECT_TRUE(first_contact(field, footprint(), steps).at_start);
}

TEST(Sweep, OfAFreeWayIsAllOfIt) {
  const Field field = field_of({{"wall", area_of(box(0.2, 4, 1), pose(9, 0, 0.5), kRobot)}});
  const FreeWay way = first_contact(field, footprint(), ahead(5));
  EXPECT_FALSE(way.blocked);
  EXPECT_DOUBLE_EQ(way.free_m, 5);
}

TEST(Sweep, ThatEndsAtTheGoalDoesNotMindAWallHalfAMetreBehindIt) {
  const Field field = field_of({{"wall", area_of(Plane{{1, 0, 0, -5.96}}, {}, kRobot)}});
  const std::vector<Point2> line{{0, 0}, {5, 0}};
  EXPECT_FALSE(first_contact(field, footprint(), track_steps({0, 0, 0}, line, 0.1)).blocked);
  const std::vector<Point2> longer{{0, 0}, {6, 0}};
  EXPECT_TRUE(first_contact(field, footprint(), track_steps({0, 0, 0}, longer, 0.1)).blocked);
}

TEST(Sweep, FindsAPoleOfTwoCentimetresBetweenTwoSteps) {
  // Poses a whole robot and more apart: the pole stands in neither.
  const std::vector<Step> steps{{{0, 0, 0}, 0, 0}, {{1.5, 0, 0}, 1.5, 0}};
  for (const double y_m : {-0.34, -0.1, 0.0, 0.35}) {
    const Field field = field_of({{"pole", pole(0.7, y_m)}});
    const FreeWay way = first_contact(field, footprint(), steps);
    EXPECT_TRUE(way.blocked) << y_m;
    EXPECT_NEAR(way.free_m, 0.7 - 0.45 - 0.01, kResolution_m) << y_m;
    EXPECT_LE(way.free_m, 0.7 - 0.45 - 0.01) << y_m;
  }
  EXPECT_FALSE(first_contact(field_of({{"pole", pole(0.7, 0.361)}}), footprint(), steps).blocked);
}

TEST(Sweep, PassesABoxThreeCentimetresBesideTheTrack) {
  const auto beside = [](double gap_m) {
    return field_of(
        {{"box", area_of(box(0.5, 0.5, 0.55), pose(2, 0.35 + gap_m + 0.25, 0.325), kRobot)}});
  };
  const std::vector<Point2> line{{0, 0}, {5, 0}};
  const auto steps = track_steps({0, 0, 0}, line, stride_m(footprint()));
  EXPECT_FALSE(first_contact(beside(0.03), footprint(0.029), steps).blocked);
  EXPECT_TRUE(first_contact(beside(0.03), footprint(0.031), steps).blocked);
}

TEST(Sweep, OfAPivotBesideAWallEndsWhereTheCornerReachesIt) {
  // 0.9 x 0.7 m turns within 0.57 m; the wall is 0.45 m beside it.
  const Field field = field_of({{"wall", area_of(Plane{{0, 1, 0, -0.45}}, {}, kRobot)}});
  const double reach_m = std::hypot(0.45, 0.35);
  const double angle_rad = std::asin(0.45 / reach_m) - std::asin(0.35 / reach_m);
  for (const double side : {1.0, -1.0}) {
    const FreeWay way =
        first_contact(field, footprint(), pivot_steps({0, 0, 0}, side * to_rad(90.0)));
    EXPECT_TRUE(way.blocked);
    EXPECT_LE(way.free_rad, angle_rad + 1e-9);
    EXPECT_GE(way.free_rad, angle_rad - 1.5 * kResolution_m / reach_m);
    EXPECT_EQ(way.free_m, 0);
  }
  const Field farther = field_of({{"wall", area_of(Plane{{0, 1, 0, -0.5702}}, {}, kRobot)}});
  EXPECT_FALSE(first_contact(farther, footprint(), pivot_steps({0, 0, 0}, 2 * kPi)).blocked);
}

TEST(Sweep, InACurveTheOuterCornerRunsOutsideTheSideLine) {
  // Driven about (0, 1): the front right corner is hypot(0.45, 1.35) = 1.423 m from there, the
  // side 1.35 m.
  const auto steps = twist_steps({0, 0, 0}, 0.5, 0.5, kPi, kStride_m);
  const auto pole_at = [](double away_m) { return field_of({{"pole", pole(away_m + 0.01, 1)}}); };
  EXPECT_TRUE(first_contact(pole_at(1.42), footprint(), steps).blocked);
  EXPECT_FALSE(first_contact(pole_at(1.425), footprint(), steps).blocked);
}

TEST(Sweep, BackwardsFindsWhatIsBehind) {
  const Field field = field_of({{"box", area_of(box(1, 1, 1), pose(-2, 0, 0.5), kRobot)}});
  const auto steps = twist_steps({0, 0, 0}, -0.3, 0, 3, kStride_m);
  const FreeWay way = first_contact(field, footprint(), steps);
  EXPECT_TRUE(way.blocked);
  EXPECT_NEAR(way.free_m, 1.05, kResolution_m);
  EXPECT_FALSE(first_contact(field, footprint(), ahead(3)).blocked);
}

TEST(Sweep, BetweenTwoPlanesIsFreeAndAcrossThemIsNot) {
  const Field field = field_of({{"left", area_of(Plane{{0, 1, 0, -0.4}}, {}, kRobot)},
                                {"right", area_of(Plane{{0, 1, 0, 0.4}}, {}, kRobot)},
                                {"ground", area_of(Plane{{0, 0, 1, 0}}, {}, kRobot)}});
  EXPECT_FALSE(first_contact(field, footprint(0.04), ahead(50)).blocked);
  const FreeWay way = first_contact(field, footprint(), arc_steps({0, 0, 0}, 3, 0.5, 0.1));
  EXPECT_TRUE(way.blocked);
  EXPECT_EQ(field.name(way.object), "left");
}

TEST(Sweep, IntoTheMouthOfAConcaveMeshEndsAtItsBottom) {
  // A mouth of 1 m, open towards the robot. (Lid and floor are no U, but out of the interval.)
  const Mesh horseshoe = pulled_up(
      {{-1, -1}, {1, -1}, {1, -0.5}, {-0.5, -0.5}, {-0.5, 0.5}, {1, 0.5}, {1, 1}, {-1, 1}}, 0, 1);
  const Area area = area_of(horseshoe, pose(3, 0, 0, about_z(kPi)), kRobot);
  const FreeWay way = first_contact(field_of({{"u", area}}), footprint(), ahead(5));
  EXPECT_TRUE(way.blocked);
  EXPECT_NEAR(way.free_m, 3.5 - 0.45, kResolution_m);
}

TEST(Sweep, InsideAClosedMeshIsBlockedAtTheStart) {
  const Field field = field_of({{"house", area_of(box_mesh(10, -1, 3), {}, kRobot)}});
  const FreeWay way = first_contact(field, footprint(), ahead(5));
  EXPECT_TRUE(way.blocked);
  EXPECT_TRUE(way.at_start);
  EXPECT_EQ(way.free_m, 0);
}

TEST(Sweep, NamesTheFirstAlongTheWayAndOfThoseAtOncePlaceTheFirstByName) {
  Field field = field_of({{"a", pole(3, 0)}, {"b", pole(1, 0.2)}, {"c", pole(1, -0.2)}});
  EXPECT_EQ(field.name(first_contact(field, footprint(), ahead(5)).object), "b");
  EXPECT_TRUE(field.remove("b"));
  EXPECT_EQ(field.name(first_contact(field, footprint(), ahead(5)).object), "c");
  EXPECT_FALSE(field.remove("b"));
  field.put("c", pole(9, 0));
  EXPECT_EQ(field.name(first_contact(field, footprint(), ahead(5)).object), "a");
  field.put("d", pole(0, 9));
  field.put("d", pole(2, 0));
  EXPECT_EQ(field.name(first_contact(field, footprint(), ahead(5)).object), "d");
}

TEST(Sweep, FindsAPoleWhereverOnTheWayItStands) {
  for (int cm = 50; cm < 540; ++cm) {
    const FreeWay way =
        first_contact(field_of({{"pole", pole(0.01 * cm, 0.1)}}), footprint(), ahead(5));
    EXPECT_TRUE(way.blocked) << cm;
    EXPECT_NEAR(way.free_m, 0.01 * cm - 0.46, kResolution_m) << cm;
  }
}

TEST(Sweep, OfASmallRoundBodyInLongStepsIsTheSame) {
  for (int cm = 10; cm < 500; cm += 3) {
    const Field field = field_of({{"pole", pole(0.01 * cm, 0)}});
    const FreeWay way = first_contact(field, disc({0, 0}, 0.04), arc_steps({0, 0, 0}, 5, 0, 0.25));
    EXPECT_TRUE(way.blocked) << cm;
    EXPECT_NEAR(way.free_m, 0.01 * cm - 0.05, kResolution_m) << cm;
  }
}

TEST(Sweep, OverALongWayLooksAroundAgain) {
  // Farther than is looked at together, and one of many.
  Field field;
  for (int i = 0; i < 300; ++i) field.put("p" + std::to_string(i), pole(0.5 * i, 2));
  field.put("q", pole(140, 0));
  const FreeWay way = first_contact(field, footprint(), ahead(150));
  EXPECT_EQ(field.name(way.object), "q");
  EXPECT_NEAR(way.free_m, 140 - 0.46, kResolution_m);
}

TEST(Sweep, OfWhatIsNoNumberIsNeverFree) {
  constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();
  const Field nothing;
  for (const FreeWay& way : {first_contact(nothing, footprint(), arc_steps({0, 0, 0}, kNaN, 0, 1)),
                             first_contact(nothing, footprint(), ahead(kNaN)),
                             first_contact(nothing, footprint(), arc_steps({0, kNaN, 0}, 1, 0, 1)),
                             first_contact(nothing, piece_of({{0, 0}, {kNaN, 1}}), ahead(1)),
                             first_contact(nothing, footprint(kNaN), ahead(1))}) {
    EXPECT_TRUE(way.blocked);
    EXPECT_EQ(way.object, kNoObject);
    EXPECT_EQ(way.free_m, 0);
  }
  const Field unknown = field_of({{"unknown", area_of(sphere(kNaN), {}, kRobot)}});
  EXPECT_TRUE(first_contact(unknown, footprint(), ahead(1)).at_start);
}

TEST(Sweep, CoversEachPoseBetweenItsEnds) {
  const Pose2 from{0.3, -0.2, 0.7};
  for (const auto& to :
       {Pose2{0.4, -0.1, 0.75}, Pose2{0.3, -0.2, 0.9}, Pose2{0.1, -0.3, 0.6}, Pose2{2, 2, 3}}) {
    const Piece hull = swept(footprint(0.02), from, to);
    for (int i = 0; i <= 20; ++i)
      for (const Point2 corner : placed(footprint(), between(from, to, i / 20.0)).corners)
        EXPECT_TRUE(overlaps(hull, disc(corner, 0)));
  }
}

TEST(KeepIn, EndsWhereThePartThatIsFarthestOutWouldLeave) {
  const std::vector<Area> zones{area_of_rings({{{-5, -5}, {5, -5}, {5, 5}, {-5, 5}}})};
  const FreeWay way = first_exit(zones, footprint(0.05), ahead(9));
  EXPECT_TRUE(way.blocked);
  EXPECT_LE(way.free_m, 4.5);
  EXPECT_GE(way.free_m, 4.5 - kResolution_m);
  EXPECT_NEAR(way.where.x_m, 5, 1e-9);
  EXPECT_FALSE(first_exit(zones, footprint(), ahead(4.5)).blocked);
  EXPECT_FALSE(first_exit({}, footprint(), ahead(4.5)).blocked);
}

TEST(KeepIn, OfAConcaveZoneIsNotLeftAcrossItsMouth) {
  const std::vector<Area> zones{
      area_of_rings({{{-1, -1}, {1, -1}, {1, 9}, {3, 9}, {3, -1}, {5, -1}, {5, 11}, {-1, 11}}})};
  const FreeWay way = first_exit(zones, footprint(), ahead(4));
  EXPECT_TRUE(way.blocked);
  EXPECT_NEAR(way.free_m, 0.55, kResolution_m);
}

TEST(KeepIn, FromOneZoneIntoAnotherThatOverlapsItIsFree) {
  const std::vector<Area> zones{area_of_rings({{{-2, -2}, {3, -2}, {3, 2}, {-2, 2}}}),
                                area_of_rings({{{1, -3}, {9, -3}, {9, 3}, {1, 3}}})};
  EXPECT_FALSE(first_exit(zones, footprint(), ahead(8)).blocked);
  const FreeWay way = first_exit(zones, footprint(), ahead(10));
  EXPECT_NEAR(way.free_m, 8.55, kResolution_m);
  EXPECT_EQ(way.object, 1U);
}

TEST(KeepIn, OutsideOfAllIsBlockedAtTheStart) {
  const std::vector<Area> zones{area_of_rings({{{2, 2}, {4, 2}, {4, 4}, {2, 4}}}), Area{}};
  EXPECT_TRUE(first_exit(zones, footprint(), ahead(1)).at_start);
}

}  // namespace
}  // namespace drover::scene
