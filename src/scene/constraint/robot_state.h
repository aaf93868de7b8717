// What constraints are judged by: where the robot is and how its joints stand.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "scene/world/planar_pose.h"

namespace drover::scene {

/// In rad or m.
struct JointReading {
  std::string name;
  double position = 0;
  double velocity = 0;      ///< rad/s or m/s; looked at only with a horizon
  bool continuous = false;  ///< turns without an end: angles are compared by the shorter turn
};

/// Of the base, REP 103.
struct Tilt {
  double roll_rad = 0;
  double pitch_rad = 0;
};

/// A number that is not finite is not known, and what needs it does not hold.
struct RobotState {
  Pose2 base;  ///< in the map of the origin in force
  /// From the inertial sensor; nothing when it is not measured: then places are those of level
  /// ground, and an orientation that bounds x or y does not hold.
  std::optional<Tilt> tilt;
  std::vector<JointReading> joints;
};

}  // namespace drover::scene
