#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "unit/scene/constraint/judged.h"

namespace drover::scene {
namespace {

using testing::HasSubstr;
using yard::joint;
using yard::Judged;

TEST(JointConstraint, HoldsBetweenItsTolerances) {
  Judged robot;
  robot.keep(joint("arm", 1.0, 0.5, 0.25));
  robot.state.joints = {{"arm"}};
  for (const auto& [position, holds] :
       {std::pair{0.5, true}, {1.25, true}, {0.499, false}, {1.251, false}}) {
    robot.state.joints[0].position = position;
    EXPECT_EQ(robot.holds(), holds) << position;
  }
  EXPECT_EQ(robot.why(), "is 1.251, allowed 0.500 to 1.250");
  EXPECT_NEAR(robot.verdicts()[0].error, 0.001, 1e-9);
  EXPECT_EQ(robot.verdicts()[0].which, "set.joint_constraints[0] (arm)");
}

TEST(JointConstraint, OfAContinuousJointGoesTheShorterWay) {
  Judged robot;
  robot.keep(joint("wheel", 3.1, 0.2, 0.2));
  robot.state.joints = {{"wheel"}};
  for (const auto& [position, continuous, holds] : {std::tuple{-3.1, true, true},
                                                    {-3.1, false, false},
                                                    {3.1 + 20 * kPi, true, true},
                                                    {3.1 - 20 * kPi, true, true},
                                                    {3.1 + 3 * kPi, true, false},
                                                    {-2.8, true, false}}) {
    robot.state.joints[0].position = position;
    robot.state.joints[0].continuous = continuous;
    EXPECT_EQ(robot.holds(), holds) << position << continuous;
  }
}

TEST(JointConstraint, BoundsThePlaceOfTheBase) {
  Judged robot;
  Constraints set;
  set.joint_constraints = {joint("base/x", 0, 5, 5), joint("base/y", 0, 1, 1),
                           joint("base/theta", kPi, 0.3, 0.3)};
  robot.keep(set);
  EXPECT_TRUE(robot.holds_at({4.9, -0.9, kPi - 0.2}));
  EXPECT_TRUE(robot.holds_at({4.9, -0.9, -kPi + 0.2}));
  EXPECT_FALSE(robot.holds_at({5.1, 0, kPi}));
  EXPECT_FALSE(robot.holds_at({0, 1.1, kPi}));
  EXPECT_FALSE(robot.holds_at({0, 0, -kPi + 0.4}));
  EXPECT_EQ(robot.verdicts()[0].which, "set.joint_constraints[2] (base/theta)");
}

TEST(JointConstraint, OfTheBaseStaysAtItsPlaceOnEarthWhenTheOriginMoves) {
  Judged robot;
  Constraints set;
  set.joint_constraints = {joint("base/x", 100, 5, 5), joint("base/y", 50, 1, 1),
                           joint("base/theta", 0, 1e-4, 1e-4)};
  robot.keep(set);
  const GeodeticPoint other{48.01, 11.03, 480};
  robot.world.move_origin(other);
  EXPECT_FALSE(robot.holds_at({100, 50, 0}));
  const Pose2 there = moved(Pose2{104.9, 49.1, 0}, yard::kOrigin, other);
  EXPECT_TRUE(robot.holds_at(there)) << robot.why();
  EXPECT_FALSE(robot.holds_at(moved(Pose2{105.1, 50, 0}, yard::kOrigin, other)));
  EXPECT_FALSE(robot.holds_at(moved(Pose2{100, 48.9, 0}, yard::kOrigin, other)));
  EXPECT_FALSE(robot.holds_at({there.x_m, there.y_m, 0}));  // the convergence is larger
}

TEST(JointConstraint, LooksAheadByTheHorizon) {
  Judged robot;
  robot.keep(joint("arm", 0, 1, 1));
  robot.state.joints = {{"arm", 0.9, 0.5}};
  EXPECT_TRUE(robot.holds());
  robot.terms.joint_horizon_s = 0.3;
  EXPECT_FALSE(robot.holds());
  EXPECT_EQ(robot.why(), "will be 1.050, allowed -1.000 to 1.000");
  robot.state.joints[0].velocity = -0.5;
  EXPECT_TRUE(robot.holds());
  robot.state.joints[0].velocity = kAbsent;
  EXPECT_FALSE(robot.holds());
}

TEST(JointConstraint, OfAJointThatTheRobotDoesNotHaveDoesNotHold) {
  Judged robot;
  robot.keep(joint("base/z", 0, 1, 1));
  EXPECT_FALSE(robot.holds());
  EXPECT_EQ(robot.why(), "the robot has no joint \"base/z\"");
}

TEST(JointConstraint, WhatIsNotKnownDoesNotHold) {
  Judged robot;
  robot.keep(joint("base/x", 0, 5, 5));
  EXPECT_FALSE(robot.holds_at({kAbsent, 0, 0}));
  EXPECT_FALSE(robot.holds_at({std::numeric_limits<double>::infinity(), 0, 0}));
  EXPECT_FALSE(robot.holds_at({0, kAbsent, 0}));
  EXPECT_EQ(robot.why(), "the robot's place is not known");
  EXPECT_TRUE(robot.holds_at({0, 0, kAbsent})) << "the place is, and nothing else is asked";
  EXPECT_FALSE(robot.holds_at({6, 0, kAbsent}));
  robot.keep(joint("base/theta", 0, 1, 1));
  EXPECT_FALSE(robot.holds_at({0, 0, kAbsent}));
  EXPECT_EQ(robot.why(), "the robot's heading is not known");
  EXPECT_TRUE(robot.holds_at({}));
  robot.keep(joint("arm", 0, kAbsent, 1));
  robot.state.joints = {{"arm"}};
  EXPECT_FALSE(robot.holds());
  robot.keep(joint("arm", 0, -1, -1));  // the empty interval
  EXPECT_FALSE(robot.holds());
}

}  // namespace
}  // namespace drover::scene
