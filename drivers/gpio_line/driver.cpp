// Debouncing of a digital input: quick to stop, slow to release.
#include "drivers/gpio_line/driver.h"

#include <algorithm>

namespace drover::gpio_line {
namespace {

/// Nobody has seen it active: it only has to be no bounce. A robot that rolls waits for it.
constexpr Duration kFirstHold = std::chrono::milliseconds(50);

}  // namespace

void GpioLineDriver::report(bool active, Time at, DriverOut& out) {
  if (reported_ && active == active_) return;
  reported_ = true;
  active_ = active;
  Measurement m;
  m.time = at;
  m.received = at;
  m.value = LineState{settings_.line, active};
  out.report(m);
}

void GpioLineDriver::on_level(bool high, Time at, DriverOut& out) {
  // An edge carries the kernel's stamp and may be read after a later poll: never go backwards.
  at = std::max(at, last_reading_);
  const bool reading_active = high == settings_.active_high;
  const bool gap = lost_ || at - last_reading_ > settings_.stale_after;
  if (gap || reading_active != level_active_) {
    level_active_ = reading_active;
    level_since_ = at;
  }
  lost_ = false;
  last_reading_ = at;
  ++readings_;
  const Duration release =
      ever_settled_ ? settings_.release_debounce : std::min(settings_.release_debounce, kFirstHold);
  const Duration needed = reading_active ? settings_.active_debounce : release;
  if (at - level_since_ >= needed) {
    settled_ = ever_settled_ = true;
    report(reading_active, at, out);
  } else if (!reported_) {
    report(true, at, out);
  }
}

void GpioLineDriver::on_lost(Time at, DriverOut& out) {
  if (!lost_) ++losses_;
  lost_ = true;
  settled_ = false;
  report(true, at, out);
}

void GpioLineDriver::on_tick(Time now, DriverOut& out) {
  if (last_reading_ != kNever && !lost_ && now - last_reading_ <= settings_.stale_after) return;
  settled_ = false;
  report(true, now, out);
}

SourceHealth GpioLineDriver::health(Time now) const {
  SourceHealth health;
  health.last_good = last_reading_;
  health.good = readings_;
  health.bad = losses_;
  if (lost_) {
    health.state = SourceState::stale;
    health.reason = "the line cannot be read";
  } else if (last_reading_ == kNever) {
    health.reason = "the line was never read";
  } else if (now - last_reading_ > settings_.stale_after) {
    health.state = SourceState::stale;
    health.reason.format("the line was not read for %.3f s", to_s(now - last_reading_));
  } else if (!settled_) {
    health.state = SourceState::stale;
    health.reason = "not known yet, its contact has to hold for a moment";
  } else {
    health.state = SourceState::fresh;
  }
  if (!ever_settled_) health.state = SourceState::never_heard;
  return health;
}

}  // namespace drover::gpio_line
