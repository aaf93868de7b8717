#include "scene/plane/motion3.h"

#include "drover/rotation.h"

namespace drover::scene {

Motion3 motion_of(const Pose& pose) {
  if (length(pose.orientation) == 0) return {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}, pose.position_m};
  const Quaternion turn = normalised(pose.orientation);
  return {rotate(turn, {1, 0, 0}), rotate(turn, {0, 1, 0}), rotate(turn, {0, 0, 1}),
          pose.position_m};
}

Vector3 turned(const Motion3& motion, const Vector3& v) {
  return v.x * motion.x_axis + v.y * motion.y_axis + v.z * motion.z_axis;
}

Vector3 moved(const Motion3& motion, const Vector3& point_m) {
  return turned(motion, point_m) + motion.move_m;
}

bool is_finite(const Motion3& motion) {
  return is_finite(motion.x_axis) && is_finite(motion.y_axis) && is_finite(motion.z_axis) &&
         is_finite(motion.move_m);
}

}  // namespace drover::scene
