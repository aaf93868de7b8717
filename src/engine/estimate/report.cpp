// What a state of the estimate means, in the words and bounds that the others use.
#include <algorithm>
#include <cmath>

#include "engine/estimate/contradictions.h"
#include "engine/estimate/estimator.h"

namespace drover::engine {

using namespace estimate;

namespace {

constexpr Duration kReachEach = std::chrono::milliseconds(100);
// An RTK fix this young is what the place rests on, not dead reckoning.
constexpr Duration kFixed = std::chrono::milliseconds(500);
// Wheels that are worn, or sink in, are told from so much on; and from so many sigmas.
constexpr double kOtherScale = 0.025;
constexpr double kCertainScale = 4.0;

}  // namespace

void Estimator::report(const State& state, Time now) {
  const Contradictions between = contradictions_of(state, from_s(config_.jump_time_s), now);
  report_motion(state, now);
  report_errors(state, between, now);
  report_trouble(state, between, now);
  report_unseen(state);
  report_imu(state, now);
  report_learned(state, now);
  report_kept(state);
  if (reach_at_ == kNever || now - reach_at_ >= kReachEach || now < reach_at_) {
    reach_at_ = now;
    estimate_.metres_left = reach_m(state, now);
  }
}

void Estimator::report_motion(const State& state, Time now) {
  Estimate& e = estimate_;
  const Belief& belief = state.belief;
  const BodyMotion body = body_motion(base_, state.told, now, wheel_stale_);
  const GyroMotion gyro = motion_of(state.gyro, belief, body, now, config_);
  e.has_position = state.has_position;
  e.has_heading = state.has_heading;
  e.pose.time = now;
  e.pose.x_m = belief.mean[kX];
  e.pose.y_m = belief.mean[kY];
  e.pose.yaw_rad = belief.mean[kYaw];
  e.pose.vx_mps = belief.mean[kScale] * body.twist.vx_mps;
  e.pose.vy_mps = belief.mean[kScale] * body.twist.vy_mps;
  e.pose.wz_radps = gyro.known
                        ? belief.mean[kGyroScale] * (gyro.rate_radps - belief.mean[kGyroBias])
                        : belief.mean[kGain] * body.twist.wz_radps;
  // Or the heading is held by wheels that stand beside one.
  e.gyro_used = gyro.known || (body.standing && state.gyro.fresh(now, imu_stale_));
  e.body = body;
  e.fastest_mps = fastest_mps(base_, body.twist);
  e.yaw_slip_factor = 1.0 / belief.mean[kGain];
  const bool fixed = state.gnss.fixed != kNever && now - state.gnss.fixed < kFixed;
  const bool told = state.heading.last != kNever && now - state.heading.last < kHeadingTold;
  e.way_heals = fixed && state.has_heading && !told;
  e.shoved = state.shove.ended;
  e.shoved_m = state.shove.left_m;
}

/// Only beside a sensor that would tell a tilt, which looks the same.
bool Estimator::arm_wrong(const State& state, Time now) const {
  return state.fit.arm_wrong() && state.gyro.fresh(now, imu_stale_) &&
         std::isfinite(state.gyro.roll_rad);
}

void Estimator::report_learned(const State& state, Time now) {
  Estimate& e = estimate_;
  const bool told = state.heading.last != kNever;
  e.mounting_known = told && state.mounting.known(config_);
  e.mounting_rad = told ? -state.mounting.applied_rad : kAbsent;
  e.mounting_sigma_rad = told ? state.mounting.sigma_rad(config_) : kAbsent;
  e.late_s = state.fit.late_known() ? state.fit.late_s() : kAbsent;
  e.heading_late_s = state.heading_late.known() ? state.heading_late.late_s() : kAbsent;
  const bool wrong = arm_wrong(state, now);
  e.arm_ahead_m = wrong ? state.fit.ahead_m() : kAbsent;
  e.arm_left_m = wrong ? state.fit.left_m() : kAbsent;
  const bool unknown = !wrong && !state.fit.arm_right(config_);
  e.arm_unknown_m = unknown ? state.fit.arm_doubt_m(2, config_) : kAbsent;
  const double scale = state.belief.mean[kScale];
  const double scale_sigma = std::sqrt(state.belief.covariance[kScale][kScale]);
  const bool other_wheels =
      std::abs(scale - 1) > std::max(kCertainScale * scale_sigma, kOtherScale);
  e.wheel_scale = other_wheels ? scale : kAbsent;
}

/// Motion is not decided by it, but for how far it leads aside of the track: where it goes straight
/// on the robot is behind of where it thinks, on the same line.
void Estimator::report_unseen(const State& state) {
  Estimate& e = estimate_;
  const UnseenWay& unseen = state.unseen;
  if (!state.has_position) return;
  e.unbelieved_x_m = state.gnss.unbelieved.east_m;
  e.unbelieved_y_m = state.gnss.unbelieved.north_m;
  e.unbelieved_error_m = state.gnss.unbelieved_m;
  e.unseen_way_m = unseen.way_m;
  e.unseen_aside_m = config_.unseen_slip_share * unseen.aside_m(e.pose.yaw_rad);
  e.unseen_slip_m = config_.unseen_slip_share * unseen.way_m;
  e.unseen_ahead_m = config_.unseen_slip_share * unseen.against_m(e.pose.yaw_rad);
  e.unseen_behind_m = config_.unseen_slip_share * unseen.in_m(e.pose.yaw_rad);
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
  return metres_left(state.belief, state.doubt(config_), body, gyro, state.gnss.sigma_x_m,
                     state.gnss.sigma_y_m, config_);
}

}  // namespace drover::engine
