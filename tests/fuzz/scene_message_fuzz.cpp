// Any bytes as messages of the planning scene: no crash, an answer always, and what is accepted is
// good for whoever counts with it.
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <string_view>

#include "json/located_json.h"
#include "publish/scene/messages.h"
#include "publish/scene/scene_feedback.h"
#include "scene/message/frames.h"

namespace {

using namespace drover;
using namespace drover::publish;

void require(bool holds) {
  if (!holds) std::abort();
}

void check_pose(const scene::Pose& pose) {
  const auto& [position_m, q] = pose;
  for (const double each_m : {position_m.x, position_m.y, position_m.z})
    require(std::abs(each_m) <= scene::kMaxCoordinate_m);
  require(std::abs(q.w * q.w + q.x * q.x + q.y * q.y + q.z * q.z - 1) < 1e-9);
}

std::size_t dimensions_of(std::uint8_t type) {
  switch (type) {
    case scene::SolidPrimitive::BOX: return 3;
    case scene::SolidPrimitive::SPHERE: return 1;
    default: return 2;
  }
}

void check_shapes(const std::vector<scene::SolidPrimitive>& primitives,
                  const std::vector<scene::Mesh>& meshes) {
  for (const auto& primitive : primitives) {
    require(primitive.type >= 1 && primitive.type <= 4);
    require(primitive.dimensions.size() == dimensions_of(primitive.type));
    for (const double size_m : primitive.dimensions)
      require(size_m > 0 && size_m <= scene::kMaxSize_m);
  }
  for (const auto& mesh : meshes) {
    require(!mesh.triangles.empty());
    for (const auto& triangle : mesh.triangles)
      for (const std::uint32_t index : triangle) require(index < mesh.vertices.size());
    for (const Vector3& vertex : mesh.vertices) check_pose({vertex, {}});
  }
}

void check(const scene::CollisionObject& object) {
  require(!object.id.empty() && object.operation <= 3);
  check_shapes(object.primitives, object.meshes);
  for (const auto& plane : object.planes) {
    const double normal = std::hypot(plane.coef[0], plane.coef[1], plane.coef[2]);
    require(normal > 0 && std::isfinite(plane.coef[3] / normal));
  }
  for (const auto* poses : {&object.primitive_poses, &object.mesh_poses, &object.plane_poses})
    for (const scene::Pose& pose : *poses) check_pose(pose);
  if (object.operation == scene::CollisionObject::REMOVE) return;
  require(!scene::is_no_frame(object.header.frame_id));
  const bool moves = object.operation == scene::CollisionObject::MOVE;
  require(object.primitives.size() == (moves ? 0 : object.primitive_poses.size()));
  require(object.meshes.size() == (moves ? 0 : object.mesh_poses.size()));
  require(object.planes.size() == (moves ? 0 : object.plane_poses.size()));
}

void check(const scene::Constraints& all) {
  require(!all.name.empty());
  for (const auto& joint : all.joint_constraints)
    require(std::isfinite(joint.position) && joint.tolerance_above >= 0 &&
            joint.tolerance_below >= 0 && joint.weight >= 0);
  for (const auto& position : all.position_constraints) {
    const auto& region = position.constraint_region;
    require(!region.primitives.empty() || !region.meshes.empty());
    check_shapes(region.primitives, region.meshes);
    require(region.primitives.size() == region.primitive_poses.size() &&
            region.meshes.size() == region.mesh_poses.size());
    for (const auto* poses : {&region.primitive_poses, &region.mesh_poses})
      for (const scene::Pose& pose : *poses) check_pose(pose);
  }
  for (const auto& turn : all.orientation_constraints) {
    check_pose({{}, turn.orientation});
    require(turn.absolute_x_axis_tolerance >= 0 && turn.absolute_y_axis_tolerance >= 0 &&
            turn.absolute_z_axis_tolerance >= 0 && turn.weight >= 0);
  }
  for (const auto& sight : all.visibility_constraints) {
    check_pose(sight.target_pose.pose);
    check_pose(sight.sensor_pose.pose);
    require(sight.cone_sides >= 3 && sight.cone_sides <= scene::kMaxConeSides);
    require(sight.sensor_view_direction <= 2 && sight.target_radius >= 0 && sight.weight >= 0);
  }
}

/// A payload as messages of one topic.
template <class Parse>
void follow(std::string_view payload, std::string_view topic, Parse parse) {
  const auto read = parse(payload, Retain::no);
  require(payload.empty() || !parse(payload, Retain::stored).ok());
  if (!read.ok()) {
    require(!read.error().why.empty());
    require(json::parse(scene_feedback_text(answer_to(topic, read.error()))).ok());
    return;
  }
  for (const auto& message : read->messages) {
    require(json::parse(scene_feedback_text(answer_to(message))).ok());
    if (!message.result.ok()) {
      require(!message.result.error().why.empty());
      continue;
    }
    check(message.result->message);
    // What is written is accepted again, and written the same.
    json::JsonText text;
    write_scene(text, message.result->message);
    const auto again = parse(text.str(), Retain::no);
    require(again.ok() && again->messages.at(0).result.ok());
    json::JsonText same;
    write_scene(same, again->messages[0].result->message);
    require(same.str() == text.str());
  }
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::string_view payload(reinterpret_cast<const char*>(data), size);
  follow(payload, kTopicCollisionObject, [](std::string_view text, Retain retain) {
    return parse_collision_objects(text, retain);
  });
  follow(payload, kTopicPlanningConstraints, [](std::string_view text, Retain retain) {
    return parse_planning_constraints(text, retain);
  });
  return 0;
}
