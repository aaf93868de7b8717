// Constraints that mean nothing, by DDS, on the whole robot: each refused by the name of its field,
// and none in the scene.
#include <cmath>
#include <functional>
#include <limits>

#include "integration/ros2_scene_rig.h"

namespace drover::test {
namespace {

using namespace std::chrono_literals;
using testing::HasSubstr;

constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();
constexpr double kInfinite = std::numeric_limits<double>::infinity();

using Message = moveit_msgs_msg_dds__Constraints_;
using Joint = moveit_msgs_msg_dds__JointConstraint_;
using Position = moveit_msgs_msg_dds__PositionConstraint_;
using Orientation = moveit_msgs_msg_dds__OrientationConstraint_;
using Visibility = moveit_msgs_msg_dds__VisibilityConstraint_;

/// Below, each message would be taken but for what `break_it` does to it.
struct Broken {
  std::string refusal;  ///< field and reason
  std::function<void(Message&, ros2::Arena&)> make;
};

Broken joint(const char* refusal, const std::function<void(Joint&, ros2::Arena&)>& break_it) {
  return {"joint_constraints[0]." + std::string(refusal),
          [break_it](Message& message, ros2::Arena& arena) {
            Joint& one = *arena.fill(message.joint_constraints_, 1);
            one = {arena.text("base/y"), 0, 50, 50, 1};
            break_it(one, arena);
          }};
}

void fill_box(Position& one, ros2::Arena& arena) {
  auto& region = one.constraint_region_;
  auto* box = arena.fill(region.primitives_, 1);
  box->type_ = 1;
  auto* size = arena.fill(box->dimensions_, 3);
  size[0] = size[1] = size[2] = 2;
  arena.fill(region.primitive_poses_, 1)->orientation_.w_ = 1;
}

Broken position(const char* refusal, const std::function<void(Position&, ros2::Arena&)>& break_it) {
  return {"position_constraints[0]." + std::string(refusal),
          [break_it](Message& message, ros2::Arena& arena) {
            Position& one = *arena.fill(message.position_constraints_, 1);
            one.header_.frame_id_ = arena.text("map");
            one.link_name_ = arena.text("base_link");
            one.weight_ = 1;
            fill_box(one, arena);
            break_it(one, arena);
          }};
}

Broken orientation(const char* refusal,
                   const std::function<void(Orientation&, ros2::Arena&)>& break_it) {
  return {"orientation_constraints[0]." + std::string(refusal),
          [break_it](Message& message, ros2::Arena& arena) {
            Orientation& one = *arena.fill(message.orientation_constraints_, 1);
            one.header_.frame_id_ = arena.text("map");
            one.link_name_ = arena.text("base_link");
            one.orientation_.w_ = 1;
            one.absolute_x_axis_tolerance_ = one.absolute_y_axis_tolerance_ = 4;
            one.absolute_z_axis_tolerance_ = 4;
            one.weight_ = 1;
            break_it(one, arena);
          }};
}

Broken visibility(const char* refusal,
                  const std::function<void(Visibility&, ros2::Arena&)>& break_it) {
  return {"visibility_constraints[0]." + std::string(refusal),
          [break_it](Message& message, ros2::Arena& arena) {
            Visibility& one = *arena.fill(message.visibility_constraints_, 1);
            one.target_radius_ = 0.1;
            one.target_pose_.header_.frame_id_ = one.sensor_pose_.header_.frame_id_ =
                arena.text("map");
            one.target_pose_.pose_.orientation_.w_ = one.sensor_pose_.pose_.orientation_.w_ = 1;
            one.cone_sides_ = 4;
            one.weight_ = 1;
            break_it(one, arena);
          }};
}

std::vector<Broken> broken() {
  using A = ros2::Arena;
  return {
      joint("joint_name: is empty", [](Joint& one, A& arena) { one.joint_name_ = arena.text(""); }),
      joint("position: is no finite number", [](Joint& one, A&) { one.position_ = kNaN; }),
      joint("position: is no finite number", [](Joint& one, A&) { one.position_ = -kInfinite; }),
      joint("tolerance_above: is -0.5", [](Joint& one, A&) { one.tolerance_above_ = -0.5; }),
      joint("tolerance_below: is -0.5", [](Joint& one, A&) { one.tolerance_below_ = -0.5; }),
      joint("tolerance_above: is no finite number",
            [](Joint& one, A&) { one.tolerance_above_ = kNaN; }),
      joint("weight: is no finite number", [](Joint& one, A&) { one.weight_ = kNaN; }),
      joint("weight: is -1", [](Joint& one, A&) { one.weight_ = -1; }),
      position("link_name: is empty",
               [](Position& one, A& arena) { one.link_name_ = arena.text(""); }),
      position("header.frame_id: unknown frame",
               [](Position& one, A& arena) { one.header_.frame_id_ = arena.text("somewhere"); }),
      position("target_point_offset.y: is no finite number",
               [](Position& one, A&) { one.target_point_offset_.y_ = kNaN; }),
      position("constraint_region: is empty",
               [](Position& one, A& arena) { arena.fill(one.constraint_region_.primitives_, 0); }),
      position("constraint_region.primitives[0].type: is 0",
               [](Position& one, A&) { one.constraint_region_.primitives_._buffer[0].type_ = 0; }),
      position("constraint_region.primitives[0].type: is 9",
               [](Position& one, A&) { one.constraint_region_.primitives_._buffer[0].type_ = 9; }),
      position("constraint_region.primitives[0].dimensions: has 2 numbers",
               [](Position& one, A& arena) {
                 arena.fill(one.constraint_region_.primitives_._buffer[0].dimensions_, 2);
               }),
      position("constraint_region.primitives[0].dimensions[1]: is -2",
               [](Position& one, A&) {
                 one.constraint_region_.primitives_._buffer[0].dimensions_._buffer[1] = -2;
               }),
      position("constraint_region.primitives[0].dimensions[1]: is no finite number",
               [](Position& one, A&) {
                 one.constraint_region_.primitives_._buffer[0].dimensions_._buffer[1] = kNaN;
               }),
      position(
          "constraint_region.primitive_poses: has 2 poses for 1 shape",
          [](Position& one, A& arena) { arena.fill(one.constraint_region_.primitive_poses_, 2); }),
      position("constraint_region.primitive_poses[0].orientation: has the length 2",
               [](Position& one, A&) {
                 one.constraint_region_.primitive_poses_._buffer[0].orientation_.w_ = 2;
               }),
      position("constraint_region.primitive_poses[0].position.x: is no finite number",
               [](Position& one, A&) {
                 one.constraint_region_.primitive_poses_._buffer[0].position_.x_ = kInfinite;
               }),
      position("constraint_region.meshes[0].triangles[0].vertex_indices[2]: is 7",
               [](Position& one, A& arena) {
                 auto* mesh = arena.fill(one.constraint_region_.meshes_, 1);
                 arena.fill(mesh->vertices_, 3);
                 arena.fill(mesh->triangles_, 1)->vertex_indices_[2] = 7;
                 arena.fill(one.constraint_region_.mesh_poses_, 1)->orientation_.w_ = 1;
               }),
      position("weight: is no finite number", [](Position& one, A&) { one.weight_ = kNaN; }),
      orientation("link_name: is empty",
                  [](Orientation& one, A& arena) { one.link_name_ = arena.text(""); }),
      orientation("orientation: has the length 3",
                  [](Orientation& one, A&) {
                    one.orientation_ = {0, 0, 0, 3};
                  }),
      orientation("orientation.x: is no finite number",
                  [](Orientation& one, A&) { one.orientation_.x_ = kNaN; }),
      orientation("absolute_z_axis_tolerance: is no finite number",
                  [](Orientation& one, A&) { one.absolute_z_axis_tolerance_ = kNaN; }),
      orientation("parameterization: is of ROS 2",
                  [](Orientation& one, A&) { one.parameterization_ = 2; }),
      orientation("header.frame_id: unknown frame",
                  [](Orientation& one, A& arena) { one.header_.frame_id_ = arena.text("up"); }),
      visibility("target_radius: is no finite number",
                 [](Visibility& one, A&) { one.target_radius_ = kNaN; }),
      visibility("target_radius: is -1", [](Visibility& one, A&) { one.target_radius_ = -1; }),
      visibility("sensor_view_direction: is 7",
                 [](Visibility& one, A&) { one.sensor_view_direction_ = 7; }),
      visibility("max_view_angle: is -0.5",
                 [](Visibility& one, A&) { one.max_view_angle_ = -0.5; }),
      visibility("target_pose.pose.position.z: is no finite number",
                 [](Visibility& one, A&) { one.target_pose_.pose_.position_.z_ = kNaN; }),
      visibility("sensor_pose.header.frame_id: unknown frame",
                 [](Visibility& one, A& arena) {
                   one.sensor_pose_.header_.frame_id_ = arena.text("nowhere");
                 }),
      {"name: is empty",
       [](Message& message, ros2::Arena& arena) {
         *arena.fill(message.joint_constraints_, 1) = {arena.text("base/y"), 0, 50, 50, 1};
         message.name_ = arena.text("");
       }},
  };
}

class ConstraintsThatMeanNothing : public SceneFromRos2 {
 protected:
  ConstraintsThatMeanNothing() : SceneFromRos2(R"("planning_constraints": true)") {}
};

TEST_F(ConstraintsThatMeanNothing, AreEachRefusedByTheNameOfTheirField) {
  ASSERT_NO_FATAL_FAILURE(start_robot(ros2::planning_constraints_kind()));
  int refused = 0;
  for (const Broken& each : broken()) {
    ros2::Arena arena;
    Message message{};
    message.name_ = arena.text("set " + std::to_string(++refused));
    each.make(message, arena);
    SCOPED_TRACE(message.name_ + (": " + each.refusal));
    ASSERT_EQ(dds_write(writer_, &message), DDS_RETCODE_OK);
    const std::string counted = "\"refused\":" + std::to_string(refused) + ",";
    EXPECT_TRUE(wait_until([&] { return state().find(counted) != std::string::npos; }));
    EXPECT_THAT(state(), HasSubstr(each.refusal));
  }
  EXPECT_FALSE(shows("set")) << "one of them is in the scene";
}

}  // namespace
}  // namespace drover::test
