// A sensor sees a disc: under angles that are small enough, and nothing stands between.
#include <algorithm>
#include <cmath>

#include "drover/angle.h"
#include "drover/rotation.h"
#include "scene/constraint/kinds.h"
#include "scene/constraint/view.h"
#include "scene/world/rigid.h"
#include "scene/world/words.h"

namespace drover::scene {
namespace {

double angle_rad(const Vector3& a, const Vector3& b) {
  return std::atan2(length(cross(a, b)), dot(a, b));
}

/// The sensor's z, y or x.
std::optional<Vector3> view_axis(const VisibilityConstraint& visibility, const Pose& sensor) {
  switch (visibility.sensor_view_direction) {
    case VisibilityConstraint::SENSOR_Z: return rotate(sensor.orientation, {0, 0, 1});
    case VisibilityConstraint::SENSOR_Y: return rotate(sensor.orientation, {0, 1, 0});
    case VisibilityConstraint::SENSOR_X: return rotate(sensor.orientation, {1, 0, 0});
    default: return std::nullopt;
  }
}

std::optional<Pose> in_map(const PoseStamped& stamped, const Setting& setting) {
  const auto frame = frame_of(setting, stamped.header.frame_id);
  if (!frame) return std::nullopt;
  return rigid::product(*frame, stamped.pose);
}

/// Half a turn to the back is too much, however large `most_rad` is. 0: any.
Finding judge_angle(double off_rad, double most_rad, std::string_view what) {
  if (most_rad == 0) return holding();
  const double allowed_rad = std::min(most_rad, kPi / 2);
  if (off_rad <= allowed_rad) return holding();
  return {false, off_rad - allowed_rad,
          words::number(to_deg(off_rad), 1) + " deg " + std::string(what) + ", allowed " +
              words::number(to_deg(allowed_rad), 1)};
}

}  // namespace

Finding finding_of(const VisibilityConstraint& visibility, const Setting& setting) {
  const std::string& sensor_frame = visibility.sensor_pose.header.frame_id;
  const std::string& target_frame = visibility.target_pose.header.frame_id;
  const auto sensor = in_map(visibility.sensor_pose, setting);
  if (!sensor) return unknown("the robot has no frame " + words::quoted(sensor_frame));
  const auto target = in_map(visibility.target_pose, setting);
  if (!target) return unknown("the robot has no frame " + words::quoted(target_frame));
  if (!rigid::is_finite(*sensor) || !rigid::is_finite(*target))
    return unknown("the robot's place is not known");
  const auto axis = view_axis(visibility, *sensor);
  if (!axis) return unknown("its sensor_view_direction is none of 0, 1 and 2");
  const bool has_cone = visibility.target_radius != 0;
  if (!has_cone && visibility.max_view_angle == 0 && visibility.max_range_angle == 0)
    return unknown("it bounds nothing: radius and both angles are 0");

  const Vector3 towards_sensor = rotate(target->orientation, {0, 0, -1});
  Finding seen = judge_angle(angle_rad(*axis, towards_sensor), visibility.max_view_angle,
                             "between the view and the target's back");
  if (!seen.holds) return seen;
  const Vector3 way = target->position_m - sensor->position_m;
  seen = judge_angle(angle_rad(*axis, way), visibility.max_range_angle,
                     "beside the middle of the view");
  if (!seen.holds || !has_cone) return seen;
  const View view{*sensor, *target, visibility.target_radius, visibility.cone_sides};
  if (const auto hidden = what_hides(view, setting, sensor_frame, target_frame))
    return {false, 1, *hidden};
  return holding();
}

}  // namespace drover::scene
