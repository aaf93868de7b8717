// What the motors of an arm were told, on the wire and by hand: see wire_damiao.h.
#pragma once

#include <array>

#include "mission/conduct.h"
#include "mission/wire_damiao.h"

namespace drover::mission {

/// Of a joint, as its gateway's configuration has them.
struct ArmBounds {
  double max_velocity_radps = 0;
  double stiffness = 0;  ///< of holding
  double rise_s = 0.5;
};
using AllArmBounds = std::array<ArmBounds, damiao::kMotors>;

/// The bounds that stand in the configuration of the scenario's gateway.
AllArmBounds read_arm_bounds(const std::string& scenario);

/// No set point has a step in it: a position moves as fast as its joint may, or what the motor
/// makes of it stays as it was, as when a hold begins where the joint stands; stiffness comes up
/// within its time; and whoever has none begins where the motor says that the joint is.
Problems check_arm_steps(const Record& record, const AllArmBounds& bounds);

/// From `begin` to `end` each motor is told to damp, at least as often as it needs, and nothing
/// else.
Problems check_arm_only_damped(const Record& record, Time begin, Time end);

/// What was told to a joint (from 0), from `begin` to `end`.
struct ArmSetPoint {
  Time time = kNever;
  damiao::SetPoint told;
};
std::vector<ArmSetPoint> arm_set_points(const Record& record, std::size_t joint,
                                        Time begin = kNever, Time end = Time::max());

}  // namespace drover::mission
