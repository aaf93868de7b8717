// The stream of joint commands: when it may begin, what it asks for now, when it has ended.
#include "engine/own/joint_stream.h"

#include <algorithm>
#include <cmath>

namespace drover::engine {
namespace {

using namespace std::chrono_literals;

// A stream of 200 refused messages a second is one line in the journal.
constexpr Duration kSameAgain = 1s;
// So long after a message it is told why that was refused.
constexpr Duration kToldOn = 1s;
constexpr Duration kBetweenNews = 200ms;
constexpr Duration kRestFirst = 300ms;

Reason text_of(const char* what, std::string_view why) {
  Reason text;
  text.format("%s%.*s", what, static_cast<int>(why.size()), why.data());
  return text;
}

}  // namespace

/// Not shorter than the time between two messages of a stream that is just fast enough to live.
bool JointStream::rested(Time now) const {
  return zeros_since_ != kNever && now - last_zero_ <= timeout_ &&
         now - zeros_since_ >= std::max(kRestFirst, timeout_);
}

void JointStream::watch_zeros(bool neutral, Time now) {
  if (!neutral) {
    zeros_since_ = kNever;
    return;
  }
  const bool goes_on = zeros_since_ != kNever && now - last_zero_ <= timeout_;
  if (!goes_on) zeros_since_ = now;
  last_zero_ = now;
}

/// Somebody who writes that seldom means one stream, and finds it ended at each message.
void JointStream::watch_rate(Time now) {
  const Duration gap = heard_ == kNever ? Duration{} : now - heard_;
  heard_ = now;
  if (gap <= timeout_ || gap > kToldOn) return;
  gap_ = gap;
  gap_at_ = now;
}

Reason JointStream::not_begun(Time now) const {
  const double rest_s = to_s(std::max(kRestFirst, timeout_));
  Reason why;
  if (gap_at_ != kNever && to_s(now - gap_at_) <= rest_s) {
    why.format(
        "joint commands come %.0f ms apart, %.0f ms are allowed; a stream begins with velocity 0 "
        "for %.1f s",
        1e3 * to_s(gap_), 1e3 * to_s(timeout_), rest_s);
  } else {
    why.format("a stream of joint commands begins with velocity 0, and nothing else for %.1f s",
               rest_s);
  }
  return why;
}

void JointStream::take(const JointTargets& targets, std::string_view busy, Time now) {
  JointVelocities wanted;
  for (const JointTarget& joint : targets.joints) {
    if (joint.axis >= kMaxAxes || !std::isfinite(joint.velocity_radps)) {
      return reject("a joint or a velocity that cannot be", now);
    }
    wanted.resize(std::max(wanted.size(), std::size_t{joint.axis} + 1));
    wanted[joint.axis] = joint.velocity_radps;
  }
  const bool neutral = std::all_of(wanted.begin(), wanted.end(), [](double v) { return v == 0; });
  const bool from_rest = rested(now);
  watch_rate(now);
  watch_zeros(neutral, now);
  if (!busy.empty()) {
    if (following_) end(busy);
    if (!neutral) return reject(busy, now);
    last_ = now;
    return;
  }
  if (!neutral && !may_move_ && !(following_ && from_rest)) {
    return reject(not_begun(now), now);
  }
  may_move_ = may_move_ || !neutral;
  if (!following_) since_ = now;
  following_ = true;
  last_ = now;
  velocities_ = wanted;
  ++accepted_;
  reason_.clear();
  obstacle_.clear();
  refused_at_ = kNever;
}

void JointStream::refuse(const Reason& why) {
  ++refused_;
  reason_ = why;
}

void JointStream::reject(const Reason& why, Time now) {
  refuse(why);
  refused_at_ = now;
  news_ = text_of("joint command refused: ", why);
}

void JointStream::announce(Time now, EventQueue& events) {
  if (news_.empty() || now - told_at_ < kBetweenNews) return;
  const bool same = news_ == told_ && now < same_until_;
  same_until_ = now + kSameAgain;
  if (!same) {
    events.notice(now, Notice::Level::warning, news_);
    told_ = news_;
    told_at_ = now;
  }
  news_.clear();
}

void JointStream::end(std::string_view why) {
  if (!following_) return;
  following_ = may_move_ = false;
  zeros_since_ = kNever;
  velocities_.clear();
  reason_ = why;
  news_ = text_of("joint commands ended: ", why);
}

void JointStream::meet(const Reason& obstacle) {
  if (!following_) return;
  end(obstacle);
  obstacle_ = obstacle;
  refused_at_ = last_;
}

void JointStream::step(Time now) {
  if (following_ && now - last_ > timeout_) end("the stream of joint commands fell silent");
}

bool JointStream::wants_motion() const {
  return std::any_of(velocities_.begin(), velocities_.end(), [](double v) { return v != 0; });
}

bool JointStream::refuses(Time now) const {
  return !following_ && refused_at_ != kNever && now - refused_at_ <= kToldOn;
}

}  // namespace drover::engine
