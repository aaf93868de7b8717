// What of the constraints can be said of a track before it is driven.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>

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

/// The first pose at which a constraint does not hold, of those that are known ahead. What is not
/// known ahead is `evaluate`'s: both must be asked before a start.
std::optional<Offence> first_offence(const World& world, const RobotModel& robot,
                                     std::span<const Pose2> track, const Terms& terms = {});

}  // namespace drover::scene
