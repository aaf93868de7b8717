// CollisionObject: what each operation needs.
#include <string>
#include <utility>

#include "scene/message/check.h"
#include "scene/message/validate.h"

namespace drover::scene {
namespace {

using check::Notes;
using check::Problem;

bool has_shapes(const CollisionObject& object) {
  return !object.primitives.empty() || !object.meshes.empty() || !object.planes.empty();
}

bool has_poses(const CollisionObject& object) {
  return !object.primitive_poses.empty() || !object.mesh_poses.empty() ||
         !object.plane_poses.empty();
}

Problem check_names(const CollisionObject& object) {
  if (auto problem = check::name("id", object.id)) return problem;
  if (auto problem = check::text("type.key", object.type.key)) return problem;
  if (auto problem = check::text("type.db", object.type.db)) return problem;
  if (object.operation <= CollisionObject::MOVE) return std::nullopt;
  return Refusal{"operation", "is " + std::to_string(object.operation) +
                                  ": it must be ADD 0, REMOVE 1, APPEND 2 or MOVE 3"};
}

Problem check_shapes(CollisionObject& object, Notes& notes) {
  if (!has_shapes(object))
    return Refusal{"primitives", "there is no shape: it must have primitives, meshes or planes"};
  if (auto problem = check::primitives("primitives", object.primitives)) return problem;
  if (auto problem = check::meshes("meshes", object.meshes)) return problem;
  if (auto problem = check::planes("planes", object.planes)) return problem;
  const auto poses = [&notes](const char* path, std::vector<Pose>& of, std::size_t shapes) {
    return check::poses(path, of, shapes, notes);
  };
  if (auto problem = poses("primitive_poses", object.primitive_poses, object.primitives.size()))
    return problem;
  if (auto problem = poses("mesh_poses", object.mesh_poses, object.meshes.size())) return problem;
  return poses("plane_poses", object.plane_poses, object.planes.size());
}

Problem check_move(CollisionObject& object, Notes& notes) {
  for (const auto& [path, count] : {std::pair{"primitives", object.primitives.size()},
                                    {"meshes", object.meshes.size()},
                                    {"planes", object.planes.size()}}) {
    if (count > 0)
      return Refusal{path, "must be empty: MOVE gives the shapes that are there new poses"};
  }
  if (!has_poses(object))
    return Refusal{"primitive_poses", "there is no pose: MOVE has one for each shape"};
  for (const auto& [path, poses] : {std::pair{"primitive_poses", &object.primitive_poses},
                                    {"mesh_poses", &object.mesh_poses},
                                    {"plane_poses", &object.plane_poses}}) {
    // As many as shapes at most: how many those are is not known here.
    const std::size_t shapes = poses->size();
    if (shapes > kMaxShapes)
      return Refusal{path, "has " + std::to_string(shapes) + " poses, at most " +
                               std::to_string(kMaxShapes) + " are allowed"};
    if (auto problem = check::poses(path, *poses, shapes, notes)) return problem;
  }
  return std::nullopt;
}

/// Nobody checked it, so nobody may use it.
void drop_shapes(CollisionObject& object, Notes& notes) {
  if (!has_shapes(object) && !has_poses(object)) return;
  check::note(notes, "operation", "REMOVE takes the whole object: shapes and poses are ignored");
  object.primitives.clear();
  object.primitive_poses.clear();
  object.meshes.clear();
  object.mesh_poses.clear();
  object.planes.clear();
  object.plane_poses.clear();
}

Problem check_object(CollisionObject& object, Notes& notes) {
  if (auto problem = check_names(object)) return problem;
  if (object.operation == CollisionObject::REMOVE) {
    drop_shapes(object, notes);
    object.header = Header{object.header.seq, {}, {}};
    return std::nullopt;
  }
  if (auto problem = check::header("header", object.header)) return problem;
  if (object.operation == CollisionObject::MOVE) return check_move(object, notes);
  return check_shapes(object, notes);
}

}  // namespace

Result<Accepted<CollisionObject>, Refusal> validate(CollisionObject object) {
  Notes notes;
  if (auto problem = check_object(object, notes)) return *problem;
  return Accepted<CollisionObject>{std::move(object), std::move(notes)};
}

}  // namespace drover::scene
