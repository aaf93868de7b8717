// What somebody who looks around the robot has to know of it.
#pragma once

#include <cstdint>

#include "drover/measurement.h"
#include "drover/path.h"
#include "drover/snapshot.h"
#include "drover/time.h"
#include "drover/twist.h"

namespace drover {

/// What of its track a task still has to drive: from a place on it to its target.
struct WayLeft {
  std::uint64_t path = 0;     ///< Path::number; 0: there is no task
  bool forwards = true;       ///< through the list of its points; else from its end
  std::uint32_t target = 0;   ///< index of the point that it ends at
  std::uint32_t segment = 0;  ///< index of the point that it comes from, in the list
  double along_m = 0;         ///< past that point, towards the next one
  bool flipped = false;       ///< Path::backwards is the other way round
};

/// Made by the engine in each cycle, of one instant.
struct Viewpoint {
  Time t = kNever;  ///< of the pose
  /// A sigma that is absent: the position, or the heading, is not known.
  Pose pose;
  /// Grows when poses before and after it cannot be compared: another origin, a place that was lost
  /// or found, a jump.
  std::uint32_t place = 0;
  bool origin_set = false;
  GeodeticPoint origin;  ///< of the map that the pose is in
  Twist commanded;       ///< in this cycle
  /// What the owner of the base would have it do, before anything bounds it: where it would go.
  Twist asked;
  WayLeft way;
  Owner owner = Owner::nobody;              ///< who moves it, though it may stand and wait
  double roll_rad = kAbsent;                ///< absent: no inertial sensor tells it
  double pitch_rad = kAbsent;               ///< likewise
  FixedVector<double, kMaxAxes> joint_rad;  ///< positions, by AxisId
};

}  // namespace drover
