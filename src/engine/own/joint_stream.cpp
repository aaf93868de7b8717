// The stream of joint commands: what it asks for now.
#include "engine/own/joint_stream.h"

#include <algorithm>
#include <cmath>

namespace drover::engine {
namespace {

constexpr StreamWords kJointWords{
    .refused = "joint command refused: ",
    .ended = "joint commands ended: ",
    .come = "joint commands come",
    .begins = "a stream of joint commands begins with velocity 0",
    .silent = "the stream of joint commands fell silent",
};

bool is_neutral(const JointVelocities& radps) {
  return std::all_of(radps.begin(), radps.end(), [](double v) { return v == 0; });
}

}  // namespace

JointStream::JointStream(Duration timeout) : Stream(timeout, kJointWords) {}

void JointStream::take(const JointTargets& targets, std::string_view busy, Time now) {
  JointVelocities wanted;
  for (const JointTarget& joint : targets.joints) {
    if (joint.axis >= kMaxAxes || !std::isfinite(joint.velocity_radps)) {
      return refuse("a joint or a velocity that cannot be", now);
    }
    wanted.resize(std::max(wanted.size(), std::size_t{joint.axis} + 1));
    wanted[joint.axis] = joint.velocity_radps;
  }
  if (follow(is_neutral(wanted), busy, now)) velocities_ = wanted;
}

bool JointStream::wants_motion() const {
  return !is_neutral(velocities_radps());
}

}  // namespace drover::engine
