// How far off an estimate may be: by what motion is decided, and the bound for people.
#include <algorithm>
#include <cmath>

#include "engine/estimate/antenna_tilt.h"
#include "engine/estimate/contradictions.h"
#include "engine/estimate/estimator.h"

namespace drover::engine {

using namespace estimate;

namespace {

// An error lasts for half a minute: at two sigma a robot would be outside once in ten minutes, at
// four hardly ever, as long as the sources err as they say.
constexpr double kSure = 2.0;
// Another integer solution that was taken for the place of a base at rest may last so long.
constexpr Duration kMayStepBack = std::chrono::seconds(60);
// A receiver that does not tell how well it knows (GST) may be as bad as this beside its class.
constexpr double kUntold_m = 0.019;

/// For the decision, and for people.
struct Errors {
  double decides_m = 0;
  double bound_m = 0;
};

/// What the place is not known by while nothing contradicts it: two sigma, and four with all that
/// nobody measures. `arm_wrong`: that is told, and comes on top of it elsewhere.
Errors own_errors(const State& state, double speed_mps, bool arm_wrong,
                  const EstimateConfig& config) {
  const double two_sigma_m = state.doubt(config).two_sigma_m(state.belief);
  const double tilt_m = state.gnss.guessed_m;
  const double untold_m = state.gnss.told_sigma ? 0.0 : kUntold_m;
  // Until it is known how late positions are, the place along the way is not well known.
  const double late_m = speed_mps * state.fit.late_sigma_s();
  const double late_doubt_m = speed_mps * state.fit.late_doubt_s();
  const double unmeasured_m =
      unmeasured_sigma_m(state.gyro, antenna_of(config, state.gnss.receiver));
  const double sure_m =
      kSure * std::hypot(std::hypot(two_sigma_m, 2 * std::hypot(tilt_m, unmeasured_m)),
                         2 * late_doubt_m, 2 * untold_m);
  const double arm_m = arm_wrong ? 0.0 : state.fit.arm_doubt_m(2 * kSure, config);
  return {std::hypot(std::hypot(two_sigma_m, 2 * tilt_m), 2 * late_m, 2 * untold_m),
          std::hypot(sure_m, arm_m)};
}

/// How far away another place is, which may be the right one.
Errors other_place(const State& state, const Contradictions& between, Time now) {
  const MotionWatch& watch = state.watch;
  const Dispute& dispute = state.gnss.dispute;
  const JumpWatch& jumps = state.gnss.jumps;
  double apart_m = 0;
  if (jumps.disagrees(kContradicted)) apart_m = state.gnss.contradiction_m;
  // Positions that led dead reckoning meanwhile may have wandered themselves.
  if (dispute.holds() && now - dispute.since() >= kContradicted)
    apart_m = dispute.apart_m() + dispute.led_aside_m(state.belief.mean[kYaw]);
  if (between.drifted) apart_m = std::max(apart_m, watch.drift_m);
  Errors away{apart_m, apart_m};
  // Less than that is no contradiction, but may well be the beginning of one.
  if (dispute.holds()) away.bound_m = std::max(apart_m, dispute.apart_m() + dispute.led_m());
  if (jumps.running()) away.bound_m = std::max(away.bound_m, state.gnss.contradiction_m);
  if (state.gnss.replaced != kNever && now - state.gnss.replaced < kMayStepBack)
    away.bound_m = std::max(away.bound_m, state.gnss.replaced_m);
  away.bound_m = std::max({away.bound_m, state.gnss.unconfirmed_m, watch.stayed_m});
  return away;
}

}  // namespace

void Estimator::report_errors(const State& state, const Contradictions& between, Time now) {
  Estimate& e = estimate_;
  report_yaw_error(state);
  e.elsewhere_m = state.gnss.unconfirmed_m;
  e.pose.position_sigma_m = e.predicted_error_m = e.own_error_m = e.error_bound_m = kAbsent;
  if (!state.has_position) return;

  const MotionWatch& watch = state.watch;
  const bool wrong = arm_wrong(state, now);
  const double speed_mps = std::hypot(e.pose.vx_mps, e.pose.vy_mps);
  const Errors own = own_errors(state, speed_mps, wrong, config_);
  Errors away = other_place(state, between, now);
  // Wheels or positions: one of the two is wrong, and nobody knows which.
  const double gap_m = watch.slipping() ? std::abs(watch.last_gap_m) : 0;
  away.bound_m = std::max(away.bound_m, gap_m);
  const double arm_m = wrong ? std::hypot(state.fit.ahead_m(), state.fit.left_m()) : 0;
  e.pose.position_sigma_m = own.decides_m / 2;
  e.own_error_m = std::max({own.decides_m, gap_m, arm_m});
  e.predicted_error_m = std::max(e.own_error_m, away.decides_m);
  e.elsewhere_m = watch.looks() ? std::max(watch.gap_m, away.bound_m) : away.bound_m;
  const double slip_m = config_.unseen_slip_share * state.unseen.way_m;
  e.error_bound_m = own.bound_m + std::hypot(std::max(watch.gap_m, away.bound_m), slip_m) + arm_m;
}

void Estimator::report_yaw_error(const State& state) {
  Estimate& e = estimate_;
  e.pose.yaw_sigma_rad = e.yaw_error_rad = kAbsent;
  if (!state.has_heading) return;
  const double two_sigma_rad = state.doubt(config_).two_sigma_rad(state.belief);
  e.pose.yaw_sigma_rad = std::hypot(two_sigma_rad / 2, state.mount_left_rad());
  e.yaw_error_rad = two_sigma_rad;
  // Gyro and wheels, which agree, vote a heading out that jumped.
  const bool voted = e.gyro_used && state.gyro.trouble == TurnTrouble::none;
  if (state.heading.jumps.disagrees(kContradicted) && !voted)
    e.yaw_error_rad = std::max(e.yaw_error_rad, state.heading.contradiction_rad);
}

}  // namespace drover::engine
