// The stream of twists that a program drives the base by: what it asks for now.
#include "engine/own/twist_stream.h"

#include <algorithm>
#include <cmath>

namespace drover::engine {
namespace {

constexpr StreamWords kTwistStreamWords{
    .refused = "cmd_vel refused: ",
    .ended = "cmd_vel ended: ",
    .come = "messages come",
    .begins = "cmd_vel begins with a zero twist",
    .silent = "cmd_vel fell silent",
};

}  // namespace

TwistStream::TwistStream() : Stream(kTimeout, kTwistStreamWords) {}

void TwistStream::take(const FollowTwist& wanted, Time received, std::string_view busy, Time now) {
  const Twist& twist = wanted.twist;
  if (!std::isfinite(twist.vx_mps + twist.wz_radps + twist.vy_mps))
    return refuse("a speed that cannot be", now);
  const Time at = received == kNever ? now : std::min(received, now);
  if (now - at > kTimeout) return refuse("it came too late to be followed", now);
  newest_ = std::max(newest_, at);  // none is heard before the one that came before it
  const bool neutral = is_zero(twist) && !wanted.after_motion;
  if (follow(neutral, busy, newest_)) wanted_ = twist;
}

}  // namespace drover::engine
