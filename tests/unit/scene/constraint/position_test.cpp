#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <random>

#include "unit/scene/constraint/judged.h"

namespace drover::scene {
namespace {

using testing::HasSubstr;
using yard::at;
using yard::box;
using yard::inside;
using yard::Judged;

SolidPrimitive round_shape(SolidPrimitive::Type type, std::vector<double> dimensions) {
  SolidPrimitive shape;
  shape.type = type;
  shape.dimensions = std::move(dimensions);
  return shape;
}

TEST(PositionConstraint, HoldsInsideOfItsRegion) {
  Judged robot;
  robot.keep(inside(box(10, 4, 2), at(5, 0, 0)));
  EXPECT_TRUE(robot.holds_at({9.9, 1.9, 1}));
  EXPECT_FALSE(robot.holds_at({10.25, 0, 0}));
  EXPECT_EQ(robot.why(), "0.250 m outside of its region");
  EXPECT_EQ(robot.verdicts()[0].which, "set.position_constraints[0] (base_link)");
}

TEST(PositionConstraint, ARegionThatBeginsAtTheGroundHoldsTheRobotOnIt) {
  Judged robot;
  robot.keep(inside(box(10, 4, 2), at(5, 0, 1)));
  EXPECT_TRUE(robot.holds_at({1, 0, 0}));
}

TEST(PositionConstraint, TheTargetPointTurnsWithTheLink) {
  Judged robot;
  PositionConstraint position = inside(box(2, 2, 2));
  position.target_point_offset = {1.5, 0, 0};
  robot.keep(position);
  EXPECT_FALSE(robot.holds_at({0, 0, 0}));
  EXPECT_TRUE(robot.holds_at({0, -1.5, kPi / 2}));
  position.link_name = "lidar";  // half a metre ahead, looks to the left
  robot.keep(position);
  EXPECT_TRUE(robot.holds_at({-0.5, -1.5, 0}));
}

TEST(PositionConstraint, OfATiltedRobotIsThePointWhereItIs) {
  Judged robot;
  PositionConstraint position = inside(box(0.4, 0.4, 10));
  position.target_point_offset = {0, 0, 2};
  robot.keep(position);
  EXPECT_TRUE(robot.holds());
  robot.state.tilt = Tilt{0, 0.2};
  EXPECT_FALSE(robot.holds());
  robot.state.tilt = std::nullopt;
  EXPECT_TRUE(robot.holds());
  robot.state.tilt = Tilt{0, kAbsent};
  EXPECT_FALSE(robot.holds());
}

TEST(PositionConstraint, TheRegionIsTheUnionOfItsShapes) {
  Judged robot;
  PositionConstraint position = inside(box(2, 2, 2), at(0, 0));
  position.constraint_region.primitives.push_back(box(2, 2, 2));
  position.constraint_region.primitive_poses.push_back(at(10, 0));
  robot.keep(position);
  EXPECT_TRUE(robot.holds_at({0, 0, 0}));
  EXPECT_TRUE(robot.holds_at({10, 0, 0}));
  EXPECT_FALSE(robot.holds_at({5, 0, 0}));
}

TEST(PositionConstraint, EveryShapeHasItsOwnInside) {
  const auto outside = [](const SolidPrimitive& shape, const Vector3& at) {
    Judged robot;
    PositionConstraint position = inside(shape);
    position.target_point_offset = at;
    robot.keep(position);
    const Verdict verdict = robot.verdicts()[0];
    EXPECT_EQ(verdict.holds, verdict.error == 0);
    return verdict.error;
  };
  const auto sphere = round_shape(SolidPrimitive::SPHERE, {2});
  EXPECT_EQ(outside(sphere, {1.1, 1.1, 1.1}), 0);
  EXPECT_NEAR(outside(sphere, {0, 3, 4}), 3, 1e-9);
  const auto cylinder = round_shape(SolidPrimitive::CYLINDER, {4, 1});  // height first
  EXPECT_EQ(outside(cylinder, {0.7, 0.7, 1.9}), 0);
  EXPECT_NEAR(outside(cylinder, {0, 3, 0}), 2, 1e-9);
  EXPECT_NEAR(outside(cylinder, {0, 4, 6}), 5, 1e-9);
  const auto cone = round_shape(SolidPrimitive::CONE, {2, 1});  // the tip at z = 1
  EXPECT_EQ(outside(cone, {0, 0, 0.99}), 0);
  EXPECT_EQ(outside(cone, {0, 0.99, -1}), 0);
  EXPECT_EQ(outside(cone, {0.49, 0, 0}), 0);
  EXPECT_NEAR(outside(cone, {0, 0, 3}), 2, 1e-9);
  EXPECT_NEAR(outside(cone, {0.5, 0, -2}), 1, 1e-9);
  EXPECT_NEAR(outside(cone, {4, 0, -1}), 3, 1e-9);
  EXPECT_NEAR(outside(cone, {1, 0, 0}), 1 / std::sqrt(5.0), 1e-9);
  EXPECT_NEAR(outside(box(2, 2, 2), {2, 1, 1}), 1, 1e-9);
  EXPECT_NEAR(outside(box(2, 2, 2), {4, 5, 1}), 5, 1e-9);
}

TEST(PositionConstraint, AMeshIsItsConvexHull) {
  Judged robot;
  PositionConstraint position = inside(box(1, 1, 1));
  position.constraint_region.primitives.clear();
  position.constraint_region.primitive_poses.clear();
  Mesh u;  // from above: its mouth, (2, 3), is in the hull
  for (const auto& [x, y] :
       {std::pair{0, 0}, {4, 0}, {4, 4}, {3, 4}, {3, 1}, {1, 1}, {1, 4}, {0, 4}})
    for (const double z : {-1.0, 1.0}) u.vertices.push_back({double(x), double(y), z});
  u.triangles = {{0, 1, 2}};
  position.constraint_region.meshes = {u};
  position.constraint_region.mesh_poses = {at(10, 0)};
  robot.keep(position);
  EXPECT_TRUE(robot.holds_at({12, 3, 0}));
  EXPECT_TRUE(robot.holds_at({10.01, 0.01, 0}));
  EXPECT_TRUE(robot.holds_at({10, 0, 0}));
  EXPECT_FALSE(robot.holds_at({9.99, 2, 0}));
  EXPECT_FALSE(robot.holds_at({12, 4.01, 0}));
  EXPECT_FALSE(robot.holds_at({2, 3, 0}));
  EXPECT_NEAR(robot.verdicts()[0].error, 8, 0.1);
}

TEST(PositionConstraint, AFlatMeshHoldsNothingButItself) {
  Judged robot;
  PositionConstraint position = inside(box(1, 1, 1));
  position.constraint_region.primitives.clear();
  position.constraint_region.primitive_poses.clear();
  Mesh flat;
  flat.vertices = {{0, 0, 1}, {4, 0, 1}, {0, 4, 1}, {4, 4, 1}};
  position.constraint_region.meshes = {flat};
  robot.keep(position);
  EXPECT_FALSE(robot.holds_at({2, 2, 0}));
  position.target_point_offset = {0, 0, 1};
  robot.keep(position);
  EXPECT_TRUE(robot.holds_at({2, 2, 0}));
}

TEST(PositionConstraint, InAFrameOfTheRobotGoesAlong) {
  Judged robot;
  PositionConstraint position = inside(box(2, 2, 2));
  position.header.frame_id = "base_link";
  position.link_name = "lidar";
  robot.keep(position);
  EXPECT_TRUE(robot.holds_at({100, 7, 1}));
}

TEST(PositionConstraint, StaysAtItsPlaceOnEarthWhenTheOriginMoves) {
  Judged robot;
  robot.keep(inside(box(10, 4, 2), at(500, -300, 0)));
  const GeodeticPoint other{48.01, 11.03, 480};
  robot.world.move_origin(other);
  EXPECT_FALSE(robot.holds_at({500, -300, 0}));
  EXPECT_TRUE(robot.holds_at(moved(Pose2{504.9, -301.9, 0}, yard::kOrigin, other)));
  EXPECT_FALSE(robot.holds_at(moved(Pose2{505.1, -300, 0}, yard::kOrigin, other)));
  EXPECT_FALSE(robot.holds_at(moved(Pose2{500, -297.9, 0}, yard::kOrigin, other)));
}

TEST(PositionConstraint, WithAnOutlineAllOfItIsInsideOfOneShape) {
  Judged robot;
  PositionConstraint position = inside(box(10, 4, 2));
  robot.keep(position);
  robot.terms.extent.outline = {{0.5, 0.4, 0}, {-0.5, 0.4, 0}, {-0.5, -0.4, 0}, {0.5, -0.4, 0}};
  EXPECT_TRUE(robot.holds_at({4.4, 1.5, 0}));
  EXPECT_FALSE(robot.holds_at({4.4, 1.55, kPi / 2}));
  EXPECT_FALSE(robot.holds_at({4.6, 0, 0}));
  robot.terms.extent.margin_m = 0.2;
  EXPECT_FALSE(robot.holds_at({4.4, 1.5, 0}));
  EXPECT_TRUE(robot.holds_at({4.25, 1.35, 0}));
}

TEST(PositionConstraint, TheMarginIsLevel) {
  Judged robot;
  robot.keep(inside(box(10, 4, 2), at(0, 0, 1)));
  robot.terms.extent.margin_m = 0.5;
  EXPECT_TRUE(robot.holds_at({4.45, 0, 0}));
  EXPECT_FALSE(robot.holds_at({4.55, 0, 0}));
}

TEST(PositionConstraint, OfALinkThatTheRobotDoesNotHaveDoesNotHold) {
  Judged robot;
  PositionConstraint position = inside(box(10, 4, 2));
  position.link_name = "gripper";
  robot.keep(position);
  EXPECT_FALSE(robot.holds());
  EXPECT_EQ(robot.why(), "the robot has no link \"gripper\"");
}

TEST(PositionConstraint, AnEmptyRegionOrAShapeThatIsNoneHoldsNothing) {
  Judged robot;
  PositionConstraint position = inside(box(10, 4, 2));
  position.constraint_region = {};
  robot.keep(position);
  EXPECT_EQ(robot.why(), "it has no region");
  for (const auto& shape : {round_shape(SolidPrimitive::BOX, {1, 1}),
                            round_shape(static_cast<SolidPrimitive::Type>(9), {1, 1, 1}),
                            round_shape(SolidPrimitive::SPHERE, {kAbsent})}) {
    position.constraint_region.primitives = {shape};
    robot.keep(position);
    EXPECT_FALSE(robot.holds());
  }
  position.constraint_region = {};
  position.constraint_region.meshes.resize(1);
  robot.keep(position);
  EXPECT_FALSE(robot.holds());
}

TEST(PositionConstraint, WhatIsNotKnownDoesNotHold) {
  Judged robot;
  robot.keep(inside(box(10, 4, 2)));
  EXPECT_FALSE(robot.holds_at({kAbsent, 0, 0}));
  EXPECT_FALSE(robot.holds_at({0, kAbsent, 0}));
  EXPECT_EQ(robot.why(), "the robot's place is not known");
}

TEST(PositionConstraint, OfBaseLinkNeedsNoHeading) {
  Judged robot;
  robot.terms.extent.turn_rad = kAbsent;
  robot.keep(inside(box(10, 4, 2)));
  EXPECT_TRUE(robot.holds_at({4.9, 1.9, kAbsent}));
  EXPECT_FALSE(robot.holds_at({5.25, 0, kAbsent}));
  EXPECT_EQ(robot.why(), "0.250 m outside of its region");
}

/// Nothing is permitted that some heading would break.
TEST(PositionConstraint, OfAPointFarFromBaseLinkHoldsWithoutAHeadingOnlyIfItDoesForEach) {
  Judged robot;
  robot.terms.extent.turn_rad = kAbsent;
  PositionConstraint position = inside(box(10, 4, 2));
  position.target_point_offset = {0.6, -0.8, 0};
  robot.keep(position);
  EXPECT_TRUE(robot.holds_at({3.9, 0.9, kAbsent}));
  EXPECT_FALSE(robot.holds_at({4.1, 0, kAbsent}));
  EXPECT_FALSE(robot.holds_at({0, -1.1, kAbsent}));
  EXPECT_THAT(robot.why(), testing::EndsWith("m outside of its region, with no heading"));
  robot.terms.extent.turn_rad = 0;
  EXPECT_TRUE(robot.holds_at({4.1, 0, 0}));
  std::mt19937 random(5);
  std::uniform_real_distribution<> any(-1, 1);
  for (int round = 0; round < 300; ++round) {
    const Pose2 at{6 * any(random), 3 * any(random), kAbsent};
    robot.terms.extent.turn_rad = kAbsent;
    if (!robot.holds_at(at)) continue;
    robot.terms.extent.turn_rad = 0;
    for (int i = 0; i < 32; ++i) ASSERT_TRUE(robot.holds_at({at.x_m, at.y_m, i * kPi / 16}));
  }
}

TEST(PositionConstraint, InAFrameOfTheRobotIsJudgedWithoutAHeading) {
  Judged robot;
  robot.terms.extent.turn_rad = kAbsent;
  PositionConstraint position = inside(box(2, 2, 4));
  position.header.frame_id = "base_link";
  position.link_name = "lidar";
  robot.keep(position);
  EXPECT_TRUE(robot.holds_at({100, 50, kAbsent}));
  position.target_point_offset = {0, -0.8, 0};  // ahead, of the lidar that looks to the left
  robot.keep(position);
  EXPECT_FALSE(robot.holds_at({100, 50, kAbsent}));
}

}  // namespace
}  // namespace drover::scene
