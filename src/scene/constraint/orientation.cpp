// The link's turn from the wanted one, as angles about x, y and z.
#include <array>
#include <cmath>

#include "drover/angle.h"
#include "drover/rotation.h"
#include "scene/constraint/kinds.h"
#include "scene/message/frames.h"
#include "scene/world/rigid.h"
#include "scene/world/words.h"

namespace drover::scene {
namespace {

constexpr double kAngleSlack_rad = 1e-9;
constexpr double kUpright_rad = 1e-6;  // nearer to 90 degrees of pitch, roll and yaw are one turn
constexpr double kUnitLength = 1e-3;   // farther from it a quaternion is none

struct Angles {
  std::array<double, 3> rad{};
};

/// Intrinsic x-y-z: R = Rx Ry Rz. With pitch at 90 degrees only the sum or the difference of roll
/// and yaw is there: roll takes it, unless it breaks the tolerance of yaw.
Angles intrinsic_xyz(const Quaternion& turn, double z_tolerance_rad) {
  const auto m = rigid::matrix(turn);
  const double cos_pitch =
      std::sqrt((m[0].x * m[0].x + m[0].y * m[0].y + m[1].z * m[1].z + m[2].z * m[2].z) / 2);
  const double pitch_rad = std::atan2(m[0].z, cos_pitch);
  if (!(cos_pitch <= kUpright_rad))
    return {{std::atan2(-m[1].z, m[2].z), pitch_rad, std::atan2(-m[0].y, m[0].x)}};
  const double both_rad = m[0].z > 0 ? std::atan2(m[1].x + m[2].y, m[1].y - m[2].x)
                                     : std::atan2(m[2].y - m[1].x, m[1].y + m[2].x);
  if (std::abs(both_rad) > z_tolerance_rad + kAngleSlack_rad) return {{0, pitch_rad, both_rad}};
  return {{both_rad, pitch_rad, 0}};
}

bool is_unit(const Quaternion& q) {
  const double n = std::sqrt(q.w * q.w + q.x * q.x + q.y * q.y + q.z * q.z);
  return std::abs(n - 1) <= kUnitLength;
}

std::string degrees(double rad) {
  return words::number(to_deg(rad), 1);
}

}  // namespace

bool is_free_axis(double tolerance_rad) {
  return tolerance_rad >= kPi;
}

Finding finding_of(const OrientationConstraint& orientation, const Setting& setting) {
  const auto link = link_in_map(setting, orientation.link_name);
  if (!link) return unknown("the robot has no link " + words::quoted(orientation.link_name));
  const auto frame = frame_of(setting, orientation.header.frame_id);
  if (!frame)
    return unknown("the robot has no frame " + words::quoted(orientation.header.frame_id));
  if (!rigid::is_finite(*link) || !rigid::is_finite(*frame))
    return unknown("the robot's heading is not known");
  if (!is_unit(orientation.orientation)) return unknown("its quaternion is not of length 1");

  std::array<double, 3> tolerance_rad{std::abs(orientation.absolute_x_axis_tolerance),
                                      std::abs(orientation.absolute_y_axis_tolerance),
                                      std::abs(orientation.absolute_z_axis_tolerance)};
  // Between two frames of the robot, its tilt says nothing.
  if (!setting.state.tilt && is_global_frame(orientation.header.frame_id)) {
    if (setting.moment == Moment::ahead) {
      tolerance_rad[0] = tolerance_rad[1] = kPi;
    } else if (!is_free_axis(tolerance_rad[0]) || !is_free_axis(tolerance_rad[1])) {
      return unknown("roll and pitch are not measured");
    }
  }
  const Quaternion wanted = frame->orientation * normalised(orientation.orientation);
  const Angles off = intrinsic_xyz(conjugate(wanted) * link->orientation, tolerance_rad[2]);
  Finding finding = holding();
  for (std::size_t axis = 0; axis < 3; ++axis) {
    if (is_free_axis(tolerance_rad[axis])) continue;
    const double angle_rad = std::abs(off.rad[axis]);
    if (angle_rad < tolerance_rad[axis] + kAngleSlack_rad) continue;
    const double error = angle_rad - tolerance_rad[axis];
    if (!finding.holds && !(error > finding.error)) continue;
    finding = {false, error,
               degrees(off.rad[axis]) + " deg about " + "xyz"[axis] + ", allowed " +
                   degrees(tolerance_rad[axis])};
  }
  return finding;
}

}  // namespace drover::scene
