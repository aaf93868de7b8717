// Whether the base comes to rest when it is told to, and stays there.
#include "engine/health/rest_watch.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "engine/base/words.h"
#include "engine/health/heard.h"
#include "engine/still.h"

namespace drover::engine {
namespace {

constexpr double kRestPatience_s = 0.3;  // drives lag
constexpr double kMotionHeld_s = 0.05;   // one odd value is no motion
// Where it would roll away once cut, what swings back when it stops has to be told from driving on.
constexpr double kMotionHeldOnSlope_s = 0.5;
// A drive that is being armed swings its wheel to and fro: that is no rolling.
constexpr double kRollHeld_s = 0.2;
constexpr double kBolts_mps = 0.5;  // over the limit, and over what the wheels explain
constexpr double kAlone_s = 1.0;    // a witness without another one
constexpr double kSilent_s = 1.0;   // where nothing else can tell
constexpr double kBegins_s = 2.5;   // a base that has its supply again, with a margin
constexpr double kConfirm_s = 1.0;
constexpr double kDirection_m = 0.1;
constexpr double kOnTheSpot = 0.25;  // what goes by less of its turn goes neither ahead nor back
constexpr Duration kLookAgain = std::chrono::seconds(5);
constexpr Duration kLookAgainAfterCut = std::chrono::seconds(2);

}  // namespace

RestWatch::RestWatch(const EngineConfig& config)
    : config_(config),
      base_(kinematics_of(config.base)),
      driven_(joints_of(base_)),
      witness_(config) {}

void RestWatch::expect_stop(Time now) {
  ours_ = true;
  if (state_ == RestState::resting || state_ == RestState::rolling) {
    state_ = RestState::settling;
    due_ = now;
  }
}

void RestWatch::reset() {
  if (state_ != RestState::not_stopping) return;
  state_ = RestState::settling;
  ours_ = keeps_on_ = false;  // what had no power begins anew
  quiet_since_ = moves_since_ = alone_since_ = kNever;
  reason_.clear();
}

RestWatch::Rims RestWatch::rims(const RestInput& input) const {
  Rims rims;
  Told told;
  told.joints.resize(input.axes.size());
  for (std::size_t i = 0; i < input.axes.size(); ++i) {
    if (!driven_[i]) continue;
    const AxisSnapshot& axis = input.axes[i];
    const double mps = rim_mps(base_, axis.motion.velocity_radps);
    const Duration stale = from_s(config_.health.drive_stale_s);
    if (!tells_motion(axis, input.now, stale) || !std::isfinite(mps)) {
      rims.silent = true;
      continue;
    }
    if (axis.state == AxisState::running) rims.driven = true;
    told.joints[i] = {axis.motion.velocity_radps, input.now};
    if (std::abs(mps) > std::abs(rims.fastest_mps)) rims.fastest_mps = mps;
  }
  set_direction(rims, told, input.now);
  return rims;
}

RestWatch::Rims RestWatch::asked(const RestInput& input) const {
  Rims asked;
  Told told;
  told.joints.resize(input.axes.size());
  for (std::size_t i = 0; i < input.axes.size(); ++i) {
    if (!driven_[i]) continue;
    told.joints[i] = {input.axes[i].commanded_velocity_radps, input.now};
    const double mps = rim_mps(base_, input.axes[i].commanded_velocity_radps);
    if (std::abs(mps) > std::abs(asked.fastest_mps)) asked.fastest_mps = mps;
  }
  set_direction(asked, told, input.now);
  return asked;
}

/// Of what joints tell or are told; the edges of a base that takes a twist stand for its own word.
BodyMotion RestWatch::motion_of(const Told& told, Time now) const {
  if (!takes_twist(base_)) return body_motion(base_, told, now, Duration::zero());
  BodyMotion body;
  JointVelocities mps;
  mps.resize(told.joints.size());
  body.known = true;
  for (std::size_t i = 0; i < told.joints.size(); ++i) {
    if (!driven_[i]) continue;
    body.known = body.known && told.joints[i].at == now;
    mps[i] = told.joints[i].velocity_radps;
  }
  body.twist = twist_of_edges(base_, mps);
  return body;
}

void RestWatch::set_direction(Rims& rims, const Told& told, Time now) const {
  const BodyMotion body = motion_of(told, now);
  if (!body.known) return;
  const double goes_mps = fastest_mps(base_, {body.twist.vx_mps, 0});
  const double turns_mps = fastest_mps(base_, {0, body.twist.wz_radps});
  if (goes_mps > kOnTheSpot * turns_mps) rims.ahead = std::copysign(1.0, body.twist.vx_mps);
  if (turns_mps > goes_mps) rims.turn = std::copysign(1.0, body.twist.wz_radps);
}

/// Whether the time that a ramp to zero needs is over.
bool RestWatch::due(const RestInput& input) {
  const Rims asked = this->asked(input);
  const double asked_mps = asked.fastest_mps;
  if (asked_mps != 0 && !input.caught) {
    ours_ = true;
    const bool told = asked.ahead != 0 || asked.turn != 0;  // the end of a ramp counts as standing
    direction_ = told ? asked.ahead : direction_;
    turn_ = told ? asked.turn : turn_;
  }
  const double slower_mps =
      expected_mps_ - config_.limits.deceleration_mps2 * std::max(to_s(input.dt), 0.0);
  expected_mps_ = std::max(std::abs(asked_mps), slower_mps);
  if (expected_mps_ > 0) {
    due_ = kNever;
    return false;
  }
  if (due_ == kNever) {
    due_ = input.now;
    witness_.expect_rest(input.now, turn_);
    quiet_since_ = moves_since_ = alone_since_ = kNever;
  }
  return true;
}

/// There is power to take, and what moves the base may be a command of ours.
bool RestWatch::is_driven_by_us(const RestInput& input) const {
  return ours_ && !input.power_is_off && !input.released;
}

/// Whether taking the power helps: from what we drive, not from what would only roll faster.
bool RestWatch::may_be_cut(const RestInput& input, const Rims& rims) const {
  if (!is_driven_by_us(input)) return false;
  if (!may_roll_) return true;
  // Drives that do not run drive nothing: it rolls, and they are to catch it.
  return rims.driven && input.now - moves_since_ >= from_s(kMotionHeldOnSlope_s) &&
         moves_as_commanded(input, rims);
}

/// Driven on, rather than rolling down where it stands. Only what shows it counts.
bool RestWatch::moves_as_commanded(const RestInput& input, const Rims& rims) const {
  if (std::abs(rims.fastest_mps) > kTurns_mps)
    return rims.fastest_mps * direction_ > 0 || rims.turn * turn_ > 0;
  if (witness_.spins_on(input.now)) return true;
  if (!std::isfinite(input.yaw_rad)) return false;
  const PathPoint way = witness_.way(input.now);
  const double ahead_m = way.x_m * std::cos(input.yaw_rad) + way.y_m * std::sin(input.yaw_rad);
  return ahead_m * direction_ > kDirection_m;
}

/// Before any rest is due. Not where it would only roll without power, and may slide down.
bool RestWatch::bolts(const RestInput& input, const Rims& rims) const {
  if (!is_driven_by_us(input) || may_roll_ || !rims.driven) return false;
  const double explained_mps =
      std::max({config_.limits.max_speed_mps, expected_mps_, std::abs(rims.fastest_mps)});
  return witness_.proven_speed_mps(input.now) > explained_mps + kBolts_mps;
}

/// A silent base that keeps its last command, and was not at rest or is seen to move: witnesses see
/// no slow motion, and some robots have none. On a slope it may as well have lost its supply, and
/// be caught when it has it again: it is given the time to begin.
bool RestWatch::cannot_be_stopped(const RestInput& input) const {
  if (!unheard_ || !is_driven_by_us(input)) return false;
  const Duration patience = from_s(on_slope_ ? kBegins_s : kSilent_s);
  const bool seen = moves_since_ != kNever && input.now - moves_since_ >= patience;
  return (keeps_on_ || seen) && input.now - due_ >= patience;
}

void RestWatch::watch_silence(const RestInput& input, const Rims& rims) {
  const bool stop_asked = std::exchange(stop_asked_, false);
  const bool was_unheard = std::exchange(unheard_, input.drives_on_in_silence && rims.silent);
  heard_ = heard_ || !rims.silent;
  // A relay that this program has closed feeds a base that has forgotten everything.
  if (unheard_ && (heard_ || input.found_powered)) ours_ = true;
  if (stop_asked && (rims.driven || unheard_)) expect_stop(input.now);
  if (stop_asked && unheard_) keeps_on_ = true;
  if (unheard_) return;
  keeps_on_ = expected_mps_ > 0 || std::abs(rims.fastest_mps) > kTurns_mps;
  if (!was_unheard) return;
  // It is heard again, and has the time for a ramp from what it has.
  expected_mps_ = std::max(expected_mps_, std::abs(rims.fastest_mps));
  moves_since_ = kNever;
}

void RestWatch::watch_wheels(const Rims& rims, Time now) {
  turning_ = std::abs(rims.fastest_mps) > kTurns_mps;
  const bool swings = turning_ && rims.fastest_mps * rim_mps_ < 0;
  if (!turning_ || swings) turns_since_ = kNever;
  if (turning_ && turns_since_ == kNever) turns_since_ = now;
  rim_mps_ = rims.fastest_mps;
}

bool RestWatch::rolls(Time now) const {
  return turning_ && now - turns_since_ >= from_s(kRollHeld_s);
}

Reason RestWatch::turns_by_itself() const {
  Reason why;
  if (turning_ && !ours_) {
    why.format("the robot rolls without a command: %s %.2f m/s", words_of(base_).turn_by, rim_mps_);
  }
  return why;
}

bool RestWatch::others_say_so(const Testimony& said, Time now) {
  const bool alone = said.moving == 1 && said.heard == 1;
  if (!alone) {
    alone_since_ = kNever;
  } else if (alone_since_ == kNever) {
    alone_since_ = now;
  }
  return said.moving >= 2 || (alone && now - alone_since_ >= from_s(kAlone_s));
}

void RestWatch::tell(const char* what, const Rims& rims, const Testimony& said) {
  const std::string_view others = said.in_words;
  const auto size = static_cast<int>(others.size());
  if (std::abs(rims.fastest_mps) > kTurns_mps) {
    reason_.format("%s: %s %.2f m/s%s%.*s", what, words_of(base_).turn_by, rims.fastest_mps,
                   others.empty() ? "" : ", ", size, others.data());
  } else {
    const BaseWords& words = words_of(base_);
    const char* quiet = rims.silent ? words.are_silent : words.tell_rest;
    reason_.format("%s: %s%s%.*s", what, quiet, others.empty() ? "" : ", but ", size,
                   others.data());
  }
}

void RestWatch::settle(const RestInput& input, const Rims& rims, const Testimony& said) {
  state_ = RestState::settling;
  const bool others = others_say_so(said, input.now);
  const bool moves = others || turning_;
  if (!moves) moves_since_ = kNever;
  if (moves && moves_since_ == kNever) moves_since_ = input.now;
  const bool late = input.now - due_ >= from_s(kRestPatience_s) &&
                    input.now - moves_since_ >= from_s(kMotionHeld_s);
  const bool did_not_stop = moves && late && may_be_cut(input, rims);
  if (did_not_stop || cannot_be_stopped(input)) {
    state_ = RestState::not_stopping;
    tell(did_not_stop ? "the robot did not stop" : "the robot cannot be stopped", rims, said);
    return;
  }
  // What nobody drove has no ramp to come to its end: what a guard slows down is told as well.
  if (ours_ ? moves && late : others || rolls(input.now)) {
    tell("the robot moves without a command", rims, said);
  } else if (!moves) {
    reason_.clear();
  }
  const bool quiet = !turning_ && !rims.silent && said.moving == 0;
  if (!quiet) quiet_since_ = kNever;
  if (quiet && quiet_since_ == kNever) quiet_since_ = input.now;
  if (quiet && input.now - quiet_since_ >= from_s(kConfirm_s)) {
    state_ = RestState::resting;
    ours_ = false;
  }
}

void RestWatch::stay(const RestInput& input, const Rims& rims, const Testimony& said) {
  if (others_say_so(said, input.now) || rolls(input.now)) {
    state_ = turning_ ? RestState::rolling : RestState::carried;
    tell(turning_ ? "the robot rolls without a command" : "the robot is pushed or carried", rims,
         said);
    moves_since_ = input.now;
    quiet_since_ = kNever;
    return;
  }
  if (turning_) quiet_since_ = kNever;
  if (quiet_since_ == kNever) quiet_since_ = input.now;
  if (state_ != RestState::resting && input.now - quiet_since_ < from_s(kConfirm_s)) return;
  state_ = RestState::resting;
  reason_.clear();
  // A receiver's position wanders over the hours.
  if (input.now - due_ > kLookAgain) {
    due_ = input.now;
    witness_.expect_rest(input.now, turn_);
  }
}

RestState RestWatch::update(const RestInput& input) {
  if (input.released) ours_ = false;  // who lets go of the drives is going to push
  const Rims rims = this->rims(input);
  watch_silence(input, rims);
  watch_wheels(rims, input.now);
  const bool is_due = due(input);
  // What began to roll on a slope still rolls where the ground is level again.
  const bool goes_on = is_due && state_ != RestState::resting;
  on_slope_ = input.rolls_unpowered || (on_slope_ && goes_on);
  may_roll_ = on_slope_ || input.caught || (may_roll_ && goes_on);
  if (state_ == RestState::not_stopping) {
    // What it rolled until it came to rest is no motion any more.
    if (due_ == kNever || input.now - due_ > kLookAgainAfterCut) {
      due_ = input.now;
      witness_.expect_rest(input.now, turn_);
    }
    return state_;
  }
  if (bolts(input, rims)) {
    state_ = RestState::not_stopping;
    tell("the robot runs away", rims, witness_.hear(input.now));
  } else if (!is_due) {
    state_ = RestState::driving;
    reason_.clear();
  } else {
    const Testimony said = witness_.hear(input.now);
    const bool rested = state_ == RestState::resting || state_ == RestState::carried ||
                        state_ == RestState::rolling;
    if (rested) {
      stay(input, rims, said);
    } else {
      settle(input, rims, said);
    }
  }
  witness_.set_at_rest(state_ == RestState::resting);
  return state_;
}

}  // namespace drover::engine
