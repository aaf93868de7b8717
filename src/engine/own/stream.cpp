// A stream of messages that a program drives by: when it may begin, and when it has ended.
#include "engine/own/stream.h"

#include <algorithm>

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
bool Stream::rested(Time now) const {
  return zeros_since_ != kNever && now - last_zero_ <= timeout_ &&
         now - zeros_since_ >= std::max(kRestFirst, timeout_);
}

void Stream::watch_zeros(bool neutral, Time now) {
  if (!neutral) {
    zeros_since_ = kNever;
    return;
  }
  const bool goes_on = zeros_since_ != kNever && now - last_zero_ <= timeout_;
  if (!goes_on) zeros_since_ = now;
  last_zero_ = now;
}

/// Somebody who writes that seldom means one stream, and finds it ended at each message. Behind a
/// row that was long enough to begin with, a silence is no pace: who comes then may be another.
void Stream::watch_rate(Time now) {
  const bool begins = heard_ == kNever || now - heard_ > timeout_;
  if (begins && heard_ != kNever && now - heard_ <= kToldOn &&
      heard_ - row_since_ < std::max(kRestFirst, timeout_)) {
    gap_ = now - heard_;
    gap_at_ = now;
  }
  if (begins) row_since_ = now;
  heard_ = now;
}

Reason Stream::not_begun(Time now) const {
  const double rest_s = to_s(std::max(kRestFirst, timeout_));
  Reason why;
  if (gap_at_ != kNever && to_s(now - gap_at_) <= rest_s) {
    why.format("%s %.0f ms apart, %.0f ms are allowed; %s for %.1f s", words_.come,
               1e3 * to_s(gap_), 1e3 * to_s(timeout_), words_.begins, rest_s);
  } else {
    why.format("%s, and nothing else for %.1f s", words_.begins, rest_s);
  }
  return why;
}

bool Stream::follow(bool neutral, std::string_view busy, Time now) {
  const bool from_rest = rested(now);
  watch_rate(now);
  watch_zeros(neutral, now);
  if (!busy.empty()) {
    if (following_) end(busy);
    if (neutral)
      last_ = now;
    else
      refuse(busy, now);
    return false;
  }
  if (!neutral && !may_move_ && !(following_ && from_rest)) {
    refuse(not_begun(now), now);
    return false;
  }
  may_move_ = may_move_ || !neutral;
  if (!following_) since_ = now;
  following_ = true;
  last_ = now;
  ++accepted_;
  reason_.clear();
  obstacle_.clear();
  refused_at_ = kNever;
  return true;
}

void Stream::refuse_quietly(const Reason& why) {
  ++refused_;
  reason_ = why;
  zeros_since_ = kNever;  // it was no zero
}

void Stream::refuse(const Reason& why, Time now) {
  refuse_quietly(why);
  refused_at_ = now;
  news_ = text_of(words_.refused, why);
}

void Stream::announce(Time now, EventQueue& events) {
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

void Stream::end(std::string_view why) {
  if (!following_) return;
  following_ = may_move_ = false;
  zeros_since_ = kNever;
  reason_ = why;
  news_ = text_of(words_.ended, why);
}

void Stream::meet(const Reason& obstacle) {
  if (!following_) return;
  end(obstacle);
  obstacle_ = obstacle;
  refused_at_ = last_;
}

void Stream::step(Time now) {
  if (following_ && now - last_ > timeout_) end(words_.silent);
}

bool Stream::refuses(Time now) const {
  return !following_ && refused_at_ != kNever && now - refused_at_ <= kToldOn;
}

}  // namespace drover::engine
