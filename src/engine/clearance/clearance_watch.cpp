#include "engine/clearance/clearance_watch.h"

#include <algorithm>
#include <cmath>

namespace drover::engine {
namespace {

constexpr double kFree = std::numeric_limits<double>::infinity();
constexpr double kFirm = 0.8;  // of the deceleration
constexpr double kSlowest_radps = 0.05;
constexpr double kAgain_rad = 0.05;
constexpr double kDriveLag_s = 0.1;  // what of the reaction is still to come when a ramp begins now
constexpr double kNear = 0.4;        // m or rad: who stands so near to something stays there
constexpr double kSways_s = 1.0;     // who was stopped at once sways back, by a few centimetres

double curvature_radpm(const Twist& twist) {
  return drives(twist) ? twist.wz_radps / twist.vx_mps : 0.0;
}

}  // namespace

ClearanceWatch::ClearanceWatch(const ClearanceConfig& config, const LimitsConfig& limits,
                               bool required, bool pivots, bool sideways)
    : config_(config),
      limits_(limits),
      required_(required),
      pivots_(pivots),
      sideways_(sideways),
      straight_{config.reaction_s, kGentle * limits.deceleration_mps2},
      straight_firm_{config.reaction_s, kFirm * limits.deceleration_mps2},
      straight_full_{config.reaction_s, limits.deceleration_mps2},
      turning_{config.reaction_s, kGentle * limits.yaw_acceleration_radps2},
      turning_full_{config.reaction_s, limits.yaw_acceleration_radps2} {
  if (!required) caps_ = {kFree, kFree, kFree, kFree, kFree, kFree, kFree};
}

void ClearanceWatch::on_clearance(const Clearance& found) {
  if (found.t >= found_.t) found_ = found;
}

/// In an order that names the cause.
Reason ClearanceWatch::find_unknown(Time now, const WaySince& since) const {
  Reason why;
  if (found_.t == kNever) {
    why = "nothing is known yet of what is around the robot";
  } else if (now - found_.t > from_s(config_.silent_s)) {
    why.format("what is around the robot was looked at %.2f s ago", to_s(now - found_.t));
  } else if (!found_.unknown.empty()) {
    why = found_.unknown;
  } else if (!since.known) {
    why = "nobody knows how far the robot went since its surroundings were looked at";
  } else if (late_since_ != kNever && now - late_since_ >= from_s(config_.silent_s)) {
    why.format("nobody looked for %.2f s around the robot, again and again: the scene is too slow",
               to_s(latest_));
  }
  return why;
}

/// One late answer is braked for and forgotten with the next. Where one after the other is late the
/// robot stands nearly all the time, and that has to be told: between two late ones there may be
/// one cycle or some in which it might drive.
void ClearanceWatch::watch_lateness(Time now) {
  if (found_.t == kNever) return;
  const Duration age = now - found_.t;
  if (age > from_s(config_.max_age_s)) {
    in_time_since_ = kNever;
    if (late_since_ == kNever) {
      late_since_ = now;
      latest_ = {};
    }
    latest_ = std::max(latest_, age);
  } else if (late_since_ != kNever) {
    if (in_time_since_ == kNever) in_time_since_ = now;
    if (now - in_time_since_ > from_s(config_.max_age_s)) late_since_ = kNever;
  }
}

/// Nobody saw any way free now.
void ClearanceWatch::forget_freedom() {
  for (Gate& gate : gates_) gate.free_since = kNever;
}

void ClearanceWatch::watch_constraints(Time now) {
  if (!found_.broken.empty()) broken_ = found_.broken;
  if (!found_.broken.empty() || !unknown_.empty()) {
    held_since_ = kNever;
  } else if (held_since_ == kNever) {
    held_since_ = now;
    // Who took it away is not told that it does not hold.
    if (!broken_.empty())
      broken_.format("all constraints hold again, but not yet for %.1f s", config_.again_s);
  } else if (now - held_since_ >= from_s(config_.again_s)) {
    broken_.clear();
  }
}

/// How far from here on the base is where the answer's curve was looked along, if it drives on as
/// it does now. The answer is for its twist: since then the base may have turned otherwise, and it
/// may be commanded, or asked, another curve. What differs shifts it sideways and turns it, and its
/// farthest corner swings out by that turn; as long as all of it stays within `beside_m`, a part of
/// the margin that the answer keeps free about the footprint, nothing that the answer did not see
/// can be touched. Answers follow each other fast, so that a curve that changes steadily is driven
/// with the next one.
double ClearanceWatch::agreed_m(const ClearanceInput& input, const WaySince& since) const {
  const double answered_radpm = curvature_radpm(found_.twist);
  const double now_radpm = curvature_radpm(drives(input.commanded) ? input.commanded : input.asked);
  const double bend_radpm = std::abs(now_radpm - answered_radpm);
  const double turned_rad = std::abs(since.yaw_rad - answered_radpm * since.along_m);
  // reach (turned + bend s) + turned (driven + s) + bend s^2 / 2 = beside
  const double left_m = config_.beside_m - turned_rad * (config_.reach_m + since.driven_m);
  if (!(left_m > 0)) return 0;
  const double slope = turned_rad + bend_radpm * config_.reach_m;
  return 2 * left_m / (slope + std::sqrt(slope * slope + 2 * bend_radpm * left_m));
}

/// Closed at once, and open again only when more was free for long enough: who was stopped without
/// a ramp does not creep on to where a ramp would have ended. Without a ramp is stopped before what
/// is truly near: where a way ended because the position is not known as well as it was, nothing
/// came nearer, and a ramp that ends in what the margin alone leaves is as good.
void ClearanceWatch::judge(Gate& gate, const Stretch& way, const StopChain& full, Time now) {
  const bool too_near = stop_way(way.moves, full) > way.left;
  const StopChain from_now{kDriveLag_s, full.deceleration};
  const double truly_left = std::max(way.left, way.bare);
  too_near_ = too_near_ || (way.moves > 0 && stop_way(way.moves, from_now) > truly_left);
  if (way.moves > 0) gate.moved = now;
  const bool sways = gate.moved != kNever && now - gate.moved < from_s(kSways_s);
  gate.least = gate.closed && !sways ? std::min(gate.least, way.left) : way.left;
  if (too_near || permitted_speed(way.left, way.brakes) < way.slowest) {
    gate.closed = true;
    gate.free_since = kNever;
    return;
  }
  const double stood = gate.closed ? std::max(gate.least, 0.0) : 0.0;
  if (!(way.left > std::min(stood + way.again, std::max(way.again, kNear)))) {
    gate.free_since = kNever;
  } else if (gate.free_since == kNever) {
    gate.free_since = now;
  }
  if (gate.closed)
    gate.closed = gate.free_since == kNever || now - gate.free_since < from_s(config_.again_s);
}

double ClearanceWatch::along_cap(const ClearanceInput& input, const WaySince& since) {
  if (input.path == 0) {
    gates_[kAlong] = {};
    return 0;
  }
  const Stretch way{found_.along_m - since.driven_m,
                    found_.bare.along_m - since.driven_m,
                    std::abs(input.commanded.vx_mps),
                    straight_,
                    limits_.min_speed_mps,
                    config_.again_m};
  judge(gates_[kAlong], way, straight_full_, input.now);
  return gates_[kAlong].closed ? 0 : permitted_speed(way.left, way.brakes);
}

/// What is left of a deceleration for the middle of the base.
StopChain ClearanceWatch::in_curve(StopChain chain, const ClearanceInput& input) {
  const Twist& curve = drives(input.commanded) ? input.commanded : input.asked;
  if (!(input.half_track_m > 0) || !drives(curve)) return chain;
  const double middle_mps = std::abs(curve.vx_mps);
  chain.deceleration *= middle_mps / (middle_mps + std::abs(curve.wz_radps) * input.half_track_m);
  return chain;
}

/// Of a task the way along its track was looked at, and is come to gently. Its present curve is
/// looked along only because it may leave the track: what is behind a corner or a goal must not
/// slow it, so that counts only when it is nearly too near to stop before it, and nothing counts
/// that lies where the curve that is driven left the answer's: there the track's own answer holds.
double ClearanceWatch::straight_cap(Way which, const ClearanceInput& input, const WaySince& since,
                                    double agreed_m) {
  const bool task = input.path != 0;
  const double moves_mps = which == kBack ? -input.commanded.vx_mps : input.commanded.vx_mps;
  Stretch way{(which == kBack ? found_.back_m : found_.ahead_m) - since.driven_m,
              (which == kBack ? found_.bare.back_m : found_.bare.ahead_m) - since.driven_m,
              std::max(moves_mps, 0.0),
              in_curve(task ? straight_firm_ : straight_, input),
              limits_.min_speed_mps,
              config_.again_m};
  const StopChain full = in_curve(straight_full_, input);
  const bool elsewhere = way.left > agreed_m;
  if (elsewhere && task) way.left = kFree;
  if (elsewhere) way.moves = 0;  // not into what ends the answer's curve
  Gate& gate = gates_[which];
  judge(gate, way, full, input.now);
  if (gate.closed) return 0;
  const double cap_mps = permitted_speed(way.left, way.brakes);
  return task ? cap_mps : std::min(cap_mps, permitted_speed(agreed_m, full));
}

/// An answer about a turn is for the place where it was looked around.
double ClearanceWatch::turn_cap(Way which, const ClearanceInput& input, const WaySince& since) {
  const double moves_radps = which == kLeft ? input.commanded.wz_radps : -input.commanded.wz_radps;
  const Stretch way{
      (which == kLeft ? found_.left_rad : found_.right_rad) - since.turned_rad,
      (which == kLeft ? found_.bare.left_rad : found_.bare.right_rad) - since.turned_rad,
      drives(input.commanded) ? 0 : std::max(moves_radps, 0.0),
      turning_,
      kSlowest_radps,
      kAgain_rad};
  Gate& gate = gates_[which];
  judge(gate, way, turning_full_, input.now);
  const bool here = since.driven_m <= config_.beside_m;
  return gate.closed || !here ? 0 : permitted_speed(way.left, way.brakes);
}

/// Likewise, and for how it stood there.
double ClearanceWatch::aside_cap(Way which, const ClearanceInput& input, const WaySince& since) {
  if (!sideways_) return 0;
  const bool left = which == kAsideLeft;
  const double moves_mps = left ? input.commanded.vy_mps : -input.commanded.vy_mps;
  const Stretch way{(left ? found_.aside_left_m : found_.aside_right_m) - since.driven_m,
                    (left ? found_.bare.aside_left_m : found_.bare.aside_right_m) - since.driven_m,
                    std::max(moves_mps, 0.0),
                    straight_,
                    limits_.min_speed_mps,
                    config_.again_m};
  Gate& gate = gates_[which];
  judge(gate, way, straight_full_, input.now);
  const double off_m = std::abs(since.along_m) + since.turned_rad * config_.reach_m;
  const bool here = off_m <= config_.beside_m;
  return gate.closed || !here ? 0 : permitted_speed(way.left, way.brakes);
}

/// `aside`: part of what is asked for leads there.
bool ClearanceWatch::leads_aslant(const Twist& asked, bool aside) const {
  const auto goes_elsewhere = [](const Twist& twist) {
    return drives(twist) || std::abs(twist.wz_radps) > kTurns_radps;
  };
  if (!aside) return goes_sideways(commanded_);
  return !sideways_ || goes_elsewhere(asked) || goes_elsewhere(commanded_);
}

ClearanceWatch::Way ClearanceWatch::way_of(const Twist& twist) {
  if (drives(twist)) return twist.vx_mps < 0 ? kBack : kAhead;
  if (goes_sideways(twist)) return twist.vy_mps > 0 ? kAsideLeft : kAsideRight;
  if (std::abs(twist.wz_radps) > kTurns_radps) return twist.wz_radps > 0 ? kLeft : kRight;
  return kNone;
}

/// Where it is to go counts, and where it still goes when nobody asks for anything. A robot that
/// could go nowhere at all is blocked though it stands.
bool ClearanceWatch::is_blocked(const ClearanceInput& input) const {
  const auto closed = [this](Way way) { return gates_[way].closed; };
  const Way asked = way_of(input.asked);
  const Way way = asked == kNone ? way_of(input.commanded) : asked;
  if (input.path != 0) return closed(kAlong) || (way != kNone && closed(way));
  if (way != kNone) return closed(way);
  const bool turns = pivots_ && !(closed(kLeft) && closed(kRight));
  const bool aside = sideways_ && !(closed(kAsideLeft) && closed(kAsideRight));
  return closed(kAhead) && closed(kBack) && !turns && !aside;
}

/// In words: of a turn what hinders it, not what is ahead. What was in the way is the reason until
/// that is open again; what comes after it is farther away and hinders nobody.
Reason ClearanceWatch::blocked_by(const ClearanceInput& input) const {
  const auto held = [this](Way way) {
    return gates_[way].closed && gates_[way].free_since == kNever;
  };
  const Way asked = way_of(input.asked);
  const Way way = asked == kNone ? way_of(input.commanded) : asked;
  const bool waits = way != kNone && !held(way) && (input.path == 0 || !held(kAlong));
  if (waits && !blocked_.empty()) return blocked_;
  const bool turns = (way == kLeft || way == kRight) && gates_[way].closed;
  if (turns && !found_.turn.empty()) return found_.turn;
  if (!found_.first.empty()) return found_.first;
  return blocked_.empty() ? Reason("something is in the way") : blocked_;
}

void ClearanceWatch::update(const ClearanceInput& input) {
  if (!required_) return;
  ways_.note(input.body, input.now);
  commanded_ = input.commanded;
  if (found_.t > input.now) found_ = {};  // or it would keep all right ones out until then
  const WaySince since = ways_.since(found_.t);
  caps_ = {};
  watch_lateness(input.now);
  unknown_ = find_unknown(input.now, since);
  unasked_.clear();
  if (unknown_.empty() && input.path != 0 && input.path != found_.path)
    unasked_ = "the way along this track was not looked at yet";
  watch_constraints(input.now);
  too_near_ = false;
  if (!unknown_.empty() || !unasked_.empty()) {
    forget_freedom();
    blocked_.clear();
    return;
  }
  // A late answer permits nothing either, but it is no obstacle that came: all stays as it was.
  if (input.now - found_.t > from_s(config_.max_age_s)) return;
  const double agreed = agreed_m(input, since);
  const ClearanceCaps caps{along_cap(input, since),
                           straight_cap(kAhead, input, since, agreed),
                           straight_cap(kBack, input, since, agreed),
                           turn_cap(kLeft, input, since),
                           turn_cap(kRight, input, since),
                           aside_cap(kAsideLeft, input, since),
                           aside_cap(kAsideRight, input, since)};
  blocked_ = is_blocked(input) ? blocked_by(input) : Reason();
  const bool waits = input.path != 0 && !blocked_.empty();
  if (broken_.empty() && !waits) caps_ = caps;
}

Twist ClearanceWatch::limit(const Twist& asked) const {
  if (required_ && leads_aslant(asked, asked.vy_mps != 0)) return {};
  const auto share = [](double wanted, double cap) { return wanted > cap ? cap / wanted : 1.0; };
  double permitted =
      share(std::abs(asked.vx_mps), asked.vx_mps < 0 ? caps_.back_mps : caps_.ahead_mps);
  if (!drives(asked))
    permitted = std::min(
        permitted,
        share(std::abs(asked.wz_radps), asked.wz_radps > 0 ? caps_.left_radps : caps_.right_radps));
  if (asked.vy_mps != 0)
    permitted =
        std::min(permitted, share(std::abs(asked.vy_mps),
                                  asked.vy_mps > 0 ? caps_.aside_left_mps : caps_.aside_right_mps));
  // What is no number is told as it is: the gate behind refuses it and says so.
  if (!(permitted < 1)) return asked;
  return {asked.vx_mps * permitted, asked.wz_radps * permitted, asked.vy_mps * permitted};
}

double ClearanceWatch::rim_cap_mps(const Twist& asked, double half_track_m) const {
  if (required_ && leads_aslant(asked, goes_sideways(asked))) return 0;
  const double left_mps = caps_.left_radps * half_track_m;
  const double right_mps = caps_.right_radps * half_track_m;
  switch (way_of(asked)) {
    case kAhead: return caps_.ahead_mps;
    case kBack: return caps_.back_mps;
    case kLeft: return left_mps;
    case kRight: return right_mps;
    case kAsideLeft: return caps_.aside_left_mps;
    case kAsideRight: return caps_.aside_right_mps;
    default: break;  // wheels against each other: whatever it makes of the base
  }
  return std::min({caps_.ahead_mps, caps_.back_mps, left_mps, right_mps});
}

}  // namespace drover::engine
