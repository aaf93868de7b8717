// Every field of the third document's messages, once: what is read and what is written goes by it.
//
// Names and order: ros-message-types; of what it only names, the ROS 1 definitions (std_msgs,
// geometry_msgs, shape_msgs, moveit_msgs of Melodic).
#pragma once

#include <array>
#include <concepts>
#include <span>
#include <string_view>
#include <type_traits>

#include "scene/message/collision_object.h"
#include "scene/message/constraints.h"

namespace drover::publish::scene_json {

/// How a field is spelled, and how others spell it, too. The first is written.
struct Name {
  constexpr Name(const char* first, const char* second = "", const char* third = "")
      : spellings{first, second, third} {}
  std::array<std::string_view, 3> spellings;
};

/// The message, const or not.
template <class Message, class Value>
concept Of = std::same_as<std::remove_const_t<Message>, Value>;

/// Python's clients say secs and nsecs, ROS 2's sec and nanosec.
void fields(Of<scene::Stamp> auto& stamp, auto&& visit) {
  visit(Name("sec", "secs"), stamp.sec);
  visit(Name("nsec", "nsecs", "nanosec"), stamp.nsec);
}

void fields(Of<scene::Header> auto& header, auto&& visit) {
  visit("seq", header.seq);
  visit("stamp", header.stamp);
  visit("frame_id", header.frame_id);
}

void fields(Of<Vector3> auto& vector, auto&& visit) {
  visit("x", vector.x);
  visit("y", vector.y);
  visit("z", vector.z);
}

void fields(Of<Quaternion> auto& turn, auto&& visit) {
  visit("x", turn.x);
  visit("y", turn.y);
  visit("z", turn.z);
  visit("w", turn.w);
}

void fields(Of<scene::Pose> auto& pose, auto&& visit) {
  visit("position", pose.position_m);
  visit("orientation", pose.orientation);
}

void fields(Of<scene::SolidPrimitive> auto& primitive, auto&& visit) {
  visit("type", primitive.type);
  visit("dimensions", primitive.dimensions);
}

void fields(Of<scene::MeshTriangle> auto& triangle, auto&& visit) {
  visit("vertex_indices", std::span(triangle));
}

void fields(Of<scene::Mesh> auto& mesh, auto&& visit) {
  visit("triangles", mesh.triangles);
  visit("vertices", mesh.vertices);
}

void fields(Of<scene::Plane> auto& plane, auto&& visit) {
  visit("coef", std::span(plane.coef));
}

void fields(Of<scene::ObjectType> auto& type, auto&& visit) {
  visit("key", type.key);
  visit("db", type.db);
}

void fields(Of<scene::CollisionObject> auto& object, auto&& visit) {
  visit("header", object.header);
  visit("id", object.id);
  visit("type", object.type);
  visit("primitives", object.primitives);
  visit("primitive_poses", object.primitive_poses);
  visit("meshes", object.meshes);
  visit("mesh_poses", object.mesh_poses);
  visit("planes", object.planes);
  visit("plane_poses", object.plane_poses);
  visit("operation", object.operation);
}

void fields(Of<scene::JointConstraint> auto& joint, auto&& visit) {
  visit("joint_name", joint.joint_name);
  visit("position", joint.position);
  visit("tolerance_above", joint.tolerance_above);
  visit("tolerance_below", joint.tolerance_below);
  visit("weight", joint.weight);
}

void fields(Of<scene::BoundingVolume> auto& region, auto&& visit) {
  visit("primitives", region.primitives);
  visit("primitive_poses", region.primitive_poses);
  visit("meshes", region.meshes);
  visit("mesh_poses", region.mesh_poses);
}

void fields(Of<scene::PositionConstraint> auto& position, auto&& visit) {
  visit("header", position.header);
  visit("link_name", position.link_name);
  visit("target_point_offset", position.target_point_offset);
  visit("constraint_region", position.constraint_region);
  visit("weight", position.weight);
}

void fields(Of<scene::OrientationConstraint> auto& turn, auto&& visit) {
  visit("header", turn.header);
  visit("orientation", turn.orientation);
  visit("link_name", turn.link_name);
  visit("absolute_x_axis_tolerance", turn.absolute_x_axis_tolerance);
  visit("absolute_y_axis_tolerance", turn.absolute_y_axis_tolerance);
  visit("absolute_z_axis_tolerance", turn.absolute_z_axis_tolerance);
  visit("weight", turn.weight);
}

void fields(Of<scene::PoseStamped> auto& placed, auto&& visit) {
  visit("header", placed.header);
  visit("pose", placed.pose);
}

void fields(Of<scene::VisibilityConstraint> auto& sight, auto&& visit) {
  visit("target_radius", sight.target_radius);
  visit("target_pose", sight.target_pose);
  visit("cone_sides", sight.cone_sides);
  visit("sensor_pose", sight.sensor_pose);
  visit("max_view_angle", sight.max_view_angle);
  visit("max_range_angle", sight.max_range_angle);
  visit("sensor_view_direction", sight.sensor_view_direction);
  visit("weight", sight.weight);
}

void fields(Of<scene::Constraints> auto& all, auto&& visit) {
  visit("name", all.name);
  visit("joint_constraints", all.joint_constraints);
  visit("position_constraints", all.position_constraints);
  visit("orientation_constraints", all.orientation_constraints);
  visit("visibility_constraints", all.visibility_constraints);
}

}  // namespace drover::publish::scene_json
