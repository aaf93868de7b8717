// Follows a polyline: where the robot is along it, and the twist that keeps it there.
#pragma once

#include <cstdint>

#include "drover/path.h"
#include "drover/snapshot.h"
#include "drover/time.h"
#include "drover/twist.h"
#include "drover/viewpoint.h"
#include "engine/base/kinematics.h"
#include "engine/config.h"
#include "track/flaw.h"
#include "track/legs.h"

namespace drover::engine {

/// Where a pose is relative to a path that is driven from its point nearest to the start towards
/// `target`, forwards or backwards through the list.
struct TrackProgress {
  double cross_track_m = 0;       ///< left of the direction of travel positive
  double heading_error_rad = 0;   ///< of the robot against how it is to look there
  double distance_left_m = 0;     ///< along the path to the target point
  double distance_to_goal_m = 0;  ///< straight line to the target point
  /// At the goal, as near as a stop begun now comes to it; or inside the tolerance and at rest; or
  /// just past it. `distance_to_goal_m` says how near.
  bool arrived = false;
  /// The goal lies behind: driving ahead does not lead there. Without `arrived`: failed.
  bool goal_passed = false;
  bool backwards = false;  ///< it is driven backwards there
  /// Was within 0.2 m of the track since begin: only then a corridor means anything.
  bool joined = false;
};

using track::check_path;

/// Follows a smooth line through the points: curvature ahead of the drives' lag, plus feedback on
/// offset and heading. Where the track has a true corner it stops, turns on the spot and goes on.
/// Where it says so (Path::backwards) it is driven backwards: as if the robot looked the other way.
/// A base that cannot turn on the spot drives on from a corner as it stands there: only one where
/// it goes on the other way is for it (find_tight). One that goes sideways comes back to a line
/// close by so, and keeps its heading along it.
class Tracker final {
 public:
  Tracker(const NavigateConfig& config, const LimitsConfig& limits, const BodyLimits& body = {});

  /// Starts on `path` (borrowed until the next begin/end) from the point of it nearest to `pose`.
  /// `path` must have passed check_path. O(points): about 1 ms for 100 000.
  void begin(const Path& path, std::uint32_t target, double speed_mps, const Pose& pose);
  void end();
  bool active() const { return active_; }
  /// What is left of the path, by the last `locate`; without the path's number.
  WayLeft way() const;

  /// Progress at a pose. The search looks only near the last place, so a track that crosses itself
  /// or comes back close to itself stays on its leg. Call each cycle, also while paused.
  TrackProgress locate(const Pose& pose);
  /// How far another place, a few metres from the last one at the most, is from the track (m).
  double beside_m(const Pose& other) const;
  /// The twist wanted now. `speed_cap_mps` is the least of all caps in force (far zone, error
  /// budget); 0 gives a twist of zero. Speed is shaped only by the path (curvature, end);
  /// acceleration and jerk are the gate's. `may_go_aside`: a base that goes sideways does so now;
  /// else it turns back to its line, as others do.
  Twist follow(const Pose& pose, const TrackProgress& progress, double speed_cap_mps, Duration dt,
               bool may_go_aside = false);

 private:
  enum class Phase : std::uint8_t { follow, halt, pivot };

  void look_for_corner();
  void begin_leg(const track::Leg& leg);
  track::Leg next_leg() const;
  Pose as_driven(const Pose& pose) const;
  Twist as_told(const Twist& twist) const;
  bool is_last_leg() const { return leg_.last + 1 == route_.size(); }
  double stop_distance_m(double speed_mps) const;
  double path_speed_mps(double cap_mps, double s_m) const;
  Twist pivot(const Pose& pose);
  void begin_next_leg();
  double back_to_line_rad(double offset_m, double damping, double stiffness) const;
  Twist steer(const Pose& pose, double cap_mps, Duration dt, bool may_go_aside);

  NavigateConfig config_;
  LimitsConfig limits_;
  BodyLimits body_;
  double braking_mps2_;
  double horizon_m_;  ///< corners are looked for this far ahead
  bool active_ = false;
  track::Route route_;
  track::Leg leg_;
  track::Station station_;  ///< where the robot is
  double s_m_ = 0;
  double goal_m_ = 0;  ///< arc length of the target
  track::Vector goal_;
  track::CornerScan scan_;
  Phase phase_ = Phase::follow;
  double speed_mps_ = 0;
  double yaw_gain_ = 0;  ///< learnt: how much more the base must be asked to turn
  bool joined_ = false;
  bool backwards_ = false;     ///< on this leg
  double next_looks_rad_ = 0;  ///< while it turns: pi when the next one is driven the other way
};

}  // namespace drover::engine
