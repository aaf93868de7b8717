#include "scene/world/object.h"

namespace drover::scene {
namespace {

template <class Shape>
void list_placed(const std::vector<Placed<Shape>>& placed, std::vector<Shape>& shapes,
                 std::vector<Pose>& poses) {
  for (const Placed<Shape>& one : placed) {
    shapes.push_back(one.shape);
    poses.push_back(one.in_map);
  }
}

}  // namespace

CollisionObject as_message(const Object& object) {
  CollisionObject message;
  message.header.frame_id = "map";
  message.id = object.id;
  message.type = object.type;
  list_placed(object.primitives, message.primitives, message.primitive_poses);
  list_placed(object.meshes, message.meshes, message.mesh_poses);
  list_placed(object.planes, message.planes, message.plane_poses);
  return message;
}

}  // namespace drover::scene
