// -tolerance_below <= q - position <= tolerance_above, now and after the horizon.
#include <algorithm>
#include <cmath>

#include "drover/angle.h"
#include "drover/measurement.h"
#include "scene/constraint/kinds.h"
#include "scene/world/words.h"

namespace drover::scene {
namespace {

constexpr double kJointSlack = 1e-9;  // rad or m

/// The robot's place as a planar joint, in the map that the constraint came in.
std::optional<JointReading> base_reading(const std::string& name, const Setting& setting) {
  Pose2 base = product(back(setting.their_map), setting.state.base);
  // Half a place is none, and a heading without a place is none either.
  if (!is_finite(place_of(base))) base = {kAbsent, kAbsent, kAbsent};
  if (name == "base/x") return JointReading{.name = name, .position = base.x_m};
  if (name == "base/y") return JointReading{.name = name, .position = base.y_m};
  if (name == "base/theta")
    return JointReading{.name = name, .position = base.yaw_rad, .continuous = true};
  return std::nullopt;
}

std::optional<JointReading> reading_of(const std::string& name, const Setting& setting) {
  if (auto base = base_reading(name, setting)) return base;
  for (const JointReading& joint : setting.state.joints) {
    if (joint.name == name) return joint;
  }
  return std::nullopt;
}

double off(const JointConstraint& joint, double position, bool continuous) {
  const double off = position - joint.position;
  return continuous ? std::remainder(off, 2 * kPi) : off;
}

double beyond(const JointConstraint& joint, double off) {
  return std::max(off - joint.tolerance_above, -joint.tolerance_below - off);
}

std::string range_of(const JointConstraint& joint) {
  return words::number(joint.position - joint.tolerance_below, 3) + " to " +
         words::number(joint.position + joint.tolerance_above, 3);
}

Finding judge_joint(const JointConstraint& joint, double position, bool continuous,
                    std::string_view verb) {
  const double off_by = off(joint, position, continuous);
  if (!std::isfinite(off_by) || !std::isfinite(joint.tolerance_above) ||
      !std::isfinite(joint.tolerance_below))
    return unknown("its position is not known");
  const double error = beyond(joint, off_by);
  if (error <= kJointSlack) return holding();
  return {false, error,
          std::string(verb) + " " + words::number(joint.position + off_by, 3) + ", allowed " +
              range_of(joint)};
}

}  // namespace

bool is_of_base(const JointConstraint& joint) {
  return joint.joint_name == "base/x" || joint.joint_name == "base/y" ||
         joint.joint_name == "base/theta";
}

Finding finding_of(const JointConstraint& joint, const Setting& setting) {
  const auto reading = reading_of(joint.joint_name, setting);
  if (!reading) return unknown("the robot has no joint " + words::quoted(joint.joint_name));
  if (is_of_base(joint) && !std::isfinite(reading->position))
    return unknown(is_finite(place_of(setting.state.base)) ? "the robot's heading is not known"
                                                           : "the robot's place is not known");
  Finding present = judge_joint(joint, reading->position, reading->continuous, "is");
  const double horizon_s = setting.terms.joint_horizon_s;
  if (!present.holds || horizon_s == 0 || is_of_base(joint)) return present;
  return judge_joint(joint, reading->position + reading->velocity * horizon_s, reading->continuous,
                     "will be");
}

}  // namespace drover::scene
