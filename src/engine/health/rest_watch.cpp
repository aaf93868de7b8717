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
constexpr double kBolts_mps = 0.5;  // over the limit, and over what the wheels explain
constexpr double kAlone_s = 1.0;    // a witness without another one
constexpr double kSilent_s = 1.0;   // where nothing else can tell
constexpr double kBegins_s = 2.5;   // a base that has its supply again, with a margin
constexpr Duration kCaughtUntil = std::chrono::seconds(10);  // as long as drives are taken back
constexpr double kSteady_s = 1.0;
constexpr double kConfirm_s = 1.0;
constexpr Duration kCreptLately = std::chrono::seconds(1);  // one speed of a receiver is noise
constexpr Duration kLookAgain = std::chrono::seconds(5);
constexpr Duration kLookAgainAfterCut = std::chrono::seconds(2);

/// There is some to take, and no person has let the drives go.
bool has_power(const RestInput& input) {
  return !input.power_is_off && !input.released;
}

}  // namespace

RestWatch::RestWatch(const EngineConfig& config)
    : config_(config), rims_(config), witness_(config) {}

void RestWatch::expect_stop(Time now) {
  ours_ = true;
  if (!creep_.under_way()) creep_.begin(now);
  if (!has_rested()) return;
  state_ = RestState::settling;
  due_ = last_.rest_due = now;
  moves_since_ = alone_since_ = kNever;
}

bool RestWatch::has_rested() const {
  return state_ == RestState::resting || state_ == RestState::carried ||
         state_ == RestState::rolling;
}

void RestWatch::reset() {
  if (state_ != RestState::not_stopping) return;
  state_ = RestState::settling;
  ours_ = last_.inherited = false;  // what had no power begins anew
  silence_.reset();
  creep_.end();
  quiet_since_ = moves_since_ = alone_since_ = kNever;
  reason_.clear();
}

/// Whether the time that a ramp to zero needs is over.
bool RestWatch::due(const RestInput& input) {
  const RimMotion asked = rims_.asked(input.axes, input.now);
  const double asked_mps = asked.fastest_mps;
  if (asked_mps != 0 && !input.caught) {
    ours_ = true;
    coasts_ = false;
    const bool told = asked.ahead != 0 || asked.turn != 0;  // the end of a ramp counts as standing
    last_.direction = told ? asked.ahead : last_.direction;
    last_.turn = told ? asked.turn : last_.turn;
    if (state_ != RestState::driving && state_ != RestState::settling) last_.fastest_mps = 0;
    last_.fastest_mps = std::max(last_.fastest_mps, std::abs(asked_mps));
  }
  const double slower_mps =
      expected_mps_ - config_.limits.deceleration_mps2 * std::max(to_s(input.dt), 0.0);
  expected_mps_ = std::max(std::abs(asked_mps), slower_mps);
  if (expected_mps_ > 0) {
    due_ = kNever;
    return false;
  }
  if (due_ == kNever) {
    due_ = last_.rest_due = input.now;
    witness_.expect_rest(input.now, last_.turn);
    quiet_since_ = moves_since_ = alone_since_ = kNever;
    last_.seen_mps = 0;
    crept_at_ = kNever;
    creep_.end();
    if (ours_ || last_.inherited) creep_.begin(input.now);
  }
  if (last_.seen_mps == 0) last_.seen_mps = witness_.speed_mps(input.now);
  return true;
}

/// There is power to take, and what moves the base may be a command of ours.
bool RestWatch::is_driven_by_us(const RestInput& input) const {
  return ours_ && has_power(input);
}

/// Whether taking the power helps: from what we drive, not from what would only roll faster.
bool RestWatch::may_be_cut(const RestInput& input, const RimMotion& rims) const {
  // Wheels that run by what the program before this one said, and nothing else shows it.
  const bool inherits = last_.inherited && !ours_ && history_.turns() && rims.driven;
  if ((!ours_ && !inherits) || !has_power(input)) return false;
  if (!may_roll_ && !inherits) return true;
  // Caught on level ground, or slowed down by a guard, it gets slower: what does not is driven.
  if (!on_slope_)
    return input.now - std::max(moves_since_, history_.steady_since()) >= from_s(kSteady_s);
  // Drives that do not run drive nothing: it rolls, and they are to catch it.
  const Time since = std::max(moves_since_, history_.drives_on_since());
  return rims.driven && input.now - since >= from_s(inherits ? kSteady_s : kMotionHeldOnSlope_s) &&
         pardon(input).drives_on(rims);
}

/// Before any rest is due. Not where it would only roll without power, and may slide down.
bool RestWatch::bolts(const RestInput& input, const RimMotion& rims) const {
  if (!is_driven_by_us(input) || may_roll_ || !rims.driven) return false;
  const double explained_mps =
      std::max({config_.limits.max_speed_mps, expected_mps_, std::abs(rims.fastest_mps)});
  return witness_.proven_speed_mps(input.now, input.yaw_rad) > explained_mps + kBolts_mps;
}

bool RestWatch::creeps_on(const RestInput& input, const RimMotion& rims) {
  // What the program before this one drove may still be braking: faster it is judged by that.
  const bool found = last_.inherited && !ours_;
  return creep_.update({.now = input.now,
                        .dt = input.dt,
                        .power = has_power(input),
                        .may_roll = may_roll_ || found,
                        .falls_ahead = input.falls_ahead,
                        .seen_to_stand = pardon(input).stands()},
                       rims);
}

/// A silent base that keeps its last command, and was not at rest or is seen to move: witnesses see
/// no slow motion, and some robots have none. On a slope it may as well have lost its supply, and
/// be caught when it has it again: it is given the time to begin, and the longer one when it is
/// seen to roll. What is seen to stand there must not be set in motion.
bool RestWatch::cannot_be_stopped(const RestInput& input) {
  spared_ = false;
  if (!silence_.unheard() || !is_driven_by_us(input)) return false;
  const SlopePardon seen_on_slope = pardon(input);
  if (seen_on_slope.creeps_unheard()) crept_at_ = input.now;
  const bool stands = seen_on_slope.stands();
  const bool may_begin = on_slope_ || stands || !silence_.ever_heard();
  const Duration patience = from_s(may_begin ? kBegins_s : kSilent_s);
  const Duration waited = input.now - due_;
  if (waited < patience) return false;
  const bool may_be_caught = seen_on_slope.rolls() && waited < kCaughtUntil;
  const bool creeps = crept_at_ != kNever && input.now - crept_at_ < kCreptLately;
  spared_ = on_slope_ && (stands || creeps || may_be_caught);
  const bool seen = moves_since_ != kNever && input.now - moves_since_ >= patience;
  return (silence_.keeps_on() || seen) && !spared_;
}

void RestWatch::watch_silence(const RestInput& input, const RimMotion& rims) {
  const bool stop_asked = std::exchange(stop_asked_, false);
  // Wheels that are heard tell of those that are not, or gyro and receiver do.
  const bool silent = input.drives_on_in_silence && !rims.heard && rims.silent &&
                      !input.power_is_off && !input.released;
  const bool stop_now = silence_.update({.silent = silent,
                                         .heard = rims.heard,
                                         .found_powered = input.found_powered,
                                         .stop_asked = stop_asked,
                                         .rests = state_ == RestState::resting,
                                         .moves = pardon(input).goes(history_.turns()),
                                         .slope = input.rolls_unpowered,
                                         .fastest_mps = rims.fastest_mps,
                                         .asked = expected_mps_ > 0});
  // A relay that this program has closed feeds a base that has forgotten everything.
  if (silence_.has_a_command() && !silence_.was_found_at_rest()) ours_ = true;
  if (stop_now || (stop_asked && !silent && (rims.driven || history_.turns())))
    expect_stop(input.now);
  if (!silence_.is_back()) return;
  expected_mps_ = std::max(expected_mps_, std::abs(rims.fastest_mps));
  moves_since_ = quiet_since_ = kNever;
}

Reason RestWatch::turns_by_itself() const {
  Reason why;
  if (history_.turns() && !ours_) {
    why.format("the robot rolls without a command: %s %.2f m/s", words_of(rims_.base()).turn_by,
               history_.mps());
  }
  return why;
}

bool RestWatch::others_say_so(const RestInput& input, const RimMotion& rims,
                              const Testimony& said) {
  const Time now = input.now;
  // A wheel of several that is not heard turns the base: the gyro alone sees it.
  const bool part = input.drives_on_in_silence && rims.heard && rims.silent;
  const bool alone = said.moving == 1 && (said.heard == 1 || (part && witness_.turns(now)));
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
  const bool moves = others || history_.turns();
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
  if (ours_ ? moves && late : others || history_.rolls(input.now)) {
    tell("the robot moves without a command", rims, said);
  } else if (!moves) {
    reason_.clear();
  }
  // What stands in silence where it could roll brakes by itself, and may go on doing so.
  const bool seen = silence_.unheard() && on_slope_ && witness_.stood(input.now);
  const bool quiet = !history_.turns() && (!rims.silent || seen) && said.moving == 0;
  if (!quiet) quiet_since_ = kNever;
  if (quiet && quiet_since_ == kNever) quiet_since_ = input.now;
  if (quiet && input.now - quiet_since_ >= from_s(kConfirm_s)) {
    state_ = RestState::resting;
    ours_ = last_.inherited = false;
  }
}

void RestWatch::stay(const RestInput& input, const RimMotion& rims, const Testimony& said) {
  if (others_say_so(input, rims, said) || history_.rolls(input.now)) {
    state_ = history_.turns() ? RestState::rolling : RestState::carried;
    // Drives that are silent may have let go: a person was not seen.
    const bool may_roll = rims.silent && !rims.heard && !input.power_is_off && !input.released;
    const char* moves =
        may_roll ? "the robot moves without a command" : "the robot is pushed or carried";
    tell(history_.turns() ? "the robot rolls without a command" : moves, rims, said);
    moves_since_ = input.now;
    quiet_since_ = kNever;
    return;
  }
  if (history_.turns()) quiet_since_ = kNever;
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
    witness_.expect_rest(input.now, last_.turn);
  }
}

RestState RestWatch::update(const RestInput& input) {
  if (!std::exchange(began_, true))
    last_.inherited = input.found_powered && !silence_.was_found_at_rest();
  if (input.released)
    ours_ = last_.inherited = false;  // who lets go of the drives is going to push
  const RimMotion rims = rims_.told(input.axes, input.now);
  hears_wheels_ = rims.heard;
  misses_wheels_ = rims.silent;
  watch_silence(input, rims);
  history_.note_turning(rims, input.now);
  const bool is_due = due(input);
  history_.note_braking(rims, is_due, input.now);
  // What began to roll on a slope still rolls where the ground is level again.
  const bool goes_on = is_due && state_ != RestState::resting;
  on_slope_ = input.rolls_unpowered || (on_slope_ && goes_on);
  // Taken back, too, is a drive of several that is silent: only wheels that turn are caught.
  const bool caught = input.caught && (history_.turns() || !rims.heard);
  coasts_ = state_ != RestState::resting && (coasts_ || input.power_is_off);
  may_roll_ = on_slope_ || caught || coasts_ || (may_roll_ && goes_on);
  if (state_ == RestState::not_stopping) {
    // What it rolled until it came to rest is no motion any more.
    if (due_ == kNever || input.now - due_ > kLookAgainAfterCut) {
      due_ = input.now;
      witness_.expect_rest(input.now, last_.turn);
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
    if (has_rested()) {
      stay(input, rims, said);
    } else {
      settle(input, rims, said);
    }
  }
  witness_.set_at_rest(state_ == RestState::resting);
  return state_;
}

}  // namespace drover::engine
