// Which drives are armed, held, let go or left as they are: decided here, and nowhere else.
#include "engine/own/arming.h"

#include <cmath>

namespace drover::engine {
namespace {

constexpr Duration kHoldsAgainFor = std::chrono::seconds(10);
/// A line says nothing until its contact has held for a while. Not waited for any longer.
constexpr Duration kLinesKnownAfter = std::chrono::milliseconds(500);
constexpr double kReleaseTilt_deg = 2.0;

}  // namespace

Arming::Arming(const EngineConfig& config)
    : config_(config), driven_(joints_of(kinematics_of(config.base))), take_back_(config) {}

void Arming::recall(const Remembered& remembered) {
  released_ = remembered.released;
  armed_ = recalled_ = lines_awaited_ = remembered.holding && !released_;
}

Reason Arming::hindrance() const {
  if (released_) return "the drives are released: drover hold";
  // Drives that are not heard have a reason of their own.
  if (state_ == HoldState::catching && heard_) {
    return failed_ ? "a drive has failed: for 10 s it is waited whether it can hold again"
                   : "the drives are being taken back to hold the robot";
  }
  return {};
}

void Arming::release(const RequestId& id, const ReleaseHold& release, const Reason& hindrance,
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
  // What a chassis that takes a twist does then is its own.
  Reason note = takes_twist(config_.base.kind)
                    ? "nothing is commanded any more, and it can roll; a chassis that does not let "
                      "go is pushed switched off"
                    : "the drives let go: the robot can be pushed, and can roll";
  // An arm that falls is a danger to who pushes, and one that moves, too.
  if (joints_of_groups(config_) > 0)
    note.append("; its other joints follow nobody, what runs is held");
  events.push(now, CommandAccepted{id, note});
}

void Arming::arm(const RequestId& id, const Reason& hindrance, Time now, EventQueue& events) {
  if (!hindrance.empty()) return events.push(now, CommandRefused{id, hindrance});
  released_ = gave_up_ = recalled_ = false;
  armed_ = asked_ = true;
  last_held_ = now;
  events.push(now, CommandAccepted{id, "the drives are taken into closed loop at rest"});
}

bool Arming::estop(const ArmingInput& input) {
  if (begun_ == kNever) begun_ = input.now;
  const bool pressed = input.health.holds(Cause::estop);
  const bool clear = !pressed && !input.health.holds(Cause::line_lost);
  lines_known_ = lines_known_ || pressed || clear || input.now - begun_ > kLinesKnownAfter;
  return pressed;
}

/// Whether the drives hold, since when they do not, and what ended the holding for good.
void Arming::keep_time(const ArmingInput& input, EventQueue& events) {
  heard_ = true;
  failed_ = false;
  for (std::size_t i = 0; i < input.axes.size(); ++i) {
    if (!driven_[i]) continue;
    heard_ = heard_ && take_back_.heard(input.now, input.axes[i]);
    failed_ = failed_ || take_back_.failed(input.axes[i]);
  }
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

/// Drives that are to hold and do not, or not yet at rest.
void Arming::take_back(const ArmingInput& input, bool wanted) {
  if (!wanted) take_back_.end();
  if (!wanted || (input.health.drives_running && !take_back_.active())) {
    wanted_ = kNever;
    return;
  }
  if (wanted_ == kNever) wanted_ = input.now;
  take_back_.step({input.now, input.dt, input.axes, input.guard_has_bus, wanted_});
}

AxisCommand Arming::decide(const ArmingInput& input, AxisId id) const {
  const bool of_base = driven_[id];
  if (of_base && input.power_cut) return {AxisRequest::idle, 0};
  if (input.driven && (of_base || input.joints)) return {AxisRequest::run, 0};
  if (of_base && released_) return {AxisRequest::idle, 0};
  return take_back_.command(id);
}

void Arming::step(const ArmingInput& input, EventQueue& events) {
  has_owner_ = input.driven;
  keep_time(input, events);
  const bool free = input.health.estop_known && !input.health.estop;
  take_back(input, armed_ && !input.driven && free && (config_.base.hold_again || asked_));
  for (std::size_t i = 0; i < input.axes.size(); ++i)
    commands_[i] = decide(input, static_cast<AxisId>(i));
  for (std::size_t i = 0; i < input.axes.size(); ++i)
    commands_[i].held = driven_[i] && armed_ && !input.power_cut;
  state_ = released_                     ? HoldState::released
           : wanted_ != kNever && free   ? HoldState::catching
           : input.health.drives_running ? HoldState::held
           : gave_up_                    ? HoldState::lost
                                         : HoldState::idle;
}

}  // namespace drover::engine
