#include "scene/world/rigid.h"

#include <cmath>

namespace drover::scene::rigid {

std::array<Vector3, 3> matrix(const Quaternion& turn) {
  const Vector3 x = rotate(turn, {1, 0, 0});
  const Vector3 y = rotate(turn, {0, 1, 0});
  const Vector3 z = rotate(turn, {0, 0, 1});
  return {{{x.x, y.x, z.x}, {x.y, y.y, z.y}, {x.z, y.z, z.z}}};
}

Pose product(const Pose& outer, const Pose& inner) {
  return {in_parent(outer, inner.position_m), outer.orientation * inner.orientation};
}

Vector3 in_parent(const Pose& pose, const Vector3& own) {
  return pose.position_m + rotate(pose.orientation, own);
}

Vector3 in_own(const Pose& pose, const Vector3& parent) {
  return rotate(conjugate(pose.orientation), parent - pose.position_m);
}

bool is_finite(const Pose& pose) {
  const Quaternion& q = pose.orientation;
  return is_finite(pose.position_m) && std::isfinite(q.w) && std::isfinite(q.x) &&
         std::isfinite(q.y) && std::isfinite(q.z);
}

}  // namespace drover::scene::rigid
