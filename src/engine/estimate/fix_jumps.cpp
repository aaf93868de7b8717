#include "engine/estimate/fix_jumps.h"

#include <algorithm>
#include <cmath>

namespace drover::engine::estimate {
namespace {

// A step from one RTK position to the next one.
constexpr Duration kStepWithin = std::chrono::seconds(12);
constexpr double kStepGate = 4.5;  // sigmas
constexpr double kStepSlip = 0.4;  // of the way between them, along it
constexpr double kStepSlipWay_m = 0.25;
constexpr Duration kShownAfterShove = std::chrono::milliseconds(300);
constexpr double kShoveGate = 3.0;  // sigmas
constexpr double kReckoned = 0.02;  // of a longer way, by wheels and gyro
constexpr double kReckonedWell_m = 0.1;
// A fix that was found again is what it will be so many times fix_settle_s later, and when so
// little is left of the error that it had before.
constexpr double kSettles = 3.0;
constexpr double kFaded_m = 0.03;
constexpr double kSlippedAside_m = 0.05;
// What PlaceWatch takes for slip of a shorter way is no more than for a jump.
constexpr double kDroveOn_m = 0.25;
// Lost for so long it is found by another search of the receiver.
constexpr Duration kAnotherFix = std::chrono::seconds(10);
constexpr double kSways = 0.1;  // of the variance by tilt and timing: most of that stays the same

/// A fix that was just found again: it may be another integer solution, and how far it is beside of
/// where the base is taken to be shows when its filters have settled.
bool settles(const State& state, const EstimateConfig& config) {
  const GnssTrack& gnss = state.gnss;
  return !state.way_unknown && gnss.believed != kNever && !has_settled(state, config);
}

/// What the sensor's way of a shove may be wrong by. Positions that are told late still show it for
/// a moment after it is over.
double shoved_m(const State& state) {
  const Shove& shove = state.shove;
  const bool of_late =
      shove.ended != kNever && state.gnss.believed - shove.ended <= kShownAfterShove;
  return of_late ? kShoveGate * std::sqrt(shove.variance_m2) : 0.0;
}

/// Of a step, in the map, what is left when the antenna of the last position was somewhere between
/// where a guessed tilt had it and where it is now.
Dispute::Offset untilted(const State& state, const Dispute::Offset& step, const LeverArm& arm) {
  const GnssTrack& gnss = state.gnss;
  if (!gnss.arm_guessed) return step;
  const double yaw_rad = state.belief.mean[kYaw];
  const double ahead_m = gnss.arm.ahead_m - arm.ahead_m;
  const double left_m = gnss.arm.left_m - arm.left_m;
  const Dispute::Offset by{ahead_m * std::cos(yaw_rad) - left_m * std::sin(yaw_rad),
                           ahead_m * std::sin(yaw_rad) + left_m * std::cos(yaw_rad)};
  const double by2 = square(by.m());
  if (!(by2 > 0)) return step;
  const double share =
      std::clamp((step.east_m * by.east_m + step.north_m * by.north_m) / by2, 0.0, 1.0);
  return {step.east_m - share * by.east_m, step.north_m - share * by.north_m};
}

/// Whether a position jumped aside of the last one, or along the way by more than wheels slip. One
/// that did may be inside of the gate.
bool steps(const State& state, const FixBeside& fix, double variance_m2) {
  const GnssTrack& gnss = state.gnss;
  if (state.standing_since != kNever || gnss.believed == kNever) return false;
  if (state.way_unknown || state.shove.holds()) return false;
  const Duration since = state.time - gnss.believed;
  if (since > kStepWithin) return false;
  const double yaw_rad = state.belief.mean[kYaw];
  const Dispute::Offset step = untilted(
      state, {fix.offset.east_m - gnss.beside_x_m, fix.offset.north_m - gnss.beside_y_m}, fix.arm);
  const double way_m = std::abs(fix.speed_mps) * to_s(since);
  const double least_m = std::max(kStepGate * std::sqrt(2 * variance_m2), kSameFix_m) +
                         kReckoned * std::max(way_m - kReckonedWell_m, 0.0);
  const double slip_m = kStepSlip * std::min(way_m, kStepSlipWay_m);
  const double aside_m = std::hypot(least_m, shoved_m(state));
  return std::hypot(step.ahead_m(yaw_rad) / (least_m + slip_m), step.left_m(yaw_rad) / aside_m) > 1;
}

/// What is left of it in the bound, until another fix is found there: dead reckoning, which may
/// have been right, was known by two sigma.
double doubt_m(const Dispute::Offset& beside, double two_sigma_m) {
  return beside.m() < kSameFix_m ? 0.0 : beside.m() + two_sigma_m;
}

/// The same of a fix that was found again: beside of where wheels and gyro have it. Who stands, but
/// drove on without one, is found as he would be driving; who stood all the while may have been
/// carried, which PlaceWatch sees.
bool is_elsewhere(const State& state, bool near) {
  const bool judged = state.watch.looks() || state.watch.drifted;  // by how it goes on at rest
  const bool drove_on = state.unseen.way_m > kDroveOn_m && !judged;
  const bool drove = state.standing_since == kNever || drove_on;
  return drove && !state.way_unknown && !near && !state.shove.holds();
}

}  // namespace

bool has_settled(const State& state, const EstimateConfig& config) {
  const GnssTrack& gnss = state.gnss;
  if (gnss.improved == kNever) return true;
  const double faded = std::log(gnss.old_sigma_m / kFaded_m);
  return to_s(state.time - gnss.improved) >= std::max(kSettles, faded) * config.fix_settle_s;
}

bool found_again(const State& state) {
  const GnssTrack& gnss = state.gnss;
  if (gnss.believed == kNever) return false;
  const bool improved = gnss.improved != kNever && gnss.improved >= gnss.believed;
  return improved || state.time - gnss.believed > kFixGone;
}

bool slipped_meanwhile(const State& state, const Dispute::Offset& beside,
                       const EstimateConfig& config) {
  if (!found_again(state)) return false;
  const double yaw_rad = state.belief.mean[kYaw];
  const double known_m = std::max(two_sigma_position_m(state.belief), kSlippedAside_m);
  const double share = config.unseen_slip_share;
  const double behind_m = -beside.ahead_m(yaw_rad);
  const double aside_m = std::abs(beside.left_m(yaw_rad));
  return behind_m >= -share * state.unseen.against_m(yaw_rad) - known_m &&
         behind_m <= share * state.unseen.in_m(yaw_rad) + known_m &&
         aside_m <= share * state.unseen.aside_m(yaw_rad) + known_m &&
         state.unseen.slips_to(beside.east_m, beside.north_m, share, known_m);
}

FixVerdict judge_jump(State& state, const FixBeside& fix, const EstimateConfig& config) {
  GnssTrack& gnss = state.gnss;
  const double known_m = two_sigma_position_m(state.belief);
  if (gnss.dispute.holds()) {
    const auto verdict =
        gnss.dispute.hear(fix.offset, fix.inside, known_m, fix.sigma_m, has_settled(state, config),
                          state.standing_since != kNever, state.time);
    if (verdict == Dispute::Verdict::undecided) return FixVerdict::doubted;
    const bool moved_at_rest = gnss.dispute.moved_at_rest();
    const double apart_m = gnss.dispute.apart_m();
    gnss.dispute = {};
    gnss.believed = kNever;
    if (verdict == Dispute::Verdict::renewed) {
      if (!moved_at_rest) gnss.renewed = state.time;
      gnss.unconfirmed_m = apart_m + known_m;
      gnss.unbelieved = {-fix.offset.east_m, -fix.offset.north_m};
      gnss.unbelieved_m = known_m;
      return FixVerdict::renewed;
    }
    // It stepped back, and may have jumped elsewhere meanwhile.
    gnss.unconfirmed_m = std::max(gnss.unconfirmed_m, doubt_m(fix.offset, known_m));
  }
  const bool can_wait = known_m < config.bound_run_m || state.standing_since != kNever;
  if (settles(state, config) && can_wait) return FixVerdict::waits;
  const bool again = found_again(state);
  const double white_m = config.gnss_white_share * fix.sigma_m;
  const double variance_m2 = square(white_m) + kSways * fix.sways_m2;
  const bool jumped = again ? is_elsewhere(state, fix.near) : steps(state, fix, variance_m2);
  // Found again about there it is believed, but may be another integer solution all the same. Where
  // nobody knows the way there is no other place to compare it with.
  if (again && !jumped && !state.way_unknown) {
    // After a moment it is the same solution, and as right or wrong as before.
    const bool another = state.time - gnss.believed > kAnotherFix;
    gnss.unconfirmed_m = std::max(another ? 0.0 : gnss.unconfirmed_m, doubt_m(fix.offset, known_m));
    if (another) {
      state.watch.stayed_m = 0;
      gnss.unbelieved = {};
      gnss.unbelieved_m = 0;
    }
  }
  if (!jumped) return FixVerdict::plain;
  gnss.dispute.begin(fix.offset, state.time, slipped_meanwhile(state, fix.offset, config),
                     state.time);
  if (!again) gnss.dispute.came_from({gnss.beside_x_m, gnss.beside_y_m});
  state.fit.pause();
  return FixVerdict::doubted;
}

}  // namespace drover::engine::estimate
