// What of the constraints can be said of a track before it is driven.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <optional>
#include <span>
#include <vector>

#include "scene/constraint/evaluate.h"

namespace drover::scene {

/// How much of a constraint is known along a track: of the robot its place and yaw are, its other
/// joints, roll and pitch are not.
enum class Ahead : std::uint8_t { all, yaw_only, nothing };

Ahead known_ahead(const JointConstraint& joint);
Ahead known_ahead(const PositionConstraint& position);
Ahead known_ahead(const OrientationConstraint& orientation);
Ahead known_ahead(const VisibilityConstraint& visibility);

struct Offence {
  std::size_t index = 0;  ///< of the pose
  Verdict verdict;        ///< the one that weighs most there
};

/// Whoever has a clock says whether there is time left for more.
using TimeLeft = std::function<bool()>;

/// The first pose of a track at which a constraint does not hold, a little at a time: one view past
/// many things may take milliseconds, and there may be a thousand of them.
class TrackJudge final {
 public:
  /// Borrows world and robot, which stay as they are until it is over.
  TrackJudge(const World& world, const RobotModel& robot, std::vector<Pose2> track,
             const Terms& terms);

  /// One constraint at one pose at the least, more while there is time; true: it is over.
  bool advance(const TimeLeft& time_left);
  /// Once over: all hold, or what does not.
  const std::optional<Offence>& offence() const { return worst_; }

 private:
  void judge_next();
  void keep_worst(Verdict verdict);

  const World& world_;
  const RobotModel& robot_;
  std::vector<Pose2> track_;
  Terms terms_;
  // What comes next.
  std::size_t pose_ = 0;
  std::size_t set_ = 0;
  std::size_t item_ = 0;
  std::optional<Offence> worst_;  ///< of this pose
};

/// The first pose at which a constraint does not hold, of those that are known ahead. What is not
/// known ahead is `evaluate`'s: both must be asked before a start.
std::optional<Offence> first_offence(const World& world, const RobotModel& robot,
                                     std::span<const Pose2> track, const Terms& terms = {});

}  // namespace drover::scene
