// Messages of the planning scene as text, as clients write them.
#pragma once

#include <string>
#include <string_view>

#include "publish/scene/messages.h"

namespace drover::publish {

inline constexpr std::string_view kBox = R"({
  "header": {"seq": 7, "stamp": {"sec": 1700000000, "nsec": 500000000}, "frame_id": "base_link"},
  "id": "box1",
  "primitives": [{"type": 1, "dimensions": [0.4, 0.3, 1.2]}],
  "primitive_poses": [{"position": {"x": 2, "y": -0.5, "z": 0.6},
                       "orientation": {"x": 0, "y": 0, "z": 0, "w": 1}}],
  "operation": 0
})";

inline constexpr std::string_view kEachShape = R"({
  "header": {"frame_id": "map"},
  "id": "shelf", "type": {"key": "shelf", "db": "hall"},
  "primitives": [{"type": 2, "dimensions": [0.5]}, {"type": 3, "dimensions": [1.8, 0.3]},
                 {"type": 4, "dimensions": [0.7, 0.2]}],
  "primitive_poses": [{"position": {"x": 1}}, {"position": {"x": 2}}, {"position": {"x": 3}}],
  "meshes": [{"triangles": [{"vertex_indices": [0, 1, 2]}],
              "vertices": [{"x": 0, "y": 0, "z": 0}, {"x": 1, "y": 0, "z": 0}, {"y": 1}]}],
  "mesh_poses": [{"position": {"x": 4}}],
  "planes": [{"coef": [1, 0, 0, -20]}],
  "plane_poses": [{}],
  "operation": 2
})";

inline constexpr std::string_view kEachConstraint = R"({
  "name": "row",
  "joint_constraints": [{"joint_name": "base/y", "position": 1.5, "tolerance_above": 0.5,
                         "tolerance_below": 0.25, "weight": 2}],
  "position_constraints": [{"header": {"frame_id": "1"}, "link_name": "base_link",
    "target_point_offset": {"x": 0.4, "y": 0, "z": 0.1},
    "constraint_region": {
      "primitives": [{"type": 1, "dimensions": [20, 10, 2]}],
      "primitive_poses": [{"position": {"x": 10, "y": 0, "z": 1}}],
      "meshes": [{"triangles": [{"vertex_indices": [0, 1, 2]}],
                  "vertices": [{"x": 0}, {"x": 5}, {"y": 5}]}],
      "mesh_poses": [{"position": {"x": 20}}]}}],
  "orientation_constraints": [{"header": {"frame_id": "map"},
    "orientation": {"x": 0, "y": 0, "z": 0.7071067811865476, "w": 0.7071067811865476},
    "link_name": "base_link", "absolute_x_axis_tolerance": 0.2, "absolute_y_axis_tolerance": 0.3,
    "absolute_z_axis_tolerance": 3.2, "weight": 0.5}],
  "visibility_constraints": [{"target_radius": 0.2,
    "target_pose": {"header": {"frame_id": "map"}, "pose": {"position": {"x": 5, "z": 1}}},
    "cone_sides": 8,
    "sensor_pose": {"header": {"frame_id": "base_link"}, "pose": {"position": {"z": 1}}},
    "max_view_angle": 0.5, "max_range_angle": 0.25, "sensor_view_direction": 2, "weight": 1}]
})";

/// `text` with the first `what` replaced.
inline std::string with(std::string_view text, std::string_view what, std::string_view by) {
  std::string out(text);
  return out.replace(out.find(what), what.size(), by);
}

/// "done" with its notes, or "path: why": of the first message, or of the whole.
template <class Messages>
std::string outcome(const Messages& messages) {
  const auto refused = [](const scene::Refusal& refusal) {
    return refusal.path + ": " + refusal.why;
  };
  if (!messages.ok()) return "whole: " + refused(messages.error());
  if (messages->messages.empty()) return "nothing";
  const auto& result = messages->messages[0].result;
  if (!result.ok()) return refused(result.error());
  std::string text = "done";
  for (const std::string& note : result->notes) text += "; " + note;
  return text;
}

inline std::string object(std::string_view text) {
  return outcome(parse_collision_objects(text, Retain::no));
}

inline std::string constraints(std::string_view text) {
  return outcome(parse_planning_constraints(text, Retain::no));
}

template <class Message>
std::string written(const Message& message) {
  json::JsonText out;
  write_scene(out, message);
  return out.take();
}

}  // namespace drover::publish
