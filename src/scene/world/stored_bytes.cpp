#include "scene/world/stored_bytes.h"

namespace drover::scene {
namespace {

constexpr std::size_t kNumber = 25;   // "-2.2250738585072014e-308,"
constexpr std::size_t kInteger = 12;  // "-2147483648,"
constexpr std::size_t kPoint = 20 + 3 * kNumber;
constexpr std::size_t kQuaternion = 26 + 4 * kNumber;
constexpr std::size_t kPose = 34 + kPoint + kQuaternion;
constexpr std::size_t kTriangle = 24 + 3 * kInteger;
constexpr std::size_t kStoreHead = 160;  // its line: kind, arrival, length
constexpr std::size_t kPlaceSigma = 18 + kNumber;
// An object that is larger than a message is several, each with its head and at most 4.1 kB: per
// thousand shapes, and twice per 10 000 triangles or 30 000 vertices.
constexpr std::size_t kShareOfMessage = 5;
constexpr std::size_t kShareOfMesh = 1;

std::size_t of(const std::string& text) {
  return 3 + 6 * text.size();
}

std::size_t of(const Header& header) {
  return 64 + 3 * kInteger + of(header.frame_id);
}

std::size_t of(const SolidPrimitive& primitive) {
  return 40 + kNumber * primitive.dimensions.size();
}

std::size_t of(const Mesh& mesh) {
  return 32 + (kTriangle + kShareOfMesh) * mesh.triangles.size() +
         (kPoint + kShareOfMesh) * mesh.vertices.size();
}

std::size_t of(const Plane& plane) {
  return 16 + kNumber * plane.coef.size();
}

template <class Shape>
std::size_t of(const std::vector<Placed<Shape>>& list) {
  std::size_t bytes = 0;
  for (const Placed<Shape>& placed : list) bytes += of(placed.shape) + kPose + kShareOfMessage;
  return bytes;
}

std::size_t of(const BoundingVolume& region) {
  std::size_t bytes = 80 + kPose * (region.primitive_poses.size() + region.mesh_poses.size());
  for (const SolidPrimitive& primitive : region.primitives) bytes += of(primitive);
  for (const Mesh& mesh : region.meshes) bytes += of(mesh);
  return bytes;
}

std::size_t of(const JointConstraint& joint) {
  return 90 + of(joint.joint_name) + 4 * kNumber;
}

std::size_t of(const PositionConstraint& position) {
  return 100 + of(position.header) + of(position.link_name) + kPoint +
         of(position.constraint_region) + kNumber;
}

std::size_t of(const OrientationConstraint& orientation) {
  return 180 + of(orientation.header) + of(orientation.link_name) + kQuaternion + 4 * kNumber;
}

std::size_t of(const PoseStamped& stamped) {
  return 24 + of(stamped.header) + kPose;
}

std::size_t of(const VisibilityConstraint& sight) {
  return 180 + of(sight.target_pose) + of(sight.sensor_pose) + 2 * kInteger + 4 * kNumber;
}

template <class Kind>
std::size_t of(const std::vector<Kind>& list) {
  std::size_t bytes = 0;
  for (const Kind& one : list) bytes += of(one) + 1;
  return bytes;
}

}  // namespace

std::size_t stored_bytes_of_head(const Object& object) {
  return kStoreHead + 2 * of(object.id) + of(object.type.key) + of(object.type.db) + 320 +
         kPlaceSigma + 4 * kInteger;
}

std::size_t stored_bytes_of_shapes(const Object& object) {
  return of(object.primitives) + of(object.meshes) + of(object.planes);
}

std::size_t stored_bytes(const Constraints& set) {
  return kStoreHead + 2 * of(set.name) + 140 + of(set.joint_constraints) +
         of(set.position_constraints) + of(set.orientation_constraints) +
         of(set.visibility_constraints);
}

}  // namespace drover::scene
