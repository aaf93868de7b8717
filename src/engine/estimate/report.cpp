// What a state of the estimate means, in the words and bounds that the others use.
#include <algorithm>
#include <cmath>

#include "drover/angle.h"
#include "engine/estimate/estimator.h"
#include "engine/estimate/reach.h"

namespace drover::engine {

using namespace estimate;

namespace {

constexpr Duration kReachEach = std::chrono::milliseconds(100);
// An RTK fix this young is what the place rests on, not dead reckoning.
constexpr Duration kFixed = std::chrono::milliseconds(500);
// A run of refused positions so long is no outlier.
constexpr Duration kContradicted = std::chrono::milliseconds(300);
// An error lasts for half a minute: at two sigma a robot would be outside once in ten minutes, at
// four hardly ever, as long as the sources err as they say.
constexpr double kSure = 2.0;

HeadingDoubt doubt_of(const State& state, const EstimateConfig& config) {
  return {state.mount_sigma_rad(config), state.reckoned.east_m, state.reckoned.north_m};
}

}  // namespace

void Estimator::report(const State& state, Time now) {
  const Belief& belief = state.belief;
  const BodyMotion body = body_motion(base_, state.told, now, wheel_stale_);
  Estimate& e = estimate_;
  e.has_position = state.has_position;
  e.has_heading = state.has_heading;
  e.pose.time = now;
  e.pose.x_m = belief.mean[kX];
  e.pose.y_m = belief.mean[kY];
  e.pose.yaw_rad = belief.mean[kYaw];
  e.pose.vx_mps = belief.mean[kScale] * body.twist.vx_mps;
  const GyroMotion gyro = motion_of(state.gyro, belief, body, now, config_);
  e.gyro_used = gyro.known || (body.standing && state.gyro.fresh(now, imu_stale_));
  e.pose.wz_radps = gyro.known
                        ? belief.mean[kGyroScale] * (gyro.rate_radps - belief.mean[kGyroBias])
                        : belief.mean[kGain] * body.twist.wz_radps;
  e.body = body;
  e.fastest_mps = fastest_mps(base_, body.twist);
  e.yaw_slip_factor = 1.0 / belief.mean[kGain];

  const HeadingDoubt doubt = doubt_of(state, config_);
  const double two_sigma_m = doubt.two_sigma_m(belief);
  const double two_sigma_rad = doubt.two_sigma_rad(belief);
  e.pose.position_sigma_m = state.has_position ? two_sigma_m / 2 : kAbsent;
  e.pose.yaw_sigma_rad = state.has_heading ? two_sigma_rad / 2 : kAbsent;
  e.predicted_error_m = state.has_position ? two_sigma_m : kAbsent;
  e.error_bound_m = state.has_position ? kSure * two_sigma_m : kAbsent;
  e.yaw_error_rad = state.has_heading ? two_sigma_rad : kAbsent;

  report_trouble(state, now);
  report_imu(state, now);
  const bool told = state.heading.last != kNever;
  e.mounting_known = told && state.mounting.known(config_);
  e.mounting_rad = told ? -state.mounting.applied_rad : kAbsent;
  e.mounting_sigma_rad = told ? state.mounting.sigma_rad(config_) : kAbsent;
  if (reach_at_ == kNever || now - reach_at_ >= kReachEach || now < reach_at_) {
    reach_at_ = now;
    e.metres_left = reach_m(state, now);
  }
}

void Estimator::report_trouble(const State& state, Time now) {
  Estimate& e = estimate_;
  const Duration patience = from_s(config_.jump_time_s);
  const MotionWatch& watch = state.watch;
  const bool position_disagrees = state.gnss.jumps.disagrees(patience);
  const bool heading_disagrees = state.heading.jumps.disagrees(patience);
  const bool stuck = watch.stuck(now, patience);
  const bool drifted = watch.drifted;
  e.disagrees = position_disagrees || heading_disagrees || stuck || drifted;
  e.slipped_m = watch.slipping() ? watch.slipped_m + std::abs(watch.last_gap_m) : 0;
  // One of the two is wrong, and nobody knows which: the error may be all that lies between them.
  if (state.has_position) {
    double apart_m = 0;
    if (state.gnss.jumps.disagrees(kContradicted)) apart_m = state.gnss.contradiction_m;
    if (drifted) apart_m = std::max(apart_m, watch.drift_m);
    if (watch.slipping()) apart_m = std::max(apart_m, std::abs(watch.last_gap_m));
    e.predicted_error_m = std::max(e.predicted_error_m, apart_m);
    // Less than that is no contradiction, but may well be the beginning of one.
    e.error_bound_m = std::max(e.error_bound_m + watch.gap_m, apart_m);
  }
  if (position_disagrees) {
    e.reason = "position disagrees with odometry";
  } else if (heading_disagrees) {
    e.reason = "heading disagrees with odometry";
  } else if (stuck) {
    e.reason.format("wheels slip or the receiver is stuck: %.2f m/s by wheels, %.2f by receiver",
                    watch.wheel_mps, watch.receiver_mps);
  } else if (drifted) {
    e.reason.format(
        "position drifts away from odometry: %.2f m; if the map shows the robot where it stands: "
        "drover position accept",
        watch.drift_m);
  } else if (!frame_.has_origin()) {
    e.reason = "no origin";
  } else if (!state.has_position) {
    e.reason = "no position yet";
  } else if (!state.has_heading) {
    e.reason = "no heading";
  } else if (!body_motion(base_, state.told, now, wheel_stale_).known) {
    e.reason = takes_twist(base_) ? "the base is silent" : "wheels are silent";
  } else {
    e.reason.clear();
  }
  const GyroTrack& gyro = state.gyro;
  e.slipping = watch.slipping() || gyro.trouble == TurnTrouble::slip ||
               gyro.trouble == TurnTrouble::undecided;
  e.looks.clear();
  if (watch.looks() && !e.disagrees)
    e.looks.format("stands and looks whether the position drifts: %.2f m beside wheels and heading",
                   watch.gap_m);
  e.notice.clear();
  switch (gyro.trouble) {
    case TurnTrouble::none:
      if (!watch.slipping()) break;
      e.notice.format("wheels slip: %.2f m/s by wheels, %.2f m/s by receiver", watch.wheel_mps,
                      watch.receiver_mps);
      break;
    case TurnTrouble::slip:
      e.notice.format("wheels slip in the turn: %.1f degrees/s apart from the gyro",
                      to_deg(std::abs(gyro.apart_radps)));
      break;
    case TurnTrouble::gyro:
      e.notice.format("gyro not believed: %.1f degrees/s apart from wheels and receiver",
                      to_deg(std::abs(gyro.apart_radps)));
      break;
    case TurnTrouble::undecided:
      e.notice.format("gyro and wheels contradict each other: %.1f degrees/s apart",
                      to_deg(std::abs(gyro.apart_radps)));
      break;
    case TurnTrouble::pushed:
      e.notice.format("the base turns by %.1f degrees/s while its wheels stand",
                      to_deg(std::abs(gyro.apart_radps)));
      break;
  }
}

void Estimator::report_imu(const State& state, Time now) {
  Estimate& e = estimate_;
  const GyroTrack& gyro = state.gyro;
  const bool fresh = gyro.fresh(now, imu_stale_);
  e.roll_rad = fresh ? gyro.roll_rad : kAbsent;
  e.pitch_rad = fresh ? gyro.pitch_rad : kAbsent;
  const RestBias& at_rest = imus_[imu_in_use_].bias();
  if (at_rest.known()) e.gyro_bias_radps = at_rest.bias_radps();
  if (gyro.learned_s > 0) {
    e.gyro_bias_radps.z = state.belief.mean[kGyroBias];
    e.gyro_bias_sigma_radps = std::sqrt(state.belief.covariance[kGyroBias][kGyroBias]);
  }
}

double Estimator::reach_m(const State& state, Time now) const {
  const bool rtk = state.gnss.fixed != kNever && now - state.gnss.fixed < kFixed;
  if (rtk || !state.has_position || !state.has_heading) return kAbsent;
  const BodyMotion body = body_motion(base_, state.told, now, wheel_stale_);
  GyroMotion gyro = motion_of(state.gyro, state.belief, body, now, config_);
  // Standing wheels hold the heading themselves; driving on, the gyro would.
  gyro.known = state.gyro.believed() && state.gyro.fresh(now, imu_stale_);
  gyro.rate_radps = state.gyro.rate_radps;
  return metres_left(state.belief, doubt_of(state, config_), body, gyro, state.gnss.sigma_x_m,
                     state.gnss.sigma_y_m, config_);
}

}  // namespace drover::engine
