// The rules of one joint, and what its drive makes of a set point, for tests of the shaper.
#pragma once

#include "engine/group/joint_shaper.h"

namespace drover::engine {

inline constexpr double kCycle_s = 0.005;

inline JointRules rules_of(JointFollows follows) {
  JointRules rules;
  rules.follows = follows;
  rules.min_rad = -1;
  rules.max_rad = 1.5;
  rules.max_velocity_radps = 1;
  rules.max_acceleration_radps2 = 5;
  rules.max_effort_Nm = 4;
  rules.stiffness_Nmprad = 40;
  rules.damping_Nmsprad = 2;
  rules.rise_s = 0.5;
  return rules;
}

inline JointRules carries(JointRules rules) {
  rules.carries_weight = true;
  return rules;
}

inline JointTarget at(double position_rad, double stiffness = 40, double damping = 2) {
  JointTarget target;
  target.position_rad = position_rad;
  target.stiffness_Nmprad = stiffness;
  target.damping_Nmsprad = damping;
  return target;
}

/// What the drive makes of it, with the joint where it was measured.
inline double torque_of(const JointShaper& shaper, const JointMeasured& measured) {
  const Impedance& law = shaper.impedance();
  return law.stiffness_Nmprad * (law.position_rad - measured.position_rad) +
         law.damping_Nmsprad * (shaper.velocity_radps() - measured.velocity_radps) + law.effort_Nm;
}

}  // namespace drover::engine
