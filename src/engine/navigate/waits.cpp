// What a task waits for, and when that has lasted too long.
#include "engine/navigate/waits.h"

#include <algorithm>

namespace drover::engine {
namespace {

// Of two places: after a minute of a fix that was found again, and is lost now and then.
constexpr double kDecides_s = 90;
// However often what is waited for begins anew: so many times the time-out, and one decision.
constexpr double kWholeWait = 5;

}  // namespace

void Wait::update(bool bad, Time now, Duration after) {
  if (bad) {
    if (since_ == kNever) since_ = now;
    last_bad_ = now;
    resume_after_ = after;
  } else if (since_ != kNever && now - last_bad_ >= resume_after_) {
    since_ = kNever;
  }
}

void Waits::begin() {
  obstacle_ = constraint_ = place_ = unasked_ = {};
  outside_.clear();
}

void Waits::update(const NavInput& input, const OnTrack& on) {
  const Duration resume_after = from_s(config_.resume_after_s);
  const bool unseen = input.health.holds(Cause::surroundings);
  // Of what is seen ClearanceWatch says only after a while that it is away.
  const bool zone = input.health.near_zone && !input.health.in_the_way;
  obstacle_.update(input.health.near_zone || unseen, input.now,
                   zone || unseen ? resume_after : Duration{});
  constraint_.update(input.health.holds(Cause::constraint), input.now, Duration{});
  unasked_.update(!input.unasked.empty(), input.now, Duration{});
  outside_ = may_be_outside(on);
  place_.update(input.health.locate != LocateState::good || !outside_.empty(), input.now,
                resume_after);
}

const Reason& Waits::why(const HealthReport& health) const {
  if (health.holds(Cause::constraint)) return health.text(Cause::constraint);
  if (!outside_.empty()) return outside_;
  if (!obstacle_.holds()) return health.locate_reason;
  return health.text(health.near_zone ? Cause::near_zone : Cause::surroundings);
}

Reason Waits::too_long(const NavInput& input, const OnTrack& on) const {
  Reason why;
  if (unasked_.longer_than(unasked_limit_s_, input.now)) {
    why = input.unasked;
  } else if (obstacle_.longer_than(config_.obstacle_timeout_s, input.now)) {
    why.format("an obstacle blocked the way for %.0f s", config_.obstacle_timeout_s);
  } else if (constraint_.longer_than(config_.obstacle_timeout_s, input.now)) {
    const std::string_view which = input.health.text(Cause::constraint).view();
    why.format("for %.0f s: %.*s", config_.obstacle_timeout_s, static_cast<int>(which.size()),
               which.data());
  } else if (place_too_long(input, on)) {
    const std::string_view cause =
        (input.health.locate_reason.empty() ? outside_ : input.health.locate_reason).view();
    why.format("localisation was lost for %.0f s%s%.*s", to_s(input.now - place_.since()),
               cause.empty() ? "" : ": ", static_cast<int>(cause.size()), cause.data());
  }
  return why;
}

/// Without a fix one is waited for; then what it is worth; and of two places, once one is believed,
/// another fix: each has its own time, but not for ever. What is being decided is waited for, but
/// not twice as long.
bool Waits::place_too_long(const NavInput& input, const OnTrack& on) const {
  const double limit_s = config_.locate_timeout_s;
  if (!place_.holds()) return false;
  const Time since = std::max({place_.since(), input.estimate.found, input.estimate.renewed});
  const auto longer_than = [&](double s) { return input.now - since > from_s(s); };
  const bool wholly = place_.longer_than(kWholeWait * limit_s + kDecides_s, input.now);
  if (!longer_than(limit_s) && !wholly) return false;
  // It was just decided, and goes on soon.
  if (input.health.locate == LocateState::good && may_be_outside(on).empty()) return false;
  const Time decided = input.estimate.decided_at;
  const bool soon = decided != kNever && decided - since < from_s(kDecides_s + limit_s);
  return wholly || !soon || longer_than(kDecides_s + limit_s);
}

}  // namespace drover::engine
