#include "scene/constraint/convex.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "drover/rotation.h"
#include "scene/constraint/simplex.h"
#include "scene/world/rigid.h"

namespace drover::scene {
namespace {

constexpr int kMostTurns = 64;     // some ten are usual
constexpr double kTouch_m = 1e-6;  // nearer is touching
constexpr double kExact = 0.99;    // of the distance: who asks wants to know whether

Vector3 farthest_of_round(double radius_m, double half_height_m, bool is_cone,
                          const Vector3& direction) {
  const double across = std::hypot(direction.x, direction.y);
  Vector3 rim{0, 0, -half_height_m};
  if (across > 0) {
    rim.x = radius_m * direction.x / across;
    rim.y = radius_m * direction.y / across;
  }
  if (!is_cone) {
    rim.z = std::copysign(half_height_m, direction.z);
    return rim;
  }
  const Vector3 tip{0, 0, half_height_m};
  return dot(tip, direction) > dot(rim, direction) ? tip : rim;
}

/// Of a shape that was never found valid: nothing is known of it, and nothing is decided.
constexpr Vector3 kNowhere{kAbsent, kAbsent, kAbsent};

Vector3 farthest_own(const SolidPrimitive& shape, const Vector3& direction) {
  using Type = SolidPrimitive;
  if (!has_dimensions(shape)) return kNowhere;
  const auto& d = shape.dimensions;
  switch (shape.type) {
    case Type::BOX:
      return {std::copysign(d[Type::BOX_X] / 2, direction.x),
              std::copysign(d[Type::BOX_Y] / 2, direction.y),
              std::copysign(d[Type::BOX_Z] / 2, direction.z)};
    case Type::SPHERE: {
      const double n = length(direction);
      return n > 0 ? d[Type::SPHERE_RADIUS] / n * direction : Vector3{};
    }
    case Type::CYLINDER:
      return farthest_of_round(d[Type::CYLINDER_RADIUS], d[Type::CYLINDER_HEIGHT] / 2, false,
                               direction);
    case Type::CONE:
      return farthest_of_round(d[Type::CONE_RADIUS], d[Type::CONE_HEIGHT] / 2, true, direction);
    default: return kNowhere;
  }
}

Vector3 farthest_own(std::span<const Vector3> points, const Vector3& direction) {
  const Vector3* best = nullptr;
  double farthest = -std::numeric_limits<double>::infinity();
  for (const Vector3& point : points) {
    const double along = dot(point, direction);
    if (std::isnan(along)) return kNowhere;
    if (along < farthest) continue;
    farthest = along;
    best = &point;
  }
  return best != nullptr ? *best : kNowhere;
}

}  // namespace

bool has_dimensions(const SolidPrimitive& shape) {
  switch (shape.type) {
    case SolidPrimitive::BOX: return shape.dimensions.size() >= 3;
    case SolidPrimitive::SPHERE: return !shape.dimensions.empty();
    case SolidPrimitive::CYLINDER:
    case SolidPrimitive::CONE: return shape.dimensions.size() >= 2;
    default: return false;
  }
}

Vector3 farthest(const Convex& body, const Vector3& direction) {
  const Vector3 own = rotate(conjugate(body.pose.orientation), direction);
  if (const auto* points = std::get_if<std::span<const Vector3>>(&body.shape))
    return rigid::in_parent(body.pose, farthest_own(*points, own));
  return rigid::in_parent(body.pose, farthest_own(**std::get_if<0>(&body.shape), own));
}

// Gilbert, Johnson and Keerthi: walks over the bodies' difference towards the origin. Every step
// gives a plane with the whole difference behind it; when the origin is before that plane, the
// bodies are apart, however the numbers were rounded on the way there.
Separation separation(const Convex& a, const Convex& b) {
  const auto corner = [&](const Vector3& direction) {
    return farthest(a, direction) - farthest(b, -direction);
  };
  Simplex simplex;
  simplex.add(corner({1, 0, 0}));
  Separation found;
  for (int turn = 0; turn < kMostTurns; ++turn) {
    const Simplex::Nearest nearest = simplex.reduce_to_nearest();
    const double distance_m = length(nearest.point);
    if (nearest.encloses || distance_m <= kTouch_m) {
      found.meeting = Separation::Meeting::together;
      return found;
    }
    const Vector3 next = corner(-nearest.point);
    const double at_least_m = dot(nearest.point, next) / distance_m;
    found.at_least_m = std::max(found.at_least_m, at_least_m);
    if (found.at_least_m > kTouch_m) found.meeting = Separation::Meeting::apart;
    if (found.at_least_m >= kExact * distance_m || !simplex.add(next)) return found;
  }
  return found;
}

}  // namespace drover::scene
