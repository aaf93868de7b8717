// Keeps the robot where it is: what the drives were holding is held again when they let go.
#include "engine/own/hold.h"

#include <algorithm>
#include <cmath>

#include "engine/health/heard.h"
#include "engine/still.h"

namespace drover::engine {
namespace {

using std::chrono::milliseconds;

constexpr Duration kHoldsAgainFor = std::chrono::seconds(10);
/// A guard that has the bus is asked to hand it back first: under its zeros a rolling wheel would
/// stop with a jerk. Not for longer, the robot rolls.
constexpr Duration kGuardPatience = milliseconds(300);
/// A drive's report from before it heard of the request tells nothing of it.
constexpr Duration kReportDelay = milliseconds(50);
constexpr Duration kLongestAttempt = milliseconds(3000);
constexpr Duration kRetry = milliseconds(500);
/// A line says nothing until its contact has held for a while. Not waited for any longer.
constexpr Duration kLinesKnownAfter = milliseconds(500);
constexpr double kReleaseTilt_deg = 2.0;

}  // namespace

Hold::Hold(const EngineConfig& config)
    : config_(config),
      base_(kinematics_of(config.base)),
      driven_(joints_of(base_)),
      falls_radps2_(joint_radps(base_, config.limits.deceleration_mps2)) {}

void Hold::recall(const Remembered& remembered) {
  released_ = remembered.released;
  armed_ = recalled_ = lines_awaited_ = remembered.holding && !released_;
}

Reason Hold::hindrance() const {
  if (released_) return "the drives are released: drover hold";
  // Drives that are not heard have a reason of their own.
  if (state_ == HoldState::catching && heard_)
    return "the drives are being taken back to hold the robot";
  return {};
}

void Hold::release(const RequestId& id, const ReleaseHold& release, const Reason& hindrance,
                   double tilt_deg, Time now, EventQueue& events) {
  Reason why = hindrance;
  if (why.empty() && !release.on_slope) {
    if (!std::isfinite(tilt_deg)) {
      why = "the tilt is not known: with --on-slope a person answers for it";
    } else if (tilt_deg > kReleaseTilt_deg) {
      why.format("it would roll: the ground falls by %.1f degrees (--on-slope lets it go)",
                 tilt_deg);
    }
  }
  if (!why.empty()) return events.push(now, CommandRefused{id, why});
  released_ = true;
  gave_up_ = false;
  forfeit();
  events.push(now, CommandAccepted{id, "the drives let go: the robot can be pushed, and can roll"});
}

void Hold::arm(const RequestId& id, const Reason& hindrance, Time now, EventQueue& events) {
  if (!hindrance.empty()) return events.push(now, CommandRefused{id, hindrance});
  released_ = gave_up_ = recalled_ = false;
  armed_ = asked_ = true;
  last_held_ = now;
  events.push(now, CommandAccepted{id, "the drives are taken into closed loop at rest"});
}

bool Hold::heard(const HoldInput& input, const AxisSnapshot& axis) const {
  return axis.health == SourceState::fresh &&
         tells_motion(axis, input.now, from_s(config_.health.drive_stale_s));
}

bool Hold::estop(const HoldInput& input) {
  if (begun_ == kNever) begun_ = input.now;
  const bool pressed = input.health.holds(Cause::estop);
  const bool clear = !pressed && !input.health.holds(Cause::line_lost);
  lines_known_ = lines_known_ || pressed || clear || input.now - begun_ > kLinesKnownAfter;
  return pressed;
}

/// Whether the drives hold, since when they do not, and what ended the holding for good.
void Hold::keep_time(const HoldInput& input, EventQueue& events) {
  heard_ = true;
  for (std::size_t i = 0; i < input.axes.size(); ++i)
    heard_ = heard_ && (!driven_[i] || heard(input, input.axes[i]));
  if (input.driven && input.health.drives_running) {
    armed_ = true;  // a person started it, and that is the arming
    released_ = false;
  }
  if (estop(input) || input.power_cut || input.run_away || released_) forfeit();
  if (!armed_) return;
  if (input.health.drives_running) {
    last_held_ = input.now;
    asked_ = recalled_ = gave_up_ = false;
  } else if (recalled_) {
    // However long the restart took: the time runs from when the drives are there.
    last_held_ = input.now;
    recalled_ = !heard_;
  } else if (input.now - last_held_ > kHoldsAgainFor) {
    const bool tried = config_.base.hold_again || asked_;
    forfeit();
    if (!tried) return;
    gave_up_ = true;
    events.notice(input.now, Notice::Level::error,
                  "the drives let go and could not be held again: drover hold");
  }
}

bool Hold::others_hold(const HoldInput& input) const {
  for (std::size_t i = 0; i < input.axes.size(); ++i) {
    const bool runs = input.axes[i].state == AxisState::running && heard(input, input.axes[i]);
    if (driven_[i] && runs && !catches_[i].active) return true;
  }
  return false;
}

void Hold::begin(const HoldInput& input, const AxisSnapshot& axis, Catch& it) const {
  const bool waits = input.guard_has_bus && input.now - wanted_ < kGuardPatience;
  const bool off = axis.state == AxisState::idle || (axis.state == AxisState::fault && axis.lapsed);
  if (waits || !off || input.now < it.next || !heard(input, axis)) return;
  it.active = true;
  it.since = input.now;
  const double measured_radps = axis.motion.velocity_radps;
  // Where another wheel holds already the robot does not roll: this one joins it at rest.
  const bool rolls = !input.guard_has_bus && !others_hold(input);
  const bool turns = rim_mps(base_, std::abs(measured_radps)) > kTurns_mps;
  it.velocity_radps = rolls && turns ? measured_radps : 0.0;
}

/// Until the drive runs, the lowest speed that the wheel had; from then on a ramp. Never faster
/// than the wheel.
void Hold::follow(const HoldInput& input, const AxisSnapshot& axis, Catch& it) const {
  const bool runs = axis.state == AxisState::running;
  const bool refused = axis.state == AxisState::fault && input.now - it.since > kReportDelay;
  const bool late = !runs && input.now - it.since > kLongestAttempt;  // a ramp ends by itself
  if (refused || !heard(input, axis) || late) {
    it = {false, kNever, input.now + kRetry, 0};
    return;
  }
  const double measured_radps = axis.motion.velocity_radps;
  const double sign = it.velocity_radps < 0 ? -1.0 : 1.0;
  const double fall_radps = runs ? falls_radps2_ * std::max(to_s(input.dt), 0.0) : 0.0;
  const double ramp_radps = std::max(sign * it.velocity_radps - fall_radps, 0.0);
  const double most_radps = std::isfinite(measured_radps) ? sign * measured_radps : 0.0;
  it.velocity_radps =
      input.guard_has_bus ? 0.0 : sign * std::clamp(ramp_radps, 0.0, std::max(most_radps, 0.0));
  if (runs && it.velocity_radps == 0) it.active = false;
}

void Hold::take_back(const HoldInput& input, AxisId id) {
  const AxisSnapshot& axis = input.axes[id];
  Catch& it = catches_[id];
  if (it.active) {
    follow(input, axis, it);
  } else {
    begin(input, axis, it);
  }
  if (it.active) commands_[id] = {AxisRequest::hold, it.velocity_radps};
}

void Hold::step(const HoldInput& input, EventQueue& events) {
  keep_time(input, events);
  commands_ = {};
  const bool all_run = input.health.drives_running;
  const bool free = input.health.estop_known && !input.health.estop;
  const bool wanted = armed_ && !input.driven && free && (config_.base.hold_again || asked_);
  if (!wanted) catches_ = {};
  const bool catching =
      std::any_of(catches_.begin(), catches_.end(), [](const Catch& it) { return it.active; });
  if (wanted && (!all_run || catching)) {
    if (wanted_ == kNever) wanted_ = input.now;
    for (std::size_t i = 0; i < input.axes.size(); ++i)
      if (driven_[i]) take_back(input, static_cast<AxisId>(i));
  } else {
    wanted_ = kNever;
  }
  if (released_) {
    for (std::size_t i = 0; i < input.axes.size(); ++i)
      if (driven_[i]) commands_[i] = {AxisRequest::idle, 0};
  }
  state_ = released_                   ? HoldState::released
           : wanted_ != kNever && free ? HoldState::catching
           : all_run                   ? HoldState::held
           : gave_up_                  ? HoldState::lost
                                       : HoldState::idle;
}

}  // namespace drover::engine
