// Messages of the planning scene of ROS 2 users as droverd's own reader of MQTT's form reads them.
#include "ros2/read_scene.h"

#include <gmock/gmock.h>

#include <cmath>
#include <limits>
#include <vector>

#include "publish/scene/messages.h"
#include "ros2/arena.h"

namespace drover::ros2 {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;

constexpr double kQuarter = 0.70710678118654757;

using ObjectOnTheWire = moveit_msgs_msg_dds__CollisionObject_;
using ConstraintsOnTheWire = moveit_msgs_msg_dds__Constraints_;
using PoseOnTheWire = geometry_msgs_msg_dds__Pose_;

class ASceneMessage : public testing::Test {
 protected:
  ASceneMessage() {
    object_.header_.frame_id_ = arena_.text("map");
    object_.id_ = arena_.text("box1");
  }
  void add_box(double x, double y, double z) {
    auto* box = arena_.fill(object_.primitives_, 1);
    box->type_ = 1;
    auto* size = arena_.fill(box->dimensions_, 3);
    size[0] = x;
    size[1] = y;
    size[2] = z;
  }
  void place(std::vector<PoseOnTheWire> poses) {
    auto* to = arena_.fill(object_.primitive_poses_, poses.size());
    std::copy(poses.begin(), poses.end(), to);
  }
  /// As droverd has it.
  scene::CollisionObject read() {
    const auto text = read_collision_object(object_);
    EXPECT_TRUE(text.ok()) << (text.ok() ? "" : text.error().path + ": " + text.error().why);
    if (!text) return {};
    const auto all = publish::parse_collision_objects(*text, publish::Retain::no);
    EXPECT_TRUE(all.ok()) << *text;
    const auto& result = all->messages.at(0).result;
    refusal_ = result.ok() ? "" : result.error().path + ": " + result.error().why;
    notes_ = result.ok() ? result->notes : std::vector<std::string>();
    return result.ok() ? result->message : scene::CollisionObject();
  }
  scene::Constraints read_set() {
    const auto text = read_constraints(set_);
    EXPECT_TRUE(text.ok()) << (text.ok() ? "" : text.error().path + ": " + text.error().why);
    if (!text) return {};
    const auto all = publish::parse_planning_constraints(*text, publish::Retain::no);
    EXPECT_TRUE(all.ok()) << *text;
    const auto& result = all->messages.at(0).result;
    refusal_ = result.ok() ? "" : result.error().path + ": " + result.error().why;
    return result.ok() ? result->message : scene::Constraints();
  }
  /// Why drover-ros2 itself does not hand it on.
  std::string refusal() {
    const auto text = read_collision_object(object_);
    return text.ok() ? "" : text.error().path + ": " + text.error().why;
  }
  std::string set_refusal() {
    const auto text = read_constraints(set_);
    return text.ok() ? "" : text.error().path + ": " + text.error().why;
  }

  Arena arena_;
  ObjectOnTheWire object_{};
  ConstraintsOnTheWire set_{};
  std::string refusal_;  ///< of droverd's reader
  std::vector<std::string> notes_;
};

TEST_F(ASceneMessage, ReachesDroverdWithAllItsFields) {
  object_.header_.stamp_ = {1'700'000'000, 123'456'789};
  object_.type_ = {arena_.text("crate"), arena_.text("{}")};
  add_box(0.4, 0.3, 1.2);
  place({{{1, 2, 3}, {0, 0, kQuarter, kQuarter}}});
  auto* mesh = arena_.fill(object_.meshes_, 1);
  auto* triangle = arena_.fill(mesh->triangles_, 1);
  triangle->vertex_indices_[1] = 1;
  triangle->vertex_indices_[2] = 2;
  auto* vertices = arena_.fill(mesh->vertices_, 3);
  vertices[1] = {1, 0, 0};
  vertices[2] = {0, 1, 0.5};
  *arena_.fill(object_.mesh_poses_, 1) = {{4, 5, 6}, {}};
  auto* plane = arena_.fill(object_.planes_, 1);
  plane->coef_[0] = 1;
  plane->coef_[3] = -20;
  *arena_.fill(object_.plane_poses_, 1) = {{7, 8, 9}, {}};
  object_.operation_ = 2;
  const auto read = this->read();
  EXPECT_EQ(refusal_, "");
  EXPECT_EQ(read.header.frame_id, "map");
  EXPECT_EQ(read.header.stamp.sec, 1'700'000'000U);
  EXPECT_EQ(read.header.stamp.nsec, 123'456'789U);
  EXPECT_EQ(read.id, "box1");
  EXPECT_EQ(read.type.key, "crate");
  EXPECT_EQ(read.type.db, "{}");
  ASSERT_EQ(read.primitives.size(), 1U);
  EXPECT_EQ(read.primitives[0].type, scene::SolidPrimitive::BOX);
  EXPECT_THAT(read.primitives[0].dimensions, ElementsAre(0.4, 0.3, 1.2));
  EXPECT_EQ(read.primitive_poses.at(0).position_m.z, 3);
  EXPECT_NEAR(read.primitive_poses.at(0).orientation.z, kQuarter, 1e-15);
  ASSERT_EQ(read.meshes.size(), 1U);
  EXPECT_THAT(read.meshes[0].triangles.at(0), ElementsAre(0, 1, 2));
  EXPECT_EQ(read.meshes[0].vertices.at(2).z, 0.5);
  EXPECT_EQ(read.mesh_poses.at(0).position_m.y, 5);
  EXPECT_THAT(read.planes.at(0).coef, ElementsAre(1, 0, 0, -20));
  EXPECT_EQ(read.plane_poses.at(0).position_m.x, 7);
  EXPECT_EQ(read.operation, scene::CollisionObject::APPEND);
}

TEST_F(ASceneMessage, HasItsShapesAboutThePoseOfTheObject) {
  add_box(1, 1, 1);
  object_.pose_ = {{10, 20, 0}, {0, 0, kQuarter, kQuarter}};
  place({{{1, 0, 2}, {0, 0, kQuarter, kQuarter}}});
  auto read = this->read();
  const auto& at = read.primitive_poses.at(0);
  EXPECT_NEAR(at.position_m.x, 10, 1e-12);
  EXPECT_NEAR(at.position_m.y, 21, 1e-12);
  EXPECT_NEAR(at.position_m.z, 2, 1e-12);
  EXPECT_NEAR(std::abs(at.orientation.z), 1, 1e-12);
  place({});
  read = this->read();
  EXPECT_NEAR(read.primitive_poses.at(0).position_m.y, 20, 1e-12) << "a shape without a pose";
  EXPECT_TRUE(notes_.empty());
  object_.pose_ = {{10, 20, 0}, {}};
  EXPECT_EQ(this->read().primitive_poses.at(0).orientation.w, 1) << "all zero is no turn";
}

TEST_F(ASceneMessage, ThatMovesNeedsAPoseForEachShape) {
  object_.operation_ = 3;
  object_.pose_ = {{1, 0, 0}, {}};
  EXPECT_THAT(refusal(), HasSubstr("primitive_poses: there is none: MOVE needs a pose"));
  place({{{1, 0, 0}, {}}});
  EXPECT_EQ(read().primitive_poses.at(0).position_m.x, 2);
  EXPECT_EQ(refusal_, "");
}

TEST_F(ASceneMessage, ThatRemovesNeedsAnIdOnly) {
  object_.operation_ = 1;
  object_.header_.frame_id_ = nullptr;
  object_.pose_.position_.x_ = NAN;
  EXPECT_EQ(read().operation, scene::CollisionObject::REMOVE);
  EXPECT_EQ(refusal_, "");
  object_.id_ = nullptr;
  (void)read();
  EXPECT_EQ(refusal_, "id: is empty: it must be named") << "it does not remove everything";
}

TEST_F(ASceneMessage, IsRefusedByFieldForWhatIsNoNumber) {
  add_box(1, NAN, 1);
  EXPECT_EQ(refusal(), "primitives[0].dimensions[1]: is no finite number");
  add_box(1, 1, 1);
  place({{{0, INFINITY, 0}, {}}});
  EXPECT_EQ(refusal(), "primitive_poses[0].position.y: is no finite number");
  object_.pose_.orientation_.w_ = NAN;
  EXPECT_EQ(refusal(), "pose.orientation.w: is no finite number");
  object_.pose_ = {{1, 0, 0}, {}};
  EXPECT_EQ(refusal(), "primitive_poses[0].position.y: is no finite number");
  place({});
  object_.pose_.orientation_ = {0, 0, 0.5, 0.5};
  EXPECT_THAT(refusal(), HasSubstr("pose.orientation: has the length 0.7071"));
  object_.pose_ = {};
  arena_.fill(object_.planes_, 1)->coef_[2] = -INFINITY;
  EXPECT_EQ(refusal(), "planes[0].coef[2]: is no finite number");
  arena_.fill(object_.planes_, 0);
  arena_.fill(arena_.fill(object_.meshes_, 1)->vertices_, 2)[1].z_ = NAN;
  EXPECT_EQ(refusal(), "meshes[0].vertices[1].z: is no finite number");
}

TEST_F(ASceneMessage, IsRefusedForTextsThatAreNone) {
  add_box(1, 1, 1);
  object_.id_ = arena_.text("box\xff");
  EXPECT_EQ(refusal(), "id: is no UTF-8");
  object_.id_ = arena_.text("box");
  object_.header_.frame_id_ = arena_.text("\xc3");
  EXPECT_EQ(refusal(), "header.frame_id: is no UTF-8");
}

TEST_F(ASceneMessage, IsJudgedByDroverdOtherwise) {
  add_box(1, 1, 1);
  object_.header_.stamp_.sec_ = -1;
  (void)read();
  EXPECT_THAT(refusal_, HasSubstr("header.stamp.sec: must be an integer from 0"));
  object_.header_.stamp_ = {1, 1'000'000'000};
  (void)read();
  EXPECT_THAT(refusal_, HasSubstr("header.stamp.nsec"));
  object_.header_.stamp_ = {};
  object_.header_.frame_id_ = nullptr;
  (void)read();
  EXPECT_THAT(refusal_, HasSubstr("header.frame_id: is empty"));
  object_.header_.frame_id_ = arena_.text("map");
  object_.operation_ = 4;
  (void)read();
  EXPECT_THAT(refusal_, HasSubstr("operation: is 4"));
}

TEST_F(ASceneMessage, IsRefusedForAPrismAndNotedForWhatIsNotFollowed) {
  add_box(1, 1, 1);
  place({{}});
  arena_.fill(object_.primitives_._buffer[0].polygon_.points_, 3);
  *arena_.fill(object_.subframe_names_, 1) = arena_.text("tip");
  arena_.fill(object_.subframe_poses_, 1);
  (void)read();
  EXPECT_EQ(refusal_, "");
  EXPECT_THAT(notes_, testing::Contains(HasSubstr("primitives[0].polygon: unknown, ignored")));
  EXPECT_THAT(notes_, testing::Contains(HasSubstr("subframe_names: unknown, ignored")));
  object_.primitives_._buffer[0].type_ = 5;
  (void)read();
  EXPECT_THAT(refusal_, HasSubstr("primitives[0].type"));
}

TEST_F(ASceneMessage, OfConstraintsReachesDroverdWithAllItsFields) {
  set_.name_ = arena_.text("row");
  *arena_.fill(set_.joint_constraints_, 1) = {arena_.text("base/y"), 1.5, 0.5, 0.25, 2};
  auto* position = arena_.fill(set_.position_constraints_, 1);
  position->header_.frame_id_ = arena_.text("map");
  position->link_name_ = arena_.text("base_link");
  position->target_point_offset_ = {0.1, 0.2, 0.3};
  auto* ball = arena_.fill(position->constraint_region_.primitives_, 1);
  ball->type_ = 2;
  *arena_.fill(ball->dimensions_, 1) = 4;
  *arena_.fill(position->constraint_region_.primitive_poses_, 1) = {{1, 2, 3}, {}};
  position->weight_ = 3;
  auto* turn = arena_.fill(set_.orientation_constraints_, 1);
  turn->header_.frame_id_ = arena_.text("map");
  turn->orientation_ = {0, 0, kQuarter, kQuarter};
  turn->link_name_ = arena_.text("mast");
  turn->absolute_x_axis_tolerance_ = 0.1;
  turn->absolute_y_axis_tolerance_ = 0.2;
  turn->absolute_z_axis_tolerance_ = 3.2;
  turn->weight_ = 4;
  auto* sight = arena_.fill(set_.visibility_constraints_, 1);
  sight->target_radius_ = 0.5;
  sight->target_pose_.header_.frame_id_ = arena_.text("map");
  sight->target_pose_.pose_.position_.x_ = 9;
  sight->cone_sides_ = 8;
  sight->sensor_pose_.header_.frame_id_ = arena_.text("base_link");
  sight->sensor_pose_.pose_.position_.z_ = 1;
  sight->max_view_angle_ = 0.6;
  sight->max_range_angle_ = 0.7;
  sight->sensor_view_direction_ = 2;
  sight->weight_ = 5;
  const auto read = read_set();
  EXPECT_EQ(refusal_, "");
  EXPECT_EQ(read.name, "row");
  const auto& joint = read.joint_constraints.at(0);
  EXPECT_EQ(joint.joint_name, "base/y");
  EXPECT_EQ(joint.position, 1.5);
  EXPECT_EQ(joint.tolerance_above, 0.5);
  EXPECT_EQ(joint.tolerance_below, 0.25);
  EXPECT_EQ(joint.weight, 2);
  const auto& place = read.position_constraints.at(0);
  EXPECT_EQ(place.header.frame_id, "map");
  EXPECT_EQ(place.link_name, "base_link");
  EXPECT_EQ(place.target_point_offset.y, 0.2);
  EXPECT_THAT(place.constraint_region.primitives.at(0).dimensions, ElementsAre(4));
  EXPECT_EQ(place.constraint_region.primitive_poses.at(0).position_m.z, 3);
  EXPECT_EQ(place.weight, 3);
  const auto& turned = read.orientation_constraints.at(0);
  EXPECT_EQ(turned.link_name, "mast");
  EXPECT_NEAR(turned.orientation.z, kQuarter, 1e-15);
  EXPECT_EQ(turned.absolute_x_axis_tolerance, 0.1);
  EXPECT_EQ(turned.absolute_y_axis_tolerance, 0.2);
  EXPECT_EQ(turned.absolute_z_axis_tolerance, 3.2);
  EXPECT_EQ(turned.weight, 4);
  const auto& seen = read.visibility_constraints.at(0);
  EXPECT_EQ(seen.target_radius, 0.5);
  EXPECT_EQ(seen.target_pose.pose.position_m.x, 9);
  EXPECT_EQ(seen.cone_sides, 8);
  EXPECT_EQ(seen.sensor_pose.header.frame_id, "base_link");
  EXPECT_EQ(seen.sensor_pose.pose.position_m.z, 1);
  EXPECT_EQ(seen.max_view_angle, 0.6);
  EXPECT_EQ(seen.max_range_angle, 0.7);
  EXPECT_EQ(seen.sensor_view_direction, 2);
  EXPECT_EQ(seen.weight, 5);
  turn->parameterization_ = 1;
  (void)read_set();
  EXPECT_THAT(refusal_, HasSubstr("orientation_constraints[0].parameterization: is of ROS 2"));
}

TEST_F(ASceneMessage, OfConstraintsIsRefusedByFieldForWhatIsNoNumber) {
  set_.name_ = arena_.text("row");
  arena_.fill(set_.joint_constraints_, 2)[1] = {arena_.text("base/y"), 0, NAN, 0, 0};
  EXPECT_EQ(set_refusal(), "joint_constraints[1].tolerance_above: is no finite number");
  arena_.fill(set_.joint_constraints_, 0);
  arena_.fill(set_.visibility_constraints_, 1)->sensor_pose_.pose_.orientation_.x_ = INFINITY;
  EXPECT_EQ(set_refusal(),
            "visibility_constraints[0].sensor_pose.pose.orientation.x: is no finite number");
  arena_.fill(set_.visibility_constraints_, 0);
  arena_.fill(set_.position_constraints_, 1)->target_point_offset_.x_ = NAN;
  EXPECT_EQ(set_refusal(), "position_constraints[0].target_point_offset.x: is no finite number");
  arena_.fill(set_.position_constraints_, 0);
  arena_.fill(set_.orientation_constraints_, 1)->weight_ = NAN;
  EXPECT_EQ(set_refusal(), "orientation_constraints[0].weight: is no finite number");
}

}  // namespace
}  // namespace drover::ros2
