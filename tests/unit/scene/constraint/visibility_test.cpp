#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <random>

#include "drover/rotation.h"
#include "scene/constraint/convex.h"
#include "scene/constraint/view.h"
#include "unit/scene/constraint/judged.h"

namespace drover::scene {
namespace {

using testing::HasSubstr;
using yard::add_box;
using yard::at;
using yard::Judged;

/// z looks along -x: towards a robot that comes from there.
const Quaternion kFacesBack{std::cos(kPi / 4), 0, -std::sin(kPi / 4), 0};
/// z looks along x.
const Quaternion kFacesAhead{std::cos(kPi / 4), 0, std::sin(kPi / 4), 0};

/// From a camera 0.6 m above the base's nose, along x, to a disc 10 m ahead at the same height
/// that looks at the robot.
VisibilityConstraint sees() {
  VisibilityConstraint visibility;
  visibility.target_radius = 0.2;
  visibility.cone_sides = 8;
  visibility.target_pose.header.frame_id = "map";
  visibility.target_pose.pose = {{10, 0, 0.6}, kFacesBack};
  visibility.sensor_pose.header.frame_id = "base_link";
  visibility.sensor_pose.pose = {{0.5, 0, 0.6}, {}};
  visibility.sensor_view_direction = VisibilityConstraint::SENSOR_X;
  return visibility;
}

TEST(VisibilityConstraint, HoldsWhenNothingStandsInTheView) {
  Judged robot;
  robot.keep(sees());
  EXPECT_TRUE(robot.holds()) << robot.why();
}

TEST(VisibilityConstraint, AnObjectInTheViewHidesTheTarget) {
  Judged robot;
  robot.keep(sees());
  robot.apply(add_box("crate", at(5, 0.55, 0.6)));
  EXPECT_FALSE(robot.holds());
  EXPECT_EQ(robot.why(), "\"crate\" is in the view");
  EXPECT_EQ(robot.verdicts()[0].which, "set.visibility_constraints[0] (base_link)");
  robot.apply(add_box("crate", at(5, 0.65, 0.6)));  // beside it: the cone is 10 cm wide there
  EXPECT_TRUE(robot.holds());
  robot.apply(add_box("crate", at(11, 0, 0.6)));  // behind it
  EXPECT_TRUE(robot.holds());
}

TEST(VisibilityConstraint, WhatTheTargetIsMountedOnDoesNotHideIt) {
  Judged robot;
  robot.keep(sees());
  robot.apply(add_box("wall", at(10.5, 0, 0.5)));  // its face is the disc's
  EXPECT_TRUE(robot.holds()) << robot.why();
  robot.apply(add_box("wall", at(10.4, 0, 0.5)));
  EXPECT_FALSE(robot.holds());
}

TEST(VisibilityConstraint, EveryShapeHides) {
  Judged robot;
  robot.keep(sees());
  for (const auto& [type, dimensions] :
       {std::pair{SolidPrimitive::SPHERE, std::vector<double>{0.5}},
        {SolidPrimitive::CYLINDER, {1.8, 0.25}},
        {SolidPrimitive::CONE, {1.8, 0.5}}}) {
    CollisionObject object = add_box("thing", at(5, 0, 0.9));
    object.primitives[0].type = type;
    object.primitives[0].dimensions = dimensions;
    robot.apply(object);
    EXPECT_FALSE(robot.holds()) << int(type);
    object.primitive_poses = {at(5, 1, 0.9)};
    robot.apply(object);
    EXPECT_TRUE(robot.holds()) << int(type) << robot.why();
  }
}

TEST(VisibilityConstraint, OneSeesThroughTheGateOfAMesh) {
  Judged robot;
  robot.keep(sees());
  const auto upright = [](double y0, double y1) {
    Mesh wall;
    wall.vertices = {{0, y0, 0}, {0, y1, 0}, {0, y1, 2}, {0, y0, 2}};
    wall.triangles = {{0, 1, 2}, {0, 2, 3}};
    return wall;
  };
  Mesh gate = upright(-3, -0.3);
  const Mesh other = upright(0.3, 3);
  for (const Vector3& vertex : other.vertices) gate.vertices.push_back(vertex);
  gate.triangles.push_back({4, 5, 6});
  gate.triangles.push_back({4, 6, 7});
  CollisionObject object = add_box("gate", at(5, 0));
  object.primitives.clear();
  object.primitive_poses.clear();
  object.meshes = {gate};
  object.mesh_poses = {at(5, 0)};
  robot.apply(object);
  EXPECT_TRUE(robot.holds()) << robot.why();
  object.mesh_poses = {at(5, 0.5)};
  robot.apply(object);
  EXPECT_FALSE(robot.holds());
}

TEST(VisibilityConstraint, ASheetBetweenHides) {
  Judged robot;
  robot.keep(sees());
  CollisionObject object = add_box("sheet", at(0, 0));
  object.primitives.clear();
  object.primitive_poses.clear();
  object.planes = {{{0, 0, 2, 0}}};  // the ground
  robot.apply(object);
  EXPECT_TRUE(robot.holds()) << robot.why();
  object.planes = {{{2, 0, 0, -10}}};  // x = 5
  robot.apply(object);
  EXPECT_FALSE(robot.holds());
  object.planes = {{{0, 0, 0, 0}}};
  robot.apply(object);
  EXPECT_FALSE(robot.holds());
}

TEST(VisibilityConstraint, TheRobotsOwnBodyHidesButNotThatOfTheSensor) {
  Judged robot;
  VisibilityConstraint visibility = sees();
  visibility.sensor_pose.pose.position_m = {-1, 0, 1};  // behind the mast
  robot.keep(visibility);
  EXPECT_FALSE(robot.holds());
  EXPECT_EQ(robot.why(), "the robot's own mast is in the view");
  visibility.sensor_pose.header.frame_id = "mast";
  visibility.sensor_pose.pose.position_m = {0, 0, 0.5};
  robot.keep(visibility);
  EXPECT_TRUE(robot.holds()) << robot.why();
  visibility.target_pose.pose.position_m = {2, 0, 0.1};
  visibility.target_pose.header.frame_id = "lidar";  // looks to the left
  visibility.target_pose.pose.position_m = {0, -0.1, -0.2};
  robot.keep(visibility);
  EXPECT_EQ(robot.why(), "the robot's own base_link is in the view");
}

TEST(VisibilityConstraint, TheConeHasSides) {
  const View view{{{0, 0, 0}, {}}, {{10, 0, 0}, kFacesBack}, 1.0, 4};
  const auto corners = corners_of(view, 0);
  ASSERT_EQ(corners.size(), 5U);
  EXPECT_NEAR(corners[0].x, 0, 1e-12);
  for (std::size_t i = 1; i < 5; ++i) {
    EXPECT_NEAR(corners[i].x, 10, 1e-9);
    EXPECT_NEAR(std::hypot(corners[i].y, corners[i].z), 1, 1e-9);
  }
  EXPECT_EQ(corners_of({view.sensor, view.target, 1.0, 0}, 0).size(), 4U);
  EXPECT_EQ(corners_of({view.sensor, view.target, 1.0, 2'000'000'000}, 0).size(), 101U);
}

// What is left out because it is far beside the view is never in it.
TEST(VisibilityConstraint, AThousandThingsHideAsEachDoesByItself) {
  Judged robot;
  const View view{{{0, 0, 1}, {}}, {{10, 2, 1.5}, kFacesBack}, 0.6, 12};
  const auto corners = corners_of(view, 0.01);
  std::mt19937 random(3);
  std::uniform_real_distribution<double> within(0, 1);
  int hidden = 0;
  for (int i = 0; i < 1000; ++i) {
    CollisionObject thing = add_box("thing", at(12 * within(random) - 1, 5 * within(random) - 1.5,
                                                3 * within(random), 6 * within(random)));
    SolidPrimitive& shape = thing.primitives[0];
    shape.type = static_cast<std::uint8_t>(1 + i % 4);
    shape.dimensions = {0.1 + within(random), 0.1 + within(random), 0.1 + within(random)};
    if (shape.type == SolidPrimitive::SPHERE) shape.dimensions.resize(1);
    ASSERT_TRUE(robot.world.apply(thing, robot.placement()).ok());
    const bool alone =
        separation({&shape, thing.primitive_poses[0]}, {std::span<const Vector3>(corners), {}})
            .meeting != Separation::Meeting::apart;
    const RobotState state;
    const Setting setting{robot.robot, state, robot.world.objects(), robot.terms, {}};
    EXPECT_EQ(what_hides(view, setting, "mast", "base_link").has_value(), alone) << i;
    hidden += alone ? 1 : 0;
  }
  EXPECT_GT(hidden, 100);
  EXPECT_LT(hidden, 900);
}

TEST(VisibilityConstraint, TheRangeAngleIsBetweenTheViewAndTheTarget) {
  Judged robot;
  VisibilityConstraint visibility = sees();
  visibility.max_range_angle = 0.2;
  robot.keep(visibility);
  EXPECT_TRUE(robot.holds_at({0, 0, 0.15}));
  EXPECT_FALSE(robot.holds_at({0, 0, 0.25}));
  EXPECT_THAT(robot.why(), HasSubstr("beside the middle of the view, allowed 11.5"));
  EXPECT_FALSE(robot.holds_at({0, 0, kPi}));
  visibility.max_range_angle = 3;  // to the back is too much, however much is allowed
  robot.keep(visibility);
  EXPECT_FALSE(robot.holds_at({0, 0, kPi}));
  visibility.max_range_angle = 0;
  robot.keep(visibility);
  EXPECT_TRUE(robot.holds_at({0, 0, 0.25}));
}

TEST(VisibilityConstraint, TheViewAngleIsBetweenTheViewAndTheDiscsInvertedZ) {
  Judged robot;
  VisibilityConstraint visibility = sees();
  visibility.max_view_angle = 0.2;
  robot.keep(visibility);
  EXPECT_TRUE(robot.holds_at({0, 0, 0.15})) << robot.why();
  EXPECT_FALSE(robot.holds_at({0, 0, 0.25}));
  EXPECT_THAT(robot.why(), HasSubstr("14.3 deg between the view and the target's back"));
  visibility.target_pose.pose.orientation = kFacesAhead;  // shows its back
  visibility.max_view_angle = 3.2;
  robot.keep(visibility);
  EXPECT_FALSE(robot.holds_at({}));
}

TEST(VisibilityConstraint, TheSensorLooksAlongTheAxisThatIsNamed) {
  for (const auto& [axis, looks] : {std::pair{VisibilityConstraint::SENSOR_X, Vector3{1, 0, 0}},
                                    {VisibilityConstraint::SENSOR_Y, {0, 1, 0}},
                                    {VisibilityConstraint::SENSOR_Z, {0, 0, 1}}}) {
    for (const Vector3& target : {Vector3{5, 0, 0}, Vector3{0, 5, 0}, Vector3{0, 0, 5}}) {
      Judged robot;
      VisibilityConstraint visibility = sees();
      visibility.sensor_view_direction = axis;
      visibility.sensor_pose.pose.position_m = {};
      visibility.target_pose.pose.position_m = target;
      visibility.target_radius = 0;
      visibility.max_range_angle = 0.1;
      robot.keep(visibility);
      EXPECT_EQ(robot.holds(), dot(looks, target) > 0) << int(axis);
    }
  }
}

TEST(VisibilityConstraint, WhatBoundsNothingOrIsNotKnownDoesNotHold) {
  Judged robot;
  VisibilityConstraint visibility = sees();
  visibility.target_radius = 0;
  robot.keep(visibility);
  EXPECT_THAT(robot.why(), HasSubstr("it bounds nothing"));
  robot.keep(sees());
  EXPECT_FALSE(robot.holds_at({kAbsent, 0, 0}));
  visibility = sees();
  visibility.sensor_view_direction = 3;
  robot.state.base = {};
  robot.keep(visibility);
  EXPECT_FALSE(robot.holds());
  visibility = sees();
  visibility.max_range_angle = kAbsent;
  robot.keep(visibility);
  EXPECT_FALSE(robot.holds());
}

TEST(VisibilityConstraint, StaysAtItsPlaceOnEarthWhenTheOriginMoves) {
  Judged robot;
  VisibilityConstraint visibility = sees();
  visibility.max_range_angle = 0.05;
  robot.keep(visibility);
  robot.apply(add_box("crate", at(5, 0.68, 0.6)));
  EXPECT_TRUE(robot.holds());
  const GeodeticPoint other{48.01, 11.03, 480};
  robot.world.move_origin(other);
  EXPECT_FALSE(robot.holds());
  EXPECT_TRUE(robot.holds_at(moved(Pose2{}, yard::kOrigin, other))) << robot.why();
}

}  // namespace
}  // namespace drover::scene
