// Convex bodies and whether two of them meet: by a support mapping (GJK).
#pragma once

#include <cstdint>
#include <span>
#include <variant>

#include "scene/message/header.h"
#include "scene/message/shapes.h"

namespace drover::scene {

/// A type that there is, with as many dimensions as it has.
bool has_dimensions(const SolidPrimitive& shape);

/// In the frame of `pose`: a primitive, or the convex hull of points. It views what it is made of.
struct Convex {
  std::variant<const SolidPrimitive*, std::span<const Vector3>> shape;
  Pose pose;
};

/// The point of the body that is farthest in this direction, both in the pose's parent.
Vector3 farthest(const Convex& body, const Vector3& direction);

/// `apart` and `together` are proven: by a plane between them, by a common point or one nearer than
/// a micrometre. What the numbers do not decide is said so, and its user takes the safe side.
struct Separation {
  enum class Meeting : std::uint8_t { apart, together, undecided };
  Meeting meeting = Meeting::undecided;
  double at_least_m = 0;  ///< apart by so much, to one per cent
};
Separation separation(const Convex& a, const Convex& b);

}  // namespace drover::scene
