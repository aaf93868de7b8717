#include "scene/constraint/at_start.h"

#include <utility>

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

TrackJudge::TrackJudge(const World& world, const RobotModel& robot, std::vector<Pose2> track,
                       const Terms& terms)
    : world_(world), robot_(robot), track_(std::move(track)), terms_(terms) {}

bool TrackJudge::advance(const TimeLeft& time_left) {
  const auto& sets = world_.constraints();
  while (pose_ < track_.size()) {
    if (set_ < sets.size()) {
      judge_next();
      if (!time_left()) return false;
      continue;
    }
    if (worst_) return true;
    ++pose_;
    set_ = 0;
    if (sets.empty()) return true;
  }
  return true;
}

void TrackJudge::judge_next() {
  const ConstraintSet& set = world_.constraints()[set_];
  if (item_ >= count_of(set.message)) {
    ++set_;
    item_ = 0;
    return;
  }
  RobotState state;
  state.base = track_[pose_];
  judge_one(set.message, item_++, setting_of(set, world_, robot_, state, terms_, Moment::ahead),
            false, [this](Verdict verdict) { keep_worst(std::move(verdict)); });
}

void TrackJudge::keep_worst(Verdict verdict) {
  if (verdict.holds) return;
  if (worst_ && worst_->verdict.weight * worst_->verdict.error >= verdict.weight * verdict.error)
    return;
  worst_ = Offence{pose_, std::move(verdict)};
}

std::optional<Offence> first_offence(const World& world, const RobotModel& robot,
                                     std::span<const Pose2> track, const Terms& terms) {
  TrackJudge judge(world, robot, {track.begin(), track.end()}, terms);
  while (!judge.advance([] { return true; })) {
  }
  return judge.offence();
}

}  // namespace drover::scene
