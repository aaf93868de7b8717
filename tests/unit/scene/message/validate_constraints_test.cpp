// Constraints: what each of the four kinds needs.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <limits>

#include "tests/unit/scene/message/messages.h"

namespace drover::scene {
namespace {

using testing::StartsWith;

constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();
constexpr double kInfinity = std::numeric_limits<double>::infinity();

/// What becomes of the good message after `change` of its first joint, position, ...
template <class Change>
std::string joint(Change change) {
  Constraints all = good_constraints();
  change(all.joint_constraints[0]);
  return outcome(all);
}
template <class Change>
std::string position(Change change) {
  Constraints all = good_constraints();
  change(all.position_constraints[0]);
  return outcome(all);
}
template <class Change>
std::string turn(Change change) {
  Constraints all = good_constraints();
  change(all.orientation_constraints[0]);
  return outcome(all);
}
template <class Change>
std::string sight(Change change) {
  Constraints all = good_constraints();
  change(all.visibility_constraints[0]);
  return outcome(all);
}

TEST(ConstraintSets, WithEachKindAreTaken) {
  EXPECT_EQ(outcome(good_constraints()), "done");
}

TEST(ConstraintSets, AreNamed) {
  Constraints all = good_constraints();
  all.name.clear();
  EXPECT_EQ(outcome(all), "name: is empty: it must be named");
  all.name = "a\nb";
  EXPECT_EQ(outcome(all), "name: contains a control character");
}

TEST(ConstraintSets, MayBeEmptyToClearWhatHadTheirName) {
  Constraints all;
  all.name = "row";
  EXPECT_EQ(outcome(all), "done");
}

TEST(ConstraintSets, AreBounded) {
  Constraints all = good_constraints();
  all.joint_constraints.resize(97, all.joint_constraints[0]);
  EXPECT_EQ(outcome(all), "done");
  all.joint_constraints.push_back(all.joint_constraints[0]);
  EXPECT_EQ(outcome(all), ": it has 101 constraints, at most 100 are allowed in a message");
}

TEST(ConstraintSets, CountTheTrianglesOfAllRegions) {
  Constraints all = good_constraints();
  BoundingVolume& region = all.position_constraints[0].constraint_region;
  region.meshes = {tetrahedron()};
  region.mesh_poses = {at(0, 0, 0)};
  region.meshes[0].triangles.assign(5001, {0, 1, 2});
  EXPECT_EQ(outcome(all), "done");
  all.position_constraints.push_back(all.position_constraints[0]);
  EXPECT_EQ(outcome(all),
            "position_constraints: has 10002 triangles, at most 10000 are allowed in a message");
}

TEST(ConstraintWeights, OfNothingAreTakenForEachKind) {
  EXPECT_EQ(joint([](auto& c) { c.weight = 0; }), "done");
  EXPECT_EQ(position([](auto& c) { c.weight = 0; }), "done");
  EXPECT_EQ(turn([](auto& c) { c.weight = 0; }), "done");
  EXPECT_EQ(sight([](auto& c) { c.weight = 0; }), "done");
}

TEST(ConstraintWeights, AreNeitherNegativeNorEndless) {
  for (const double weight : {-1.0, kNaN, kInfinity, 1e300}) {
    const auto set = [weight](auto& c) { c.weight = weight; };
    EXPECT_THAT(joint(set), StartsWith("joint_constraints[0].weight: is ")) << weight;
    EXPECT_THAT(position(set), StartsWith("position_constraints[0].weight: is ")) << weight;
    EXPECT_THAT(turn(set), StartsWith("orientation_constraints[0].weight: is ")) << weight;
    EXPECT_THAT(sight(set), StartsWith("visibility_constraints[0].weight: is ")) << weight;
  }
}

TEST(JointConstraints, NameAJoint) {
  EXPECT_EQ(joint([](auto& c) { c.joint_name = ""; }),
            "joint_constraints[0].joint_name: is empty: it must be named");
}

TEST(JointConstraints, HaveFinitePositionsAndTolerancesFromZero) {
  EXPECT_EQ(joint([](auto& c) { c.position = kNaN; }),
            "joint_constraints[0].position: is no finite number");
  EXPECT_EQ(joint([](auto& c) { c.position = -3; }), "done");
  EXPECT_EQ(joint([](auto& c) { c.tolerance_above = -0.1; }),
            "joint_constraints[0].tolerance_above: is -0.1: it must be from 0 to 1000000000");
  EXPECT_EQ(joint([](auto& c) { c.tolerance_below = -0.1; }),
            "joint_constraints[0].tolerance_below: is -0.1: it must be from 0 to 1000000000");
  EXPECT_EQ(joint([](auto& c) { c.tolerance_below = kInfinity; }),
            "joint_constraints[0].tolerance_below: is no finite number");
}

TEST(JointConstraints, WithoutAnyToleranceAreSaidToHoldNever) {
  EXPECT_EQ(joint([](auto& c) { c.tolerance_above = 0; }), "done");
  EXPECT_EQ(joint([](auto& c) { c.tolerance_above = c.tolerance_below = 0; }),
            "done; joint_constraints[0]: both tolerances are 0: a measured joint never holds it");
}

TEST(PositionConstraints, AreSomewhereOfSomething) {
  EXPECT_THAT(position([](auto& c) { c.header.frame_id = "0"; }),
              StartsWith("position_constraints[0].header.frame_id: is 0, no frame"));
  EXPECT_THAT(position([](auto& c) { c.header.frame_id = ""; }),
              StartsWith("position_constraints[0].header.frame_id: is empty"));
  EXPECT_THAT(position([](auto& c) { c.link_name = ""; }),
              StartsWith("position_constraints[0].link_name: is empty"));
  EXPECT_EQ(position([](auto& c) { c.target_point_offset.z = kNaN; }),
            "position_constraints[0].target_point_offset.z: is no finite number");
}

TEST(PositionConstraints, HaveARegion) {
  EXPECT_EQ(position([](auto& c) { c.constraint_region = {}; }),
            "position_constraints[0].constraint_region: is empty: it must have primitives or "
            "meshes");
}

TEST(PositionConstraints, HaveRegionsOfGoodShapes) {
  EXPECT_THAT(position([](auto& c) { c.constraint_region.primitives[0].dimensions[2] = 0; }),
              StartsWith("position_constraints[0].constraint_region.primitives[0].dimensions[2]: "
                         "is 0"));
  EXPECT_THAT(position([](auto& c) { c.constraint_region.primitive_poses.resize(2); }),
              StartsWith("position_constraints[0].constraint_region.primitive_poses: has 2 poses"));
  EXPECT_THAT(position([](auto& c) { c.constraint_region.meshes.resize(1); }),
              StartsWith("position_constraints[0].constraint_region.meshes[0].triangles: has no"));
  EXPECT_THAT(
      position([](auto& c) { c.constraint_region.mesh_poses.resize(1); }),
      StartsWith("position_constraints[0].constraint_region.mesh_poses: has 1 pose for 0 shapes"));
}

TEST(OrientationConstraints, AreSomewhereOfSomething) {
  EXPECT_THAT(turn([](auto& c) { c.header.frame_id = ""; }),
              StartsWith("orientation_constraints[0].header.frame_id: is empty"));
  EXPECT_THAT(turn([](auto& c) { c.link_name = ""; }),
              StartsWith("orientation_constraints[0].link_name: is empty"));
}

TEST(OrientationConstraints, AreRefusedWhenTheQuaternionIsNone) {
  EXPECT_THAT(turn([](auto& c) {
                c.orientation = {0.9, 0, 0, 0};
              }),
              StartsWith("orientation_constraints[0].orientation: has the length 0.9"));
  EXPECT_EQ(turn([](auto& c) {
              c.orientation = {0, 0, 0, 0};
            }),
            "done; orientation_constraints[0].orientation: all zero, taken as no turn");
}

TEST(OrientationConstraints, TakeTolerancesWithoutTheirSign) {
  Constraints all = good_constraints();
  all.orientation_constraints[0].absolute_y_axis_tolerance = -0.25;
  const auto result = validate(all);
  ASSERT_TRUE(result.ok());
  EXPECT_EQ(result->message.orientation_constraints[0].absolute_y_axis_tolerance, 0.25);
  EXPECT_THAT(result->notes,
              testing::ElementsAre("orientation_constraints[0].absolute_y_axis_tolerance: is "
                                   "negative, taken without its sign"));
}

TEST(OrientationConstraints, WithoutToleranceAreSaidToHoldNever) {
  EXPECT_EQ(turn([](auto& c) { c.absolute_x_axis_tolerance = 0; }),
            "done; orientation_constraints[0].absolute_x_axis_tolerance: is 0: a measured turn "
            "never holds it; pi and more leaves it free");
  EXPECT_EQ(turn([](auto& c) { c.absolute_z_axis_tolerance = kNaN; }),
            "orientation_constraints[0].absolute_z_axis_tolerance: is no finite number");
}

TEST(VisibilityConstraints, AskForSomething) {
  EXPECT_EQ(sight([](auto& c) { c.target_radius = 0; }),
            "visibility_constraints[0]: asks for nothing: target_radius and both angles are 0");
  EXPECT_EQ(sight([](auto& c) {
              c.target_radius = 0;
              c.max_view_angle = 0.1;
            }),
            "done");
  EXPECT_EQ(sight([](auto& c) {
              c.target_radius = 0;
              c.max_range_angle = 0.1;
            }),
            "done");
}

TEST(VisibilityConstraints, HaveRadiusAndAnglesFromZero) {
  for (const double value : {-0.1, kNaN, kInfinity}) {
    EXPECT_THAT(sight([&](auto& c) { c.target_radius = value; }),
                StartsWith("visibility_constraints[0].target_radius: is "));
    EXPECT_THAT(sight([&](auto& c) { c.max_view_angle = value; }),
                StartsWith("visibility_constraints[0].max_view_angle: is "));
    EXPECT_THAT(sight([&](auto& c) { c.max_range_angle = value; }),
                StartsWith("visibility_constraints[0].max_range_angle: is "));
  }
}

TEST(VisibilityConstraints, LookAlongOneOfThreeAxes) {
  EXPECT_EQ(int{VisibilityConstraint::SENSOR_Z}, 0);
  EXPECT_EQ(int{VisibilityConstraint::SENSOR_Y}, 1);
  EXPECT_EQ(int{VisibilityConstraint::SENSOR_X}, 2);
  EXPECT_EQ(sight([](auto& c) { c.sensor_view_direction = 2; }), "done");
  EXPECT_EQ(sight([](auto& c) { c.sensor_view_direction = 3; }),
            "visibility_constraints[0].sensor_view_direction: is 3: it must be SENSOR_Z 0, "
            "SENSOR_Y 1 or SENSOR_X 2");
}

TEST(VisibilityConstraints, HaveConesOfThreeToAHundredSides) {
  for (const std::int32_t sides : {-5, 0, 2}) {
    Constraints all = good_constraints();
    all.visibility_constraints[0].cone_sides = sides;
    const auto result = validate(all);
    ASSERT_TRUE(result.ok()) << sides;
    EXPECT_EQ(result->message.visibility_constraints[0].cone_sides, 3);
    EXPECT_THAT(result->notes, testing::ElementsAre(
                                   "visibility_constraints[0].cone_sides: is below 3, taken as 3"));
  }
  EXPECT_EQ(sight([](auto& c) { c.cone_sides = 100; }), "done");
  EXPECT_EQ(sight([](auto& c) { c.cone_sides = 0x7FFF'FFFF; }),
            "visibility_constraints[0].cone_sides: is 2147483647: at most 100 are allowed");
}

TEST(VisibilityConstraints, ArePlacedAtBothEnds) {
  EXPECT_THAT(sight([](auto& c) { c.target_pose.header.frame_id = "0"; }),
              StartsWith("visibility_constraints[0].target_pose.header.frame_id: is 0, no frame"));
  EXPECT_THAT(sight([](auto& c) { c.sensor_pose.header.frame_id = ""; }),
              StartsWith("visibility_constraints[0].sensor_pose.header.frame_id: is empty"));
  EXPECT_EQ(sight([](auto& c) { c.target_pose.pose.position_m.x = kNaN; }),
            "visibility_constraints[0].target_pose.pose.position.x: is no finite number");
  EXPECT_THAT(sight([](auto& c) {
                c.sensor_pose.pose.orientation = {3, 0, 0, 0};
              }),
              StartsWith("visibility_constraints[0].sensor_pose.pose.orientation: has the length"));
}

}  // namespace
}  // namespace drover::scene
