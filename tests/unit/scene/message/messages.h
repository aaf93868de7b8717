// Good messages, for tests that make one thing of them wrong.
#pragma once

#include <string>
#include <utility>

#include "scene/message/validate.h"

namespace drover::scene {

inline Header in_frame(std::string frame_id) {
  return {0, {}, std::move(frame_id)};
}

inline SolidPrimitive solid(std::uint8_t type, std::vector<double> dimensions) {
  return {type, std::move(dimensions)};
}

/// A closed one of a metre.
inline Mesh tetrahedron() {
  return {{{0, 2, 1}, {0, 1, 3}, {1, 2, 3}, {0, 3, 2}},
          {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}}};
}

inline Pose at(double x_m, double y_m, double z_m) {
  return {{x_m, y_m, z_m}, {}};
}

/// One of each shape, each with its pose.
inline CollisionObject good_object() {
  CollisionObject object;
  object.header = in_frame("map");
  object.id = "shelf";
  object.primitives = {solid(SolidPrimitive::BOX, {1, 2, 3}), solid(SolidPrimitive::SPHERE, {0.5}),
                       solid(SolidPrimitive::CYLINDER, {1, 0.2}),
                       solid(SolidPrimitive::CONE, {1, 0.3})};
  object.primitive_poses = {at(1, 0, 0), at(2, 0, 0), at(3, 0, 0), at(4, 0, 0)};
  object.meshes = {tetrahedron()};
  object.mesh_poses = {at(0, 1, 0)};
  object.planes = {{{1, 0, 0, -20}}};
  object.plane_poses = {at(0, 0, 0)};
  return object;
}

/// One of each kind.
inline Constraints good_constraints() {
  Constraints all;
  all.name = "row";
  all.joint_constraints = {{"base/y", 0, 1, 1, 0}};
  PositionConstraint position;
  position.header = in_frame("map");
  position.link_name = "base_link";
  position.constraint_region.primitives = {solid(SolidPrimitive::BOX, {20, 20, 2})};
  position.constraint_region.primitive_poses = {at(0, 0, 0)};
  all.position_constraints = {position};
  all.orientation_constraints = {{in_frame("map"), {}, "base_link", 0.2, 0.2, 4, 1}};
  VisibilityConstraint sight;
  sight.target_radius = 0.2;
  sight.target_pose = {in_frame("map"), at(5, 0, 1)};
  sight.cone_sides = 8;
  sight.sensor_pose = {in_frame("base_link"), at(0, 0, 1)};
  all.visibility_constraints = {sight};
  return all;
}

/// "done" with its notes, or "path: why".
template <class Message>
std::string outcome(Message message) {
  const auto result = validate(std::move(message));
  if (!result.ok()) return result.error().path + ": " + result.error().why;
  std::string text = "done";
  for (const std::string& note : result->notes) text += "; " + note;
  return text;
}

}  // namespace drover::scene
