#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "drover/rotation.h"
#include "unit/scene/constraint/judged.h"

namespace drover::scene {
namespace {

using testing::HasSubstr;
using yard::Judged;

OrientationConstraint turn(double x, double y, double z, const Quaternion& wanted = {}) {
  OrientationConstraint orientation;
  orientation.header.frame_id = "map";
  orientation.link_name = "base_link";
  orientation.orientation = wanted;
  orientation.absolute_x_axis_tolerance = x;
  orientation.absolute_y_axis_tolerance = y;
  orientation.absolute_z_axis_tolerance = z;
  return orientation;
}

TEST(OrientationConstraint, BoundsTheHeading) {
  Judged robot;
  robot.keep(turn(0.1, 0.1, 0.2, about_z(kPi / 2)));
  EXPECT_TRUE(robot.holds_at({0, 0, kPi / 2 + 0.19}));
  EXPECT_TRUE(robot.holds_at({0, 0, kPi / 2 - 0.19}));
  EXPECT_FALSE(robot.holds_at({0, 0, kPi / 2 + 0.21}));
  EXPECT_EQ(robot.why(), "12.0 deg about z, allowed 11.5");
  EXPECT_NEAR(robot.verdicts()[0].error, 0.01, 1e-9);
}

TEST(OrientationConstraint, TheHeadingWrapsAtHalfATurn) {
  Judged robot;
  robot.keep(turn(0.1, 0.1, 0.2, about_z(kPi - 0.05)));
  EXPECT_TRUE(robot.holds_at({0, 0, -kPi + 0.1}));
  EXPECT_FALSE(robot.holds_at({0, 0, -kPi + 0.2}));
}

TEST(OrientationConstraint, AQuaternionAndItsNegativeAreTheSameTurn) {
  Judged robot;
  const Quaternion q = about_z(1);
  robot.keep(turn(0.1, 0.1, 0.1, {-q.w, -q.x, -q.y, -q.z}));
  EXPECT_TRUE(robot.holds_at({0, 0, 1.05}));
  EXPECT_TRUE(robot.holds_at({0, 0, 0.95}));
  EXPECT_FALSE(robot.holds_at({0, 0, 1.15}));
}

TEST(OrientationConstraint, AnAxisWithHalfATurnIsFree) {
  Judged robot;
  robot.keep(turn(0.2, 0.2, 3.2));  // tilt only
  for (const double yaw_rad : {0.0, 1.0, kPi, -3.0}) {
    robot.state.tilt = Tilt{0.1, -0.1};
    EXPECT_TRUE(robot.holds_at({0, 0, yaw_rad})) << yaw_rad;
    robot.state.tilt = Tilt{0, 0.3};
    EXPECT_FALSE(robot.holds_at({0, 0, yaw_rad})) << yaw_rad;
    robot.state.tilt = Tilt{-0.3, 0};
    EXPECT_FALSE(robot.holds_at({0, 0, yaw_rad})) << yaw_rad;
  }
}

TEST(OrientationConstraint, TheAnglesAreIntrinsicXYZ) {
  // About its own x, then its new y, then its new z.
  const Quaternion about_x{std::cos(0.2), std::sin(0.2), 0, 0};
  const Quaternion about_y{std::cos(0.15), 0, std::sin(0.15), 0};
  const Quaternion turned = about_x * (about_y * about_z(0.5));
  Judged robot;
  robot.robot.links.push_back({"crane", {{}, turned}, {}});
  OrientationConstraint orientation = turn(0.401, 0.301, 0.501);
  orientation.link_name = "crane";
  robot.keep(orientation);
  EXPECT_TRUE(robot.holds()) << robot.why();
  for (const auto& [x, y, z, why] : {std::tuple{0.399, 1.0, 1.0, "22.9 deg about x"},
                                     {1.0, 0.299, 1.0, "17.2 deg about y"},
                                     {1.0, 1.0, 0.499, "28.6 deg about z"}}) {
    orientation = turn(x, y, z);
    orientation.link_name = "crane";
    robot.keep(orientation);
    EXPECT_FALSE(robot.holds());
    EXPECT_THAT(robot.why(), HasSubstr(why));
  }
}

TEST(OrientationConstraint, AtNinetyDegreesOfPitchRollAndYawAreOneTurnThatBothMustAllow) {
  for (const double pitch_rad : {kPi / 2, -kPi / 2}) {
    Judged robot;
    const Quaternion about_x{std::cos(0.2), std::sin(0.2), 0, 0};
    const Quaternion about_y{std::cos(pitch_rad / 2), 0, std::sin(pitch_rad / 2), 0};
    const Quaternion up = about_x * about_y;
    robot.robot.links.push_back({"crane", {{}, up}, {}});
    const auto holds = [&](double x, double z) {
      OrientationConstraint orientation = turn(x, 1.6, z);
      orientation.link_name = "crane";
      robot.keep(orientation);
      return robot.holds();
    };
    EXPECT_TRUE(holds(0.41, 0.41));
    EXPECT_FALSE(holds(0.39, 0.41));
    EXPECT_FALSE(holds(0.41, 0.39));
    EXPECT_TRUE(holds(0.41, 3.2));
    EXPECT_FALSE(holds(0.39, 3.2));
  }
}

TEST(OrientationConstraint, AToleranceWithoutATurnIsNotHeldByAnyRealOne) {
  Judged robot;
  robot.keep(turn(0, 0, 3.2));
  EXPECT_TRUE(robot.holds());
  robot.state.tilt = Tilt{1e-6, 0};
  EXPECT_FALSE(robot.holds());
}

TEST(OrientationConstraint, TheSignOfAToleranceSaysNothing) {
  Judged robot;
  robot.keep(turn(-0.2, -0.2, -3.2));
  EXPECT_TRUE(robot.holds_at({0, 0, 2}));
}

TEST(OrientationConstraint, WithoutAnInertialSensorTiltIsNotHeld) {
  Judged robot;
  robot.state.tilt = std::nullopt;
  robot.keep(turn(0.2, 0.2, 3.2));
  EXPECT_FALSE(robot.holds());
  EXPECT_EQ(robot.why(), "roll and pitch are not measured");
  robot.keep(turn(3.2, 0.2, 3.2));
  EXPECT_FALSE(robot.holds());
  robot.keep(turn(3.2, 3.2, 0.1));
  EXPECT_TRUE(robot.holds());
}

TEST(OrientationConstraint, BetweenTwoFramesOfTheRobotItsTiltSaysNothing) {
  Judged robot;
  robot.state.tilt = std::nullopt;
  OrientationConstraint orientation = turn(0.1, 0.1, 0.1, about_z(kPi / 2));
  orientation.header.frame_id = "base_link";
  orientation.link_name = "lidar";
  robot.keep(orientation);
  EXPECT_TRUE(robot.holds_at({3, 4, 2}));
  orientation.orientation = {};
  robot.keep(orientation);
  EXPECT_FALSE(robot.holds());
}

TEST(OrientationConstraint, TurnsWithTheMapWhenTheOriginMoves) {
  Judged robot;
  robot.keep(turn(0.1, 0.1, 1e-4));
  const GeodeticPoint other{48.01, 11.03, 480};
  robot.world.move_origin(other);
  EXPECT_FALSE(robot.holds_at({0, 0, 0}));
  EXPECT_TRUE(robot.holds_at(moved(Pose2{0, 0, 0}, yard::kOrigin, other)));
}

TEST(OrientationConstraint, WhatIsNotKnownDoesNotHold) {
  Judged robot;
  robot.keep(turn(3.2, 3.2, 0.1));
  EXPECT_FALSE(robot.holds_at({0, 0, kAbsent}));
  EXPECT_TRUE(robot.holds_at({}));
  robot.state.tilt = Tilt{kAbsent, 0};
  EXPECT_FALSE(robot.holds());
  robot.state.tilt = Tilt{};
  robot.keep(turn(3.2, 3.2, kAbsent));
  EXPECT_FALSE(robot.holds());
  robot.keep(turn(3.2, 3.2, 0.1, {2, 0, 0, 0}));
  EXPECT_EQ(robot.why(), "its quaternion is not of length 1");
  OrientationConstraint orientation = turn(3.2, 3.2, 0.1);
  orientation.link_name = "gripper";
  robot.keep(orientation);
  EXPECT_EQ(robot.why(), "the robot has no link \"gripper\"");
}

}  // namespace
}  // namespace drover::scene
