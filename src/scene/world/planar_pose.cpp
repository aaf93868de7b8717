#include "scene/world/planar_pose.h"

#include <cmath>

#include "drover/angle.h"
#include "drover/rotation.h"

namespace drover::scene {

Pose upright(const Pose2& pose) {
  return {{pose.x_m, pose.y_m, 0}, about_z(pose.yaw_rad)};
}

Pose2 product(const Pose2& outer, const Pose2& inner) {
  const double c = std::cos(outer.yaw_rad);
  const double s = std::sin(outer.yaw_rad);
  return {outer.x_m + c * inner.x_m - s * inner.y_m, outer.y_m + s * inner.x_m + c * inner.y_m,
          wrap_rad(outer.yaw_rad + inner.yaw_rad)};
}

Pose2 back(const Pose2& pose) {
  const double c = std::cos(pose.yaw_rad);
  const double s = std::sin(pose.yaw_rad);
  return {-c * pose.x_m - s * pose.y_m, s * pose.x_m - c * pose.y_m, wrap_rad(-pose.yaw_rad)};
}

}  // namespace drover::scene
