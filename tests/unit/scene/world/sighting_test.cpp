// How well the place of a thing is known that came in a frame of the robot.
#include "scene/world/sighting.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "unit/scene/world/yard.h"

namespace drover::scene {
namespace {

using testing::HasSubstr;
using yard::add_box;
using yard::at;
using yard::only;
using yard::stamp_s;
using yard::Yard;

/// Knows its place to 5 cm and its heading to 0.01 rad, and stands at the origin.
Yard uncertain_yard() {
  Yard yard;
  yard.position_sigma_m = 0.05;
  yard.yaw_sigma_rad = 0.01;
  yard.drive(1, 0);
  return yard;
}

const double kCorner_m = std::hypot(2.5, 0.5);  // the farthest of a box of 1 m, 2 m ahead

TEST(Sighting, OfAnObjectInMapHasNoError) {
  Yard yard = uncertain_yard();
  yard.apply(add_box("box1", at(2, 0)));
  EXPECT_EQ(yard.sigma_of("box1"), 0);
}

TEST(Sighting, HasTheErrorOfThePlaceAndThatOfTheHeadingTimesTheDistance) {
  Yard yard = uncertain_yard();
  EXPECT_EQ(yard.apply(add_box("box1", at(2, 0), "base_link")), "added");
  EXPECT_NEAR(yard.sigma_of("box1"), 0.05 + 0.01 * kCorner_m, 1e-9);
  yard.apply(add_box("box1", at(2, 0)));
  EXPECT_EQ(yard.sigma_of("box1"), 0) << "given anew in map";
}

TEST(Sighting, IsAsGoodAsThePoseWasAtItsStamp) {
  Yard yard = uncertain_yard();
  for (int i = 1; i <= 20; ++i) yard.poses.add(Time{from_s(101 + i * 0.05)}, {0, 0, 0}, 0.2, 0.05);
  yard.now_s = 102;
  CollisionObject message = add_box("box1", at(2, 0), "base_link");
  message.header.stamp = stamp_s(100.5);
  yard.apply(message);
  EXPECT_NEAR(yard.sigma_of("box1"), 0.05 + 0.01 * kCorner_m, 1e-6);
  message.header.stamp = stamp_s(102);
  yard.apply(message);
  EXPECT_NEAR(yard.sigma_of("box1"), 0.2 + 0.05 * kCorner_m, 1e-6);
}

TEST(Sighting, OfASensorCountsFromWhereTheRobotTurns) {
  Yard yard = uncertain_yard();  // the lidar: half a metre ahead, looks to the left
  yard.apply(add_box("box1", at(2, 0), "lidar"));
  EXPECT_NEAR(yard.sigma_of("box1"), 0.05 + 0.01 * std::hypot(1.0, 2.5), 1e-9);
}

TEST(Sighting, FartherAsideThanIsAllowedPlacesNothing) {
  Yard yard;
  yard.yaw_sigma_rad = to_rad(2);
  yard.drive(1, 0);
  EXPECT_EQ(
      yard.apply(add_box("box1", at(4.7, 0), "base_link")),
      "primitive_poses[0]: heading known to 4.0 deg: 5.2 m away that is 0.36 m, allowed: 0.30 "
      "m; wait until the heading is better");
  EXPECT_TRUE(yard.world.objects().empty());
  EXPECT_EQ(yard.apply(add_box("box1", at(3.5, 0), "base_link")), "added");
  EXPECT_EQ(yard.apply(add_box("box2", at(4.7, 0))), "added") << "in map nothing turns";
}

TEST(Sighting, OfAMoveIsItsOwn) {
  Yard yard = uncertain_yard();
  yard.apply(add_box("box1", at(2, 0), "base_link"));
  CollisionObject move = only(CollisionObject::MOVE, "box1");
  move.primitive_poses = {at(7, 8)};
  EXPECT_EQ(yard.apply(move), "moved");
  EXPECT_EQ(yard.sigma_of("box1"), 0);
  move.header.frame_id = "base_link";
  move.primitive_poses = {at(2, 0)};
  EXPECT_EQ(yard.apply(move), "moved");
  EXPECT_NEAR(yard.sigma_of("box1"), 0.05 + 0.01 * kCorner_m, 1e-9);
  move.primitive_poses = {at(20, 0)};
  EXPECT_THAT(yard.apply(move), HasSubstr("primitive_poses[0]: heading known to 1.1 deg"));
  EXPECT_NEAR(yard.sigma_of("box1"), 0.05 + 0.01 * kCorner_m, 1e-9) << "refused: nothing changed";
}

TEST(Sighting, OfAnAppendIsTheWorseOfBoth) {
  Yard yard = uncertain_yard();
  yard.apply(add_box("box1", at(2, 0), "base_link"));
  CollisionObject more = add_box("box1", at(5, 0));
  more.operation = CollisionObject::APPEND;
  EXPECT_EQ(yard.apply(more), "extended");
  EXPECT_NEAR(yard.sigma_of("box1"), 0.05 + 0.01 * kCorner_m, 1e-9);
  more.header.frame_id = "base_link";
  EXPECT_EQ(yard.apply(more), "extended");
  EXPECT_NEAR(yard.sigma_of("box1"), 0.05 + 0.01 * std::hypot(5.5, 0.5), 1e-9);
}

TEST(Sighting, IsRestoredWithItsObject) {
  Yard yard;
  EXPECT_TRUE(yard.world.restore(add_box("box1", at(2, 0)), yard::kOrigin, 0.12).ok());
  EXPECT_EQ(yard.sigma_of("box1"), 0.12);
  CollisionObject more = add_box("box1", at(3, 0));
  more.operation = CollisionObject::APPEND;
  EXPECT_TRUE(yard.world.restore(more, yard::kOrigin, 0.12).ok());
  EXPECT_EQ(yard.sigma_of("box1"), 0.12);
  for (const double sigma_m : {double{NAN}, -0.1, double{INFINITY}})
    EXPECT_FALSE(yard.world.restore(add_box("box1", at(2, 0)), yard::kOrigin, sigma_m).ok());
}

TEST(FarthestPoint, OfEachSolidIsLevelFromTheRobot) {
  const Pose upright{{3, 4, 9}, {}};
  EXPECT_NEAR(farthest_m(SolidPrimitive{SolidPrimitive::SPHERE, {0.5}}, upright, {0, 0}), 5.5,
              1e-9);
  EXPECT_NEAR(farthest_m(SolidPrimitive{SolidPrimitive::CYLINDER, {8, 0.5}}, upright, {0, 0}), 5.5,
              1e-9);
  EXPECT_NEAR(farthest_m(SolidPrimitive{SolidPrimitive::CONE, {8, 0.5}}, upright, {3, 0}), 4.5,
              1e-9);
  EXPECT_NEAR(farthest_m(yard::box(2, 2, 9), upright, {0, 0}), std::hypot(4, 5), 1e-9);
  const Pose lying{{0, 0, 0}, {std::sqrt(0.5), 0, std::sqrt(0.5), 0}};  // its axis along x
  EXPECT_NEAR(farthest_m(SolidPrimitive{SolidPrimitive::CYLINDER, {8, 0.5}}, lying, {0, 0}), 4.5,
              1e-9);
}

TEST(FarthestPoint, OfAMeshIsItsFarthestVertex) {
  EXPECT_NEAR(farthest_m(yard::mesh(1), at(3, 0), {0, 0}), 4, 1e-9);
  EXPECT_NEAR(farthest_m(yard::mesh(1), at(3, 0, 0, kPi), {0, 0}), std::hypot(3, 1), 1e-9);
}

TEST(FarthestPoint, OfAPlaneIsAsFarAsARobotLooks) {
  EXPECT_EQ(farthest_m(Plane{{1, 0, 0, -2}}, Pose{}, {0, 0}), kPlaneReach_m);
  EXPECT_NEAR(farthest_m(Plane{{2, 0, 0, -80}}, at(2, 0), {0, 0}), 42, 1e-9) << "it is farther";
  EXPECT_EQ(farthest_m(Plane{{0, 0, 1, 0}}, Pose{}, {5, 5}), 0) << "the ground turns into itself";
}

TEST(FarthestPoint, OfWhatCannotBeJudgedIsNowhere) {
  EXPECT_FALSE(std::isfinite(farthest_m(SolidPrimitive{}, Pose{}, {0, 0})));
  EXPECT_FALSE(sigma_of_place({{}, 0, 0.01}, farthest_m(SolidPrimitive{}, Pose{}, {})).ok());
  EXPECT_FALSE(sigma_of_place({{}, 0, NAN}, 1).ok());
}

}  // namespace
}  // namespace drover::scene
