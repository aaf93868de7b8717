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
constexpr Duration kCaughtUntil = std::chrono::seconds(10);  // as long as drives are taken back
constexpr double kFaster_mps = 0.3;
constexpr double kSlower_mps = 0.05;
constexpr double kSteady_s = 1.0;
constexpr double kRolled_m = 0.3;
constexpr double kConfirm_s = 1.0;
constexpr double kCreeps_m = 0.1;
// Of the speed that it had: what is slower has braked.
constexpr double kHasBraked = 0.5;
constexpr double kDirection_m = 0.1;
constexpr Duration kLookAgain = std::chrono::seconds(5);
constexpr Duration kLookAgainAfterCut = std::chrono::seconds(2);

}  // namespace

RestWatch::RestWatch(const EngineConfig& config)
    : config_(config), rims_(config), witness_(config) {}

void RestWatch::expect_stop(Time now) {
  ours_ = true;
  const bool rested =
      state_ == RestState::resting || state_ == RestState::carried || state_ == RestState::rolling;
  if (!rested) return;
  state_ = RestState::settling;
  due_ = now;
  moves_since_ = alone_since_ = kNever;
}

void RestWatch::reset() {
  if (state_ != RestState::not_stopping) return;
  state_ = RestState::settling;
  ours_ = false;  // what had no power begins anew
  silence_.reset();
  quiet_since_ = moves_since_ = alone_since_ = kNever;
  reason_.clear();
}

/// Whether the time that a ramp to zero needs is over.
bool RestWatch::due(const RestInput& input) {
  const RimMotion asked = rims_.asked(input.axes, input.now);
  const double asked_mps = asked.fastest_mps;
  if (asked_mps != 0 && !input.caught) {
    ours_ = true;
    const bool told = asked.ahead != 0 || asked.turn != 0;  // the end of a ramp counts as standing
    direction_ = told ? asked.ahead : direction_;
    turn_ = told ? asked.turn : turn_;
    if (state_ != RestState::driving && state_ != RestState::settling) drove_mps_ = 0;
    drove_mps_ = std::max(drove_mps_, std::abs(asked_mps));
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
    creeps_since_ = ours_ ? input.now : kNever;
    crept_m_ = 0;
  }
  return true;
}

/// There is power to take, and what moves the base may be a command of ours.
bool RestWatch::is_driven_by_us(const RestInput& input) const {
  return ours_ && !input.power_is_off && !input.released;
}

/// Whether taking the power helps: from what we drive, not from what would only roll faster.
bool RestWatch::may_be_cut(const RestInput& input, const RimMotion& rims) const {
  if (!is_driven_by_us(input)) return false;
  if (!may_roll_) return true;
  // Caught on level ground it gets slower: what does not is driven, by another program say.
  if (!on_slope_) return input.now - std::max(moves_since_, steady_since_) >= from_s(kSteady_s);
  // Drives that do not run drive nothing: it rolls, and they are to catch it.
  const Time since = std::max(moves_since_, drives_on_since_);
  return rims.driven && input.now - since >= from_s(kMotionHeldOnSlope_s) &&
         moves_as_commanded(input, rims);
}

/// Driven on, rather than rolling down where it stands. Only what shows it counts.
bool RestWatch::moves_as_commanded(const RestInput& input, const RimMotion& rims) const {
  const bool turns = std::abs(rims.fastest_mps) > kTurns_mps;
  if (!turns && witness_.spins_on(input.now)) return true;
  // Frozen encoders may tell the last speed for ever.
  const double half_mps = kHasBraked * std::abs(rims.fastest_mps);
  const bool goes = rims.ahead != 0 || !turns;
  if (goes && (witness_.stands(input.now) || witness_.is_slower(half_mps, input.now))) return false;
  if (turns) {
    if (input.stop_creeps && std::abs(rims.fastest_mps) < kHasBraked * drove_mps_) return false;
    return rims.fastest_mps * direction_ > 0 || rims.turn * turn_ > 0;
  }
  return std::isfinite(input.yaw_rad) && ahead_m(input) * direction_ > kDirection_m;
}

/// By the receiver, since rest is due.
double RestWatch::ahead_m(const RestInput& input) const {
  const PathPoint way = witness_.way(input.now);
  return way.x_m * std::cos(input.yaw_rad) + way.y_m * std::sin(input.yaw_rad);
}

/// Before any rest is due. Not where it would only roll without power, and may slide down.
bool RestWatch::bolts(const RestInput& input, const RimMotion& rims) const {
  if (!is_driven_by_us(input) || may_roll_ || !rims.driven) return false;
  const double explained_mps =
      std::max({config_.limits.max_speed_mps, expected_mps_, std::abs(rims.fastest_mps)});
  return witness_.proven_speed_mps(input.now) > explained_mps + kBolts_mps;
}

/// Too slow for anything else that watches: a base that no longer hears, near its goal. Where it is
/// level, and only on from the last command: who pushes it later must not find it latched.
bool RestWatch::creeps_on(const RestInput& input, const RimMotion& rims) {
  if (creeps_since_ == kNever) return false;
  const double since_s = to_s(input.now - creeps_since_) - kRestPatience_s;
  if (since_s < 0) return false;
  crept_m_ += rims.fastest_mps * std::max(to_s(input.dt), 0.0);
  const bool stood = since_s > kConfirm_s && std::abs(crept_m_) < kStands_mps * since_s;
  const bool held = rims.driven && !rims.silent && !input.power_is_off && !input.released;
  if (stood || !held || may_roll_) creeps_since_ = kNever;
  return creeps_since_ != kNever && std::abs(crept_m_) > kCreeps_m;
}

/// Its supply is away: faster than it was ever driven, or back.
bool RestWatch::is_seen_to_roll(const RestInput& input) const {
  if (witness_.speed_mps(input.now) > drove_mps_ + kFaster_mps) return true;
  if (!std::isfinite(input.yaw_rad)) return false;
  return ahead_m(input) * direction_ < -kRolled_m;
}

/// A silent base that keeps its last command, and was not at rest or is seen to move: witnesses see
/// no slow motion, and some robots have none. On a slope it may as well have lost its supply, and
/// be caught when it has it again: it is given the time to begin, and the longer one when it is
/// seen to roll. What is seen to stand there must not be set in motion.
bool RestWatch::cannot_be_stopped(const RestInput& input) {
  spared_ = false;
  if (!silence_.unheard() || !is_driven_by_us(input)) return false;
  const bool stands = witness_.stands(input.now);
  const bool may_begin = on_slope_ || stands || !silence_.ever_heard();
  const Duration patience = from_s(may_begin ? kBegins_s : kSilent_s);
  const Duration waited = input.now - due_;
  if (waited < patience) return false;
  spared_ = on_slope_ &&
            (witness_.stands(input.now) || (is_seen_to_roll(input) && waited < kCaughtUntil));
  const bool seen = moves_since_ != kNever && input.now - moves_since_ >= patience;
  return (silence_.keeps_on() || seen) && !spared_;
}

void RestWatch::watch_silence(const RestInput& input, const RimMotion& rims) {
  const bool stop_asked = std::exchange(stop_asked_, false);
  // Wheels that are heard tell of those that are not, or gyro and receiver do.
  const bool silent = input.drives_on_in_silence && !rims.heard && rims.silent &&
                      !input.power_is_off && !input.released;
  const bool stop_now = silence_.update({.now = input.now,
                                         .silent = silent,
                                         .heard = rims.heard,
                                         .found_powered = input.found_powered,
                                         .stop_asked = stop_asked,
                                         .rests = state_ == RestState::resting,
                                         .slope = input.rolls_unpowered,
                                         .fastest_mps = rims.fastest_mps,
                                         .asked = expected_mps_ > 0});
  // A relay that this program has closed feeds a base that has forgotten everything.
  if (silence_.has_a_command()) ours_ = true;
  if (stop_now || (stop_asked && !silent && (rims.driven || turning_))) expect_stop(input.now);
  if (!silence_.is_back()) return;
  expected_mps_ = std::max(expected_mps_, std::abs(rims.fastest_mps));
  moves_since_ = quiet_since_ = kNever;
}

void RestWatch::watch_wheels(const RimMotion& rims, Time now) {
  turning_ = std::abs(rims.fastest_mps) > kTurns_mps;
  const bool swings = turning_ && rims.fastest_mps * rim_mps_ < 0;
  if (!turning_ || swings) turns_since_ = kNever;
  if (turning_ && turns_since_ == kNever) turns_since_ = now;
  rim_mps_ = rims.fastest_mps;
}

/// What rolled while no drive ran is given the time in which it gets slower.
void RestWatch::watch_braking(const RimMotion& rims, bool is_due, Time now) {
  const double mps = std::abs(rims.fastest_mps);
  const bool begins = rims.driven && drives_on_since_ == kNever;
  if (begins || !is_due || steady_since_ == kNever || mps < slowest_mps_ - kSlower_mps) {
    steady_since_ = now;
    slowest_mps_ = mps;
  }
  drives_on_since_ = rims.driven ? steady_since_ : kNever;
}

bool RestWatch::rolls(Time now) const {
  return turning_ && now - turns_since_ >= from_s(kRollHeld_s);
}

Reason RestWatch::turns_by_itself() const {
  Reason why;
  if (turning_ && !ours_) {
    why.format("the robot rolls without a command: %s %.2f m/s", words_of(rims_.base()).turn_by,
               rim_mps_);
  }
  return why;
}

bool RestWatch::others_say_so(const RestInput& input, const RimMotion& rims,
                              const Testimony& said) {
  const Time now = input.now;
  // A wheel of several that is not heard turns the base: the gyro alone sees it.
  const bool part = input.drives_on_in_silence && rims.heard && rims.silent;
  const bool alone = said.moving == 1 && (said.heard == 1 || part);
  if (!alone) {
    alone_since_ = kNever;
  } else if (alone_since_ == kNever) {
    alone_since_ = now;
  }
  return said.moving >= 2 || (alone && now - alone_since_ >= from_s(kAlone_s));
}

void RestWatch::tell(const char* what, const RimMotion& rims, const Testimony& said) {
  const std::string_view others = said.in_words;
  const auto size = static_cast<int>(others.size());
  if (std::abs(rims.fastest_mps) > kTurns_mps) {
    reason_.format("%s: %s %.2f m/s%s%.*s", what, words_of(rims_.base()).turn_by, rims.fastest_mps,
                   others.empty() ? "" : ", ", size, others.data());
  } else {
    const BaseWords& words = words_of(rims_.base());
    const char* quiet = rims.silent ? words.are_silent : words.tell_rest;
    reason_.format("%s: %s%s%.*s", what, quiet, others.empty() ? "" : ", but ", size,
                   others.data());
  }
}

void RestWatch::settle(const RestInput& input, const RimMotion& rims, const Testimony& said) {
  state_ = RestState::settling;
  const bool others = others_say_so(input, rims, said);
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

void RestWatch::stay(const RestInput& input, const RimMotion& rims, const Testimony& said) {
  if (others_say_so(input, rims, said) || rolls(input.now)) {
    state_ = turning_ ? RestState::rolling : RestState::carried;
    tell(turning_ ? "the robot rolls without a command" : "the robot is pushed or carried", rims,
         said);
    moves_since_ = input.now;
    quiet_since_ = kNever;
    return;
  }
  if (turning_) quiet_since_ = kNever;
  if (quiet_since_ == kNever) quiet_since_ = input.now;
  const bool quiet = input.now - quiet_since_ >= from_s(kConfirm_s);
  if (state_ != RestState::resting && !quiet) return;
  state_ = RestState::resting;
  reason_.clear();
  if (quiet && !silence_.unheard())
    ours_ = false;  // it was silent for a moment, and stood all the same
  // A receiver's position wanders over the hours.
  if (input.now - due_ > kLookAgain) {
    due_ = input.now;
    witness_.expect_rest(input.now, turn_);
  }
}

RestState RestWatch::update(const RestInput& input) {
  if (input.released) ours_ = false;  // who lets go of the drives is going to push
  const RimMotion rims = rims_.told(input.axes, input.now);
  hears_wheels_ = rims.heard;
  watch_silence(input, rims);
  watch_wheels(rims, input.now);
  const bool is_due = due(input);
  watch_braking(rims, is_due, input.now);
  // What began to roll on a slope still rolls where the ground is level again.
  const bool goes_on = is_due && state_ != RestState::resting;
  on_slope_ = input.rolls_unpowered || (on_slope_ && goes_on);
  // Taken back, too, is a drive of several that is silent: only wheels that turn are caught.
  const bool caught = input.caught && (turning_ || !rims.heard);
  may_roll_ = on_slope_ || caught || (may_roll_ && goes_on);
  if (state_ == RestState::not_stopping) {
    // What it rolled until it came to rest is no motion any more.
    if (due_ == kNever || input.now - due_ > kLookAgainAfterCut) {
      due_ = input.now;
      witness_.expect_rest(input.now, turn_);
    }
    return state_;
  }
  const bool creeps = is_due && creeps_on(input, rims);
  if (creeps || bolts(input, rims)) {
    state_ = RestState::not_stopping;
    tell(creeps ? "the robot did not stop" : "the robot runs away", rims, witness_.hear(input.now));
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
