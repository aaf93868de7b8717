#include "scene/plane/motion3.h"

#include <cmath>

namespace drover::scene {

Motion3 motion_of(const Pose& pose) {
  const Quaternion& q = pose.orientation;
  const double length = std::sqrt(q.w * q.w + q.x * q.x + q.y * q.y + q.z * q.z);
  if (length == 0) return {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}, pose.position_m};
  const double w = q.w / length;
  const double x = q.x / length;
  const double y = q.y / length;
  const double z = q.z / length;
  return {{1 - 2 * (y * y + z * z), 2 * (x * y + w * z), 2 * (x * z - w * y)},
          {2 * (x * y - w * z), 1 - 2 * (x * x + z * z), 2 * (y * z + w * x)},
          {2 * (x * z + w * y), 2 * (y * z - w * x), 1 - 2 * (x * x + y * y)},
          pose.position_m};
}

Vector3 turned(const Motion3& motion, const Vector3& v) {
  const auto& [x, y, z, move_m] = motion;
  return {v.x * x.x + v.y * y.x + v.z * z.x, v.x * x.y + v.y * y.y + v.z * z.y,
          v.x * x.z + v.y * y.z + v.z * z.z};
}

Vector3 moved(const Motion3& motion, const Vector3& point_m) {
  const Vector3 v = turned(motion, point_m);
  return {v.x + motion.move_m.x, v.y + motion.move_m.y, v.z + motion.move_m.z};
}

bool is_finite(const Motion3& motion) {
  return is_finite(motion.x_axis) && is_finite(motion.y_axis) && is_finite(motion.z_axis) &&
         is_finite(motion.move_m);
}

}  // namespace drover::scene
