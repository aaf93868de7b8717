#include "scene/constraint/at_start.h"

#include "scene/constraint/kinds.h"
#include "scene/message/frames.h"

namespace drover::scene {

Ahead known_ahead(const JointConstraint& joint) {
  return is_of_base(joint) ? Ahead::all : Ahead::nothing;
}

Ahead known_ahead(const PositionConstraint& /*position*/) {
  return Ahead::all;
}

Ahead known_ahead(const OrientationConstraint& orientation) {
  return is_global_frame(orientation.header.frame_id) ? Ahead::yaw_only : Ahead::all;
}

Ahead known_ahead(const VisibilityConstraint& /*visibility*/) {
  return Ahead::all;
}

std::optional<Offence> first_offence(const World& world, const RobotModel& robot,
                                     std::span<const Pose2> track, const Terms& terms) {
  for (std::size_t i = 0; i < track.size(); ++i) {
    RobotState state;
    state.base = track[i];
    std::optional<Offence> worst;
    const auto keep_worst = [&](Verdict verdict) {
      if (verdict.holds) return;
      if (worst && worst->verdict.weight * worst->verdict.error >= verdict.weight * verdict.error)
        return;
      worst = Offence{i, std::move(verdict)};
    };
    for (const ConstraintSet& set : world.constraints())
      judge(set.message, setting_of(set, world, robot, state, terms, Moment::ahead), false,
            keep_worst);
    if (worst) return worst;
  }
  return std::nullopt;
}

}  // namespace drover::scene
