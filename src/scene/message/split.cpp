#include "scene/message/split.h"

#include <algorithm>
#include <cstddef>

#include "scene/message/validate.h"

namespace drover::scene {
namespace {

/// How much of an object is in messages already.
struct Taken {
  std::size_t primitives = 0;
  std::size_t meshes = 0;
  std::size_t planes = 0;
};

template <class Shape>
void take(const std::vector<Shape>& shapes, const std::vector<Pose>& poses, std::size_t& taken,
          std::size_t count, std::vector<Shape>& into, std::vector<Pose>& into_poses) {
  for (const std::size_t end = taken + count; taken < end; ++taken) {
    into.push_back(shapes[taken]);
    into_poses.push_back(taken < poses.size() ? poses[taken] : Pose{});
  }
}

std::size_t at_most_a_message(std::size_t left) {
  return std::min(left, kMaxShapes);
}

/// How many of the meshes from `first` on go into one message; one goes always.
std::size_t meshes_of_a_message(const std::vector<Mesh>& meshes, std::size_t first) {
  std::size_t triangles = 0;
  std::size_t vertices = 0;
  std::size_t count = 0;
  for (; count < at_most_a_message(meshes.size() - first); ++count) {
    triangles += meshes[first + count].triangles.size();
    vertices += meshes[first + count].vertices.size();
    if (count > 0 && (triangles > kMaxTriangles || vertices > kMaxVertices)) break;
  }
  return count;
}

CollisionObject next(const CollisionObject& object, Taken& taken) {
  CollisionObject part;
  part.header = object.header;
  part.id = object.id;
  part.type = object.type;
  take(object.primitives, object.primitive_poses, taken.primitives,
       at_most_a_message(object.primitives.size() - taken.primitives), part.primitives,
       part.primitive_poses);
  take(object.meshes, object.mesh_poses, taken.meshes,
       meshes_of_a_message(object.meshes, taken.meshes), part.meshes, part.mesh_poses);
  take(object.planes, object.plane_poses, taken.planes,
       at_most_a_message(object.planes.size() - taken.planes), part.planes, part.plane_poses);
  part.operation = CollisionObject::APPEND;
  return part;
}

}  // namespace

std::vector<CollisionObject> in_messages(const CollisionObject& object) {
  std::vector<CollisionObject> parts;
  Taken taken;
  do {
    parts.push_back(next(object, taken));
  } while (taken.primitives < object.primitives.size() || taken.meshes < object.meshes.size() ||
           taken.planes < object.planes.size());
  parts.front().operation = object.operation;
  return parts;
}

}  // namespace drover::scene
