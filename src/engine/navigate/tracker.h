// Follows a polyline: where the robot is along it, and the twist that keeps it there.
#pragma once

#include <cstdint>

#include "drover/path.h"
#include "drover/snapshot.h"
#include "drover/time.h"
#include "engine/config.h"

namespace drover::engine {

/// Twist in base_link (REP 103): m/s ahead, rad/s counter-clockwise.
struct Twist {
  double vx_mps = 0;
  double wz_radps = 0;
};

/// Where a pose is relative to a path that is driven from its point nearest to the start towards
/// `target`, forwards or backwards through the list.
struct TrackProgress {
  double cross_track_m = 0;    ///< left of the direction of travel positive
  double heading_error_rad = 0;  ///< of the robot against the direction of travel
  double distance_left_m = 0;  ///< along the path to the target point
  double distance_to_goal_m = 0;  ///< straight line to the target point
  bool arrived = false;        ///< inside the tolerance, or the goal was passed along the path
};

/// Why a path cannot be driven; empty when it can. Index counts as the operator does, from 1.
Reason check_path(const Path& path, std::uint32_t target);

class Tracker final {
 public:
  Tracker(const NavigateConfig& config, const LimitsConfig& limits);

  /// Starts on `path` (borrowed until the next begin/end) from the point of it nearest to `pose`.
  void begin(const Path& path, std::uint32_t target, double speed_mps, const Pose& pose);
  void end();
  bool active() const;

  /// Progress at a pose, advancing monotonically along the path (a crossing track stays on its leg).
  TrackProgress locate(const Pose& pose);
  /// The twist wanted now. `speed_cap_mps` is the least of all caps in force (far zone, error budget).
  /// Speed is shaped only by the path (curvature, end); acceleration and jerk are the gate's.
  Twist follow(const Pose& pose, const TrackProgress& progress, double speed_cap_mps, Duration dt);
};

}  // namespace drover::engine
