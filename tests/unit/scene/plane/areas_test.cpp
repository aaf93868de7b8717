#include "scene/plane/areas.h"

#include <gtest/gtest.h>

#include <limits>

#include "drover/angle.h"
#include "tests/unit/scene/plane/shapes.h"

namespace drover::scene {
namespace {

constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();
constexpr double kEndless = std::numeric_limits<double>::infinity();
constexpr double kNear_m = 1e-6;

/// The area's reach towards +x from `y_m`, found by its own points only.
double reach_x_m(const Area& area, double y_m = 0) {
  double inside = 0;
  double outside = 100;
  EXPECT_TRUE(covers(area, inside, y_m));
  for (int i = 0; i < 60; ++i) {
    const double middle = 0.5 * (inside + outside);
    (covers(area, middle, y_m) ? inside : outside) = middle;
  }
  return inside;
}

TEST(Areas, OfAnUprightBoxAreItsFourSides) {
  const Area area = area_of(box(2, 1, 0.4), pose(5, -3, 0.2, about_z(kPi / 2)), kRobot);
  EXPECT_TRUE(covers(area, 5.499, -2.001));
  EXPECT_FALSE(covers(area, 5.501, -3));
  EXPECT_FALSE(covers(area, 5, -1.999));
  EXPECT_TRUE(covers(area, 5, -2.001));
}

TEST(Areas, OfABoxOnItsEdgeAreWhatIsBetweenTheHeights) {
  // A square bar of 1 m about y, on its edge: at height z it is as wide as z, both sides.
  const Quaternion on_edge = about_y(kPi / 4);
  const double half_diagonal_m = std::sqrt(0.5);
  const Area area = area_of(box(1, 4, 1), pose(0, 0, half_diagonal_m, on_edge), kRobot);
  EXPECT_NEAR(reach_x_m(area), kRobot.high_m, kNear_m);
  EXPECT_NEAR(reach_x_m(area, 1.999), kRobot.high_m, kNear_m);
}

TEST(Areas, OfASphereIsItsLargestCircleInside) {
  EXPECT_NEAR(reach_x_m(area_of(sphere(0.5), pose(0, 0, 0.3), kRobot)), 0.5, kNear_m);
  // Hanging with its centre 0.3 m above the robot, lying with it 0.3 m below the clearance.
  EXPECT_NEAR(reach_x_m(area_of(sphere(0.5), pose(0, 0, 0.9), kRobot)), 0.4, kNear_m);
  EXPECT_NEAR(reach_x_m(area_of(sphere(0.5), pose(0, 0, -0.25), kRobot)), 0.4, kNear_m);
}

TEST(Areas, OfAConeIsItsLargestRadiusInside) {
  // Height first: 1 m high, 0.5 m wide at its foot, which is the wide end.
  EXPECT_NEAR(reach_x_m(area_of(cone(1, 0.5), pose(0, 0, 0.5), kRobot)), 0.5 * 0.95, kNear_m);
  // Upside down it is wide at the robot's top.
  EXPECT_NEAR(reach_x_m(area_of(cone(1, 0.5), pose(0, 0, 0.5, about_x(kPi)), kRobot)), 0.5 * 0.6,
              1e-3);
  EXPECT_NEAR(reach_x_m(area_of(cone(1, 0.5), pose(0, 0, 0.7), kRobot)), 0.5, kNear_m);
}

TEST(Areas, OfACylinderAreTheSameAtAllHeights) {
  for (const double z_m : {0.1, 0.5, 1.0})
    EXPECT_NEAR(reach_x_m(area_of(cylinder(1, 0.25), pose(0, 0, z_m), kRobot)), 0.25, kNear_m);
}

TEST(Areas, OfALyingCylinderAreItsLengthAndAtMostAThousandthMore) {
  const Area area = area_of(cylinder(2, 0.3), pose(0, 0, 0.3, about_y(kPi / 2)), kRobot);
  EXPECT_NEAR(reach_x_m(area), 1, kNear_m);
  EXPECT_TRUE(covers(area, 0.999, 0.2999));
  EXPECT_FALSE(covers(area, 0.999, 0.3 * 1.0013));
}

TEST(Areas, OfWhatIsWhollyAboveOrBelowAreNone) {
  for (const SolidPrimitive& shape :
       {box(9, 9, 0.5), sphere(0.25), cylinder(0.5, 9), cone(0.5, 9)}) {
    EXPECT_TRUE(area_of(shape, pose(0, 0, 0.86), kRobot).empty());
    EXPECT_TRUE(area_of(shape, pose(0, 0, -0.21), kRobot).empty());
    EXPECT_FALSE(area_of(shape, pose(0, 0, 0.84), kRobot).empty());
    EXPECT_FALSE(area_of(shape, pose(0, 0, -0.19), kRobot).empty());
  }
}

TEST(Areas, OfAFloorThatEndsAtTheClearanceAreNone) {
  EXPECT_TRUE(area_of(box(9, 9, 1), pose(0, 0, -0.5), Heights{0, 0.6}).empty());
}

TEST(Areas, WithoutBoundsOfHeightAreTheWholeShape) {
  const Heights all{-kEndless, kEndless};
  EXPECT_NEAR(reach_x_m(area_of(cone(1, 0.5), pose(0, 0, 90), all)), 0.5, kNear_m);
  EXPECT_NEAR(reach_x_m(area_of(sphere(0.5), pose(0, 0, 90), all)), 0.5, kNear_m);
  EXPECT_NEAR(reach_x_m(area_of(box(1, 1, 1), pose(0, 0, -90), all)), 0.5, kNear_m);
  EXPECT_NEAR(reach_x_m(area_of(box_mesh(0.5, 3, 4), {}, all)), 0.5, kNear_m);
  EXPECT_FALSE(covers(area_of(Plane{{1, 0, 0, 0}}, pose(2, 0, 0), all), 1.9, 0));
}

TEST(Areas, OfNumbersThatAreNoneAreEverything) {
  for (const double bad : {kNaN, kEndless, -kEndless}) {
    EXPECT_TRUE(covers(area_of(sphere(bad), {}, kRobot), 1e7, -1e7)) << bad;
    EXPECT_TRUE(covers(area_of(sphere(1), pose(bad, 0, 0), kRobot), 1e7, 0)) << bad;
    EXPECT_TRUE(covers(area_of(box(1, bad, 1), {}, kRobot), 1e7, 0)) << bad;
    EXPECT_TRUE(covers(area_of(box(1, 1, 1), pose(0, 0, 0, {1, bad, 0, 0}), kRobot), 1e7, 0));
    EXPECT_TRUE(covers(area_of(Plane{{1, 0, 0, bad}}, {}, kRobot), 1e7, 0)) << bad;
    Mesh mesh = box_mesh(1, 0, 1);
    mesh.vertices[3].x = bad;
    EXPECT_TRUE(covers(area_of(mesh, {}, kRobot), 1e7, 0)) << bad;
  }
  EXPECT_TRUE(covers(area_of(SolidPrimitive{9, {1, 1, 1}}, {}, kRobot), 1e7, 0));
  EXPECT_TRUE(covers(area_of(SolidPrimitive{SolidPrimitive::BOX, {1, 1}}, {}, kRobot), 1e7, 0));
  EXPECT_TRUE(covers(area_of(box(1, -1, 1), {}, kRobot), 1e7, 0));
  EXPECT_TRUE(covers(area_of(Plane{}, {}, kRobot), 1e7, 0));
}

TEST(Areas, BetweenHeightsThatAreNoIntervalAreEverything) {
  for (const Heights wrong : {Heights{kNaN, 1}, Heights{0, kNaN}, Heights{1, 0}, Heights{1, 1}}) {
    for (const SolidPrimitive& shape : {box(1, 1, 1), sphere(1), cylinder(1, 1), cone(1, 1)})
      EXPECT_TRUE(covers(area_of(shape, pose(0, 0, 90), wrong), 1e7, 0)) << int(shape.type);
    EXPECT_TRUE(covers(area_of(Plane{{1, 0, 0, 0}}, {}, wrong), 1e7, 0));
    EXPECT_TRUE(covers(area_of(box_mesh(1, 0, 1), {}, wrong), 1e7, 0));
  }
}

TEST(Areas, OfATurnThatWasNotSetAreThoseWithoutATurn) {
  EXPECT_NEAR(reach_x_m(area_of(box(2, 1, 1), pose(0, 0, 0.3, {0, 0, 0, 0}), kRobot)), 1, kNear_m);
}

TEST(PlaneAreas, TheGroundDoesNotBlock) {
  EXPECT_TRUE(area_of(Plane{{0, 0, 1, 0}}, {}, kRobot).empty());
  EXPECT_TRUE(area_of(Plane{{0, 0, 1, 0}}, {}, Heights{0, 0.6}).empty());
  EXPECT_TRUE(area_of(Plane{{0, 0, -7, 0}}, pose(1, 2, 0, about_z(1)), kRobot).empty());
  EXPECT_TRUE(area_of(Plane{{0, 0, 1, -2}}, {}, kRobot).empty()) << "a ceiling of 2 m";
}

TEST(PlaneAreas, ALevelOneAtTheHeightOfTheRobotBlocksEverything) {
  const Area area = area_of(Plane{{0, 0, 2, -0.6}}, {}, kRobot);  // z = 0.3
  EXPECT_TRUE(covers(area, 0, 0));
  EXPECT_TRUE(covers(area, -1e7, 1e7));
}

TEST(PlaneAreas, TheSignOfDIsThatOfTheMessage) {
  // x - 2 = 0, not unit: the wall is at x = 2.
  const Area area = area_of(Plane{{3, 0, 0, -6}}, {}, kRobot);
  EXPECT_TRUE(covers(area, 2, 0));
  EXPECT_TRUE(covers(area, 2, 1e7));
  EXPECT_FALSE(covers(area, 2.001, 0));
  EXPECT_FALSE(covers(area, 1.999, 0));
  EXPECT_FALSE(covers(area, -2, 0));
}

TEST(PlaneAreas, ItsPoseMovesAndTurnsIt) {
  const Area area = area_of(Plane{{1, 0, 0, -2}}, pose(10, 5, 0, about_z(kPi / 2)), kRobot);
  EXPECT_TRUE(overlaps(disc({-40, 7}, kNear_m), area));
  EXPECT_FALSE(covers(area, -40, 6.999));
}

TEST(PlaneAreas, ATiltedOneIsAStripBetweenTheHeights) {
  // z = x / 2: from x = 0.1 to x = 1.2.
  const Area area = area_of(Plane{{0.5, 0, -1, 0}}, {}, kRobot);
  EXPECT_FALSE(covers(area, 0.099, 50));
  EXPECT_TRUE(covers(area, 0.101, 50));
  EXPECT_TRUE(covers(area, 1.199, -50));
  EXPECT_FALSE(covers(area, 1.201, -50));
}

TEST(PlaneAreas, TwoInOneObjectBlockBoth) {
  const Area area = union_of({area_of(Plane{{1, 0, 0, -2}}, {}, kRobot),
                              area_of(Plane{{0, 1, 0, 3}}, {}, kRobot), Area{}});
  EXPECT_TRUE(overlaps(placed(footprint(), {2.4, 50, 0}), area));
  EXPECT_TRUE(overlaps(placed(footprint(), {-50, -2.7, 0}), area));
  EXPECT_FALSE(overlaps(placed(footprint(), {0, 0, 0}), area));
}

TEST(PlaneAreas, OfGroundAndCeilingsTakeNothingWhereHeightIsNotLookedAt) {
  const Heights all{-kEndless, kEndless};
  for (const Plane& plane : {Plane{{0, 0, 1, 0}}, Plane{{0, 0, -3, 12}}, Plane{{0.1, 0.2, 1, 4}},
                             Plane{{0.69, 0, 0.72, 0}}}) {
    EXPECT_EQ(how_it_lies(plane, pose(0, 0, 0)), PlaneLies::level);
    EXPECT_TRUE(area_of(plane, pose(0, 0, 0), all).empty());
  }
  // Where they count, the same plane takes what it meets.
  EXPECT_FALSE(area_of(Plane{{0.1, 0.2, 1, 4}}, pose(0, 0, 0), kRobot).empty());
}

TEST(PlaneAreas, OfWallsAreWallsWhereHeightIsNotLookedAt) {
  const Heights all{-kEndless, kEndless};
  const Plane wall{{1, 0, 0, -2}};
  EXPECT_EQ(how_it_lies(wall, pose(0, 0, 0)), PlaneLies::upright);
  // Turned about x and back by rounding, and lying turned upright.
  for (const Area& area :
       {area_of(wall, pose(0, 0, 0), all), area_of(Plane{{1, 0, 1e-9, -2}}, pose(0, 0, 0), all),
        area_of(Plane{{0, 0, 1, 0}}, pose(2, 0, 0, about_y(kPi / 2)), all)}) {
    EXPECT_TRUE(overlaps(disc({2.1, 7}, 0.11), area));
    EXPECT_FALSE(overlaps(disc({2.1, 7}, 0.09), area));
    EXPECT_FALSE(covers(area, 0, 0));
  }
}

TEST(PlaneAreas, OfWhatIsNeitherTakeEverythingWhereHeightIsNotLookedAt) {
  const Heights all{-kEndless, kEndless};
  for (const Plane& plane : {Plane{{1, 0, 0.01, -200}}, Plane{{0.72, 0, 0.69, 0}}}) {
    EXPECT_EQ(how_it_lies(plane, pose(0, 0, 0)), PlaneLies::between);
    EXPECT_TRUE(covers(area_of(plane, pose(0, 0, 0), all), 0, 0));
  }
  for (const Plane& none : {Plane{{NAN, 0, 1, 0}}, Plane{{0, 0, 0, 1}}, Plane{{0, 0, 1, NAN}}})
    EXPECT_TRUE(covers(area_of(none, pose(0, 0, 0), all), 0, 0));
}

}  // namespace
}  // namespace drover::scene
