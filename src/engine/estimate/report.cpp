// What a state of the estimate means, in the words and bounds that the others use.
#include <algorithm>
#include <cmath>

#include "drover/angle.h"
#include "engine/estimate/antenna_tilt.h"
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
// Another integer solution that was taken for the place of a base at rest may last so long.
constexpr Duration kMayStepBack = std::chrono::seconds(60);
// Wheels that are worn, or sink in, are told from so much on; and from so many sigmas.
constexpr double kOtherScale = 0.025;
constexpr double kCertainScale = 4.0;
// A receiver that does not tell how well it knows (GST) may be as bad as this beside its class.
constexpr double kUntold_m = 0.019;

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
  e.pose.vy_mps = belief.mean[kScale] * body.twist.vy_mps;
  const GyroMotion gyro = motion_of(state.gyro, belief, body, now, config_);
  e.gyro_used = gyro.known || (body.standing && state.gyro.fresh(now, imu_stale_));
  e.pose.wz_radps = gyro.known
                        ? belief.mean[kGyroScale] * (gyro.rate_radps - belief.mean[kGyroBias])
                        : belief.mean[kGain] * body.twist.wz_radps;
  e.body = body;
  e.fastest_mps = fastest_mps(base_, body.twist);
  e.yaw_slip_factor = 1.0 / belief.mean[kGain];

  const HeadingDoubt doubt = doubt_of(state, config_);
  // Until it is known how late positions are, the place along the way is not well known.
  const double speed_mps = std::hypot(e.pose.vx_mps, e.pose.vy_mps);
  const double late_m = speed_mps * state.fit.late_sigma_s();
  const double untold_m = state.gnss.told_sigma ? 0.0 : kUntold_m;
  const double tilt_m = state.gnss.guessed_m;
  const double two_sigma_m =
      std::hypot(std::hypot(doubt.two_sigma_m(belief), 2 * tilt_m), 2 * late_m, 2 * untold_m);
  const double two_sigma_rad = doubt.two_sigma_rad(belief);
  e.pose.position_sigma_m = state.has_position ? two_sigma_m / 2 : kAbsent;
  const double told_rad = std::hypot(two_sigma_rad / 2, state.mount_left_rad());
  e.pose.yaw_sigma_rad = state.has_heading ? told_rad : kAbsent;
  e.predicted_error_m = state.has_position ? two_sigma_m : kAbsent;
  const double late_doubt_m = speed_mps * state.fit.late_doubt_s();
  const double unmeasured_m =
      unmeasured_sigma_m(state.gyro, antenna_of(config_, state.gnss.receiver));
  const double sure_m = kSure * std::hypot(std::hypot(doubt.two_sigma_m(belief),
                                                      2 * std::hypot(tilt_m, unmeasured_m)),
                                           2 * late_doubt_m, 2 * untold_m);
  // An arm that is told to be wrong comes on top of it, in report_learned.
  const bool tilt_seen = state.gyro.fresh(now, imu_stale_) && std::isfinite(state.gyro.roll_rad);
  const bool arm_told = state.fit.arm_wrong() && tilt_seen;
  const double arm_m = arm_told ? 0.0 : state.fit.arm_doubt_m(2 * kSure, config_);
  const double bound_m = std::hypot(sure_m, arm_m);
  e.error_bound_m = state.has_position ? bound_m : kAbsent;
  e.yaw_error_rad = state.has_heading ? two_sigma_rad : kAbsent;

  const bool fixed = state.gnss.fixed != kNever && now - state.gnss.fixed < kFixed;
  const bool told = state.heading.last != kNever && now - state.heading.last < kHeadingTold;
  e.way_heals = fixed && state.has_heading && !told;

  report_trouble(state, now);
  report_unseen(state, bound_m);
  report_imu(state, now);
  report_learned(state);
  report_kept(state);
  e.shoved = state.shove.ended;
  e.shoved_m = state.shove.left_m;
  if (reach_at_ == kNever || now - reach_at_ >= kReachEach || now < reach_at_) {
    reach_at_ = now;
    e.metres_left = reach_m(state, now);
  }
}

void Estimator::report_learned(const State& state) {
  Estimate& e = estimate_;
  const bool told = state.heading.last != kNever;
  e.mounting_known = told && state.mounting.known(config_);
  e.mounting_rad = told ? -state.mounting.applied_rad : kAbsent;
  e.mounting_sigma_rad = told ? state.mounting.sigma_rad(config_) : kAbsent;
  e.late_s = state.fit.late_known() ? state.fit.late_s() : kAbsent;
  e.heading_late_s = state.heading_late.known() ? state.heading_late.late_s() : kAbsent;
  const bool arm_wrong = state.fit.arm_wrong() && std::isfinite(e.roll_rad);
  e.arm_ahead_m = arm_wrong ? state.fit.ahead_m() : kAbsent;
  e.arm_left_m = arm_wrong ? state.fit.left_m() : kAbsent;
  const bool arm_unknown = !arm_wrong && !state.fit.arm_right(config_);
  e.arm_unknown_m = arm_unknown ? state.fit.arm_doubt_m(2, config_) : kAbsent;
  const double scale = state.belief.mean[kScale];
  const double scale_sigma = std::sqrt(state.belief.covariance[kScale][kScale]);
  const bool other_wheels =
      std::abs(scale - 1) > std::max(kCertainScale * scale_sigma, kOtherScale);
  e.wheel_scale = other_wheels ? scale : kAbsent;
  if (!arm_wrong || !state.has_position) return;
  const double off_m = std::hypot(e.arm_ahead_m, e.arm_left_m);
  e.predicted_error_m = std::max(e.predicted_error_m, off_m);
  e.own_error_m = std::max(e.own_error_m, off_m);
  e.error_bound_m += off_m;
}

void Estimator::report_trouble(const State& state, Time now) {
  Estimate& e = estimate_;
  const Duration patience = from_s(config_.jump_time_s);
  const MotionWatch& watch = state.watch;
  const JumpWatch& places = state.gnss.jumps;
  const JumpWatch& headings = state.heading.jumps;
  const Dispute& dispute = state.gnss.dispute;
  const bool disputed = dispute.holds() && now - dispute.since() >= patience;
  const bool position_disagrees = disputed || places.disagrees(patience);
  const bool heading_disagrees = headings.disagrees(patience);
  const bool stuck = watch.stuck(now, patience);
  const bool drifted = watch.drifted;
  e.disagrees = position_disagrees || heading_disagrees || stuck || drifted;
  e.disputed = e.disagrees && !stuck && !drifted && (!position_disagrees || disputed) &&
               (!heading_disagrees || headings.began_moving());
  e.place_doubted = disputed || drifted;
  e.heading_doubted = heading_disagrees;
  e.elsewhere_m = state.gnss.unconfirmed_m;
  e.renewed = state.gnss.renewed;
  e.found = state.gnss.found;
  e.decided_at = disputed ? dispute.decided_at() : kNever;
  e.slipped_m = watch.slipping() ? watch.slipped_m + std::abs(watch.last_gap_m) : 0;
  // One of the two is wrong, and nobody knows which: the error may be all that lies between them.
  if (state.has_position) {
    const double gap_m = watch.slipping() ? std::abs(watch.last_gap_m) : 0;
    e.own_error_m = std::max(e.predicted_error_m, gap_m);
    double apart_m = 0;
    if (places.disagrees(kContradicted)) apart_m = state.gnss.contradiction_m;
    // Positions that led dead reckoning meanwhile may have wandered themselves.
    if (dispute.holds() && now - dispute.since() >= kContradicted)
      apart_m = dispute.apart_m() + dispute.led_aside_m(e.pose.yaw_rad);
    if (drifted) apart_m = std::max(apart_m, watch.drift_m);
    e.predicted_error_m = std::max(e.own_error_m, apart_m);
    // Less than that is no contradiction, but may well be the beginning of one.
    if (dispute.holds()) apart_m = std::max(apart_m, dispute.apart_m() + dispute.led_m());
    apart_m = std::max(apart_m, gap_m);
    if (places.running()) apart_m = std::max(apart_m, state.gnss.contradiction_m);
    if (state.gnss.replaced != kNever && now - state.gnss.replaced < kMayStepBack)
      apart_m = std::max(apart_m, state.gnss.replaced_m);
    apart_m = std::max({apart_m, state.gnss.unconfirmed_m, watch.stayed_m});
    e.elsewhere_m = watch.looks() ? std::max(watch.gap_m, apart_m) : apart_m;
    e.error_bound_m += std::max(watch.gap_m, apart_m);
  }
  // Gyro and wheels, which agree, vote a heading out that jumped.
  const bool voted = e.gyro_used && state.gyro.trouble == TurnTrouble::none;
  if (headings.disagrees(kContradicted) && state.has_heading && !voted)
    e.yaw_error_rad = std::max(e.yaw_error_rad, state.heading.contradiction_rad);
  if (stuck) {
    e.reason.format("wheels slip or the receiver is stuck: %.2f m/s by wheels, %.2f by receiver",
                    watch.wheel_mps, watch.receiver_mps);
  } else if (position_disagrees) {
    e.reason = "position disagrees with odometry";
    if (disputed)
      e.reason.format(
          "position disagrees with odometry by %.2f m; if the map shows the robot where it stands: "
          "drover position accept",
          dispute.apart_m() + dispute.led_m());
  } else if (heading_disagrees) {
    e.reason = "heading disagrees with odometry";
    if (headings.began_moving())
      e.reason.format("heading disagrees with odometry: %.0f degrees beside %s",
                      to_deg(state.heading.contradiction_rad),
                      e.gyro_used ? "gyro and wheels" : "wheels");
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
    e.looks.format("stands and looks whether the position drifts: %.2f m %s",
                   watch.look.along ? watch.unseen_slip_m : watch.gap_m,
                   watch.look.along ? "apart from the wheels along the way, which may have slipped"
                                    : "beside wheels and heading");
  e.notice.clear();
  switch (gyro.trouble) {
    case TurnTrouble::none:
      if (e.disputed) e.notice = e.reason;
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

/// Motion is not decided by it, but for how far it leads aside of the track: where it goes straight
/// on the robot is behind of where it thinks, on the same line.
void Estimator::report_unseen(const State& state, double known_m) {
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
  e.error_bound_m = known_m + std::hypot(e.error_bound_m - known_m, e.unseen_slip_m);
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
