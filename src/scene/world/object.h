// What is kept of the messages: shapes with their place on earth, and constraints by name.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "drover/path.h"
#include "scene/message/collision_object.h"
#include "scene/message/constraints.h"

namespace drover::scene {

/// A pose with the origin that its map had: that is a place on earth.
struct Anchor {
  Pose pose;
  GeodeticPoint origin;
};

template <class Shape>
struct Placed {
  Shape shape;
  Anchor arrived;
  Pose in_map;  ///< under the origin that is in force
};

/// Fixed in `map`; it does not ride along with a frame of the robot that it came in.
struct Object {
  std::string id;
  ObjectType type;
  std::vector<Placed<SolidPrimitive>> primitives;
  std::vector<Placed<Mesh>> meshes;
  std::vector<Placed<Plane>> planes;
  /// All of it may be so far beside its place, one sigma: 0 where it came in `map`.
  double place_sigma_m = 0;
  std::uint64_t revision = 0;  ///< the world's when this last changed
};

/// One Constraints message.
struct ConstraintSet {
  Constraints message;  ///< poses in `map` are of the map about `origin`
  /// In force when it arrived; nothing when nothing in it is in `map`.
  std::optional<GeodeticPoint> origin;
  std::uint64_t revision = 0;
};

/// An ADD in `map` that makes this object under the origin that is in force: for the store and for
/// showing.
CollisionObject as_message(const Object& object);

}  // namespace drover::scene
