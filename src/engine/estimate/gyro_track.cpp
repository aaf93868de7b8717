#include "engine/estimate/gyro_track.h"

#include <algorithm>
#include <cmath>

#include "drover/angle.h"

namespace drover::engine::estimate {
namespace {

constexpr double kSlice_s = 0.1;
constexpr double kMemory_s = 2.0;  // over which turns are compared
constexpr double kGate = 3.5;      // sigmas of that comparison
// A gyro that shakes differently when the motors run has another bias by about this.
constexpr double kBiasFloor_radps = 0.0001;
constexpr double kRestNoise_radps = 0.0003;
// Slower turning with standing wheels may be a bias that is not known well yet.
constexpr double kPushed_radps = 0.02;
constexpr double kSameRate_radps = 0.01;
constexpr double kRelearned_radps = 0.003;
// Whom the receiver contradicts so many times more than the other one is wrong.
constexpr double kVote = 2.0;
constexpr double kVoteShare = 0.6;  // of what the two are apart must have reached the receiver
constexpr Duration kVoteFresh = std::chrono::milliseconds(500);
constexpr double kGainGate = 4.0;      // sigmas
constexpr double kGainLoosens = 0.05;  // when the gain is outside: perhaps the ground has changed
constexpr double kLongestPatience_s = 300;
constexpr double kJudgedTurn_rad = 0.002;

void forget_recent(GyroTrack& gyro) {
  gyro.apart_rad = gyro.white_rad2 = gyro.wheel_turn_rad = 0;
  gyro.recent_way_m = gyro.recent_s = 0;
}

void forget_slice(GyroTrack& gyro) {
  gyro.slice_s = gyro.turned_rad = gyro.rim_rad = gyro.way_m = 0;
  gyro.stood = true;
}

double bias_of(const GyroTrack& gyro, const Belief& belief) {
  return gyro.believed() ? belief.mean[kGyroBias] : gyro.doubted_bias_radps;
}

double pushed_radps(const Belief& belief) {
  return kPushed_radps + 3 * std::sqrt(belief.covariance[kGyroBias][kGyroBias]);
}

/// A slice of standing wheels: the rate is the bias, unless the base is turned by somebody.
void learn_at_rest(GyroTrack& gyro, Belief& belief, Time now, const EstimateConfig& config) {
  const double rate = gyro.turned_rad / gyro.slice_s;
  const double innovation = rate - belief.mean[kGyroBias];
  const double variance =
      square(config.imu_gyro_noise_rad) / gyro.slice_s + square(kRestNoise_radps);
  if (square(innovation) <=
      square(config.gate_sigma) * (belief.covariance[kGyroBias][kGyroBias] + variance)) {
    gyro.rest.accepted();
    gyro.learned_s += gyro.slice_s;
    Vector row{};
    row[kGyroBias] = 1;
    belief.correct(row, innovation, variance);
    belief.floor_variance(kGyroBias, square(kBiasFloor_radps));
    if (gyro.trouble != TurnTrouble::gyro) gyro.trouble = TurnTrouble::none;
    return;
  }
  if (!gyro.rest.running()) {  // this first slice was taken for rest
    const double turned_rad = innovation * gyro.slice_s;
    belief.mean[kYaw] = wrap_rad(belief.mean[kYaw] + turned_rad);
    belief.covariance[kYaw][kYaw] += square(turned_rad);
  }
  gyro.rest.refused(now, std::abs(rate - gyro.rest_radps) < kSameRate_radps);
  if (gyro.rest.new_place()) gyro.rest_radps = rate;
  if (gyro.trouble == TurnTrouble::none) gyro.trouble = TurnTrouble::pushed;
  gyro.apart_radps = innovation;
  if (!gyro.rest.settled(from_s(config.jump_time_s))) return;
  // Nobody turns a base so evenly: the bias has changed.
  belief.reset(kGyroBias, rate, kRelearned_radps);
  gyro.rest.accepted();
  if (gyro.trouble == TurnTrouble::pushed) gyro.trouble = TurnTrouble::none;
}

/// How far the sums may be apart, squared, when nothing is wrong.
double permitted_rad2(const GyroTrack& gyro, const Belief& belief, const TurnErrors& errors) {
  const Matrix& p = belief.covariance;
  return gyro.white_rad2 + square(errors.share * gyro.wheel_turn_rad) +
         square(errors.pull_radpm * gyro.recent_way_m) +
         p[kGyroBias][kGyroBias] * square(gyro.recent_s) +
         p[kGyroScale][kGyroScale] * square(gyro.wheel_turn_rad);
}

void doubt(GyroTrack& gyro, const Belief& belief) {
  gyro.trouble = TurnTrouble::gyro;
  gyro.agrees_since = kNever;
  gyro.doubted_bias_radps = belief.mean[kGyroBias] + gyro.apart_radps;
  gyro.contested_rad = 0;
  gyro.contested_since = kNever;
  forget_recent(gyro);
}

bool heard(const GyroTrack& gyro, Time now) {
  return gyro.heard != kNever && now - gyro.heard < kVoteFresh;
}

/// Whom the receiver's headings speak against; undecided without them.
TurnTrouble vote(const GyroTrack& gyro, Time now) {
  const double by_gyro = std::abs(gyro.gyro_residual_rad);
  const double by_wheels = std::abs(gyro.wheels_residual_rad);
  if (!heard(gyro, now) || std::max(by_gyro, by_wheels) < kVoteShare * std::abs(gyro.apart_rad)) {
    return TurnTrouble::undecided;
  }
  if (by_gyro > kVote * by_wheels) return TurnTrouble::gyro;
  return by_wheels > kVote * by_gyro ? TurnTrouble::slip : TurnTrouble::undecided;
}

/// What had been taken for the turn so far may be wrong by all that they are apart, and the place
/// beside the way with it.
void unsettle(const GyroTrack& gyro, Belief& belief) {
  const double aside_m = gyro.apart_rad * gyro.recent_way_m / 2;
  belief.covariance[kYaw][kYaw] += square(gyro.apart_rad);
  belief.covariance[kX][kX] += square(aside_m);
  belief.covariance[kY][kY] += square(aside_m);
}

/// They are too far apart: who is wrong?
void judge(GyroTrack& gyro, Belief& belief, Time now, double apart_rad) {
  gyro.apart_radps = gyro.apart_rad / std::max(gyro.recent_s, kSlice_s);
  const TurnTrouble guilty = vote(gyro, now);
  if (guilty == TurnTrouble::slip) {
    gyro.trouble = guilty;
    gyro.contested_since = kNever;
    gyro.contested_rad = 0;
    return;
  }
  if (guilty == TurnTrouble::gyro) {
    unsettle(gyro, belief);
    return doubt(gyro, belief);
  }
  gyro.trouble = TurnTrouble::undecided;
  if (gyro.contested_since == kNever) gyro.contested_since = now;
  // A receiver that gives headings will soon decide, and holds the heading meanwhile.
  if (heard(gyro, now) && now - gyro.contested_since < kVoteFresh) return;
  if (gyro.contested_rad == 0) {
    unsettle(gyro, belief);
    gyro.contested_rad = gyro.apart_rad;
    return;
  }
  const double before_rad = gyro.contested_rad;
  gyro.contested_rad += apart_rad;
  belief.covariance[kYaw][kYaw] +=
      std::max(square(gyro.contested_rad) - square(before_rad), square(apart_rad));
}

/// The gyro is not used; when it has agreed for long enough, with the bias it has now, it is again.
void watch_doubted(GyroTrack& gyro, Belief& belief, double apart_rad, bool agrees, Time now) {
  gyro.doubted_bias_radps += apart_rad / kMemory_s;
  if (!agrees || gyro.agrees_since == kNever) {
    gyro.agrees_since = now;
    if (!agrees) forget_recent(gyro);
    return;
  }
  if (now - gyro.agrees_since < from_s(gyro.patience_s)) return;
  belief.reset(kGyroBias, gyro.doubted_bias_radps, kRelearned_radps);
  gyro.trouble = TurnTrouble::none;
  gyro.agrees_since = kNever;
  gyro.patience_s = std::min(2 * gyro.patience_s, kLongestPatience_s);
}

/// The wheels' gain learns from a turn that the gyro has measured. Only the gain: wheels that
/// always pull to one side would bend the gyro's bias.
void learn_gain(GyroTrack& gyro, Belief& belief, double gyro_rad, double apart_rad, double white) {
  if (std::abs(gyro.rim_rad) < kJudgedTurn_rad) return;
  Matrix& p = belief.covariance;
  const double variance = white + p[kGyroBias][kGyroBias] * square(gyro.slice_s) +
                          p[kGyroScale][kGyroScale] * square(gyro_rad);
  const double expected = p[kGain][kGain] * square(gyro.rim_rad) + variance;
  if (square(apart_rad) > square(kGainGate) * expected) {
    p[kGain][kGain] += square(kGainLoosens);
    return;
  }
  Vector row{};
  row[kGain] = gyro.rim_rad;
  belief.correct(row, apart_rad, variance);
}

void compare(GyroTrack& gyro, Belief& belief, Time now, const EstimateConfig& config,
             const TurnErrors& errors) {
  const bool doubted = gyro.trouble == TurnTrouble::gyro;
  const double gyro_rad =
      belief.mean[kGyroScale] * (gyro.turned_rad - bias_of(gyro, belief) * gyro.slice_s);
  const double wheels_rad = belief.mean[kGain] * gyro.rim_rad;
  const double apart_rad = gyro_rad - wheels_rad;
  const double white = square(config.odometry_yaw_rad) * gyro.way_m +
                       square(config.turning_yaw_rad) * std::abs(wheels_rad) +
                       square(config.imu_gyro_noise_rad) * gyro.slice_s;
  const double keep = std::exp(-gyro.slice_s / kMemory_s);
  gyro.apart_rad = keep * gyro.apart_rad + apart_rad;
  gyro.white_rad2 = keep * keep * gyro.white_rad2 + white;
  gyro.wheel_turn_rad = keep * gyro.wheel_turn_rad + std::abs(wheels_rad);
  gyro.recent_way_m = keep * gyro.recent_way_m + gyro.way_m;
  gyro.recent_s = keep * gyro.recent_s + gyro.slice_s;
  const bool agrees =
      square(gyro.apart_rad) <= square(kGate) * permitted_rad2(gyro, belief, errors);
  if (doubted) return watch_doubted(gyro, belief, apart_rad, agrees, now);
  if (agrees) {
    gyro.trouble = TurnTrouble::none;
    gyro.contested_rad = 0;
    gyro.contested_since = kNever;
  } else {
    judge(gyro, belief, now, apart_rad);
  }
  if (gyro.believed()) learn_gain(gyro, belief, gyro_rad, apart_rad, white);
}

}  // namespace

GyroMotion motion_of(const GyroTrack& gyro, const Belief& belief, const BodyMotion& body, Time now,
                     const EstimateConfig& config) {
  GyroMotion motion;
  if (!gyro.believed() || !gyro.fresh(now, from_s(config.imu_stale_s))) return motion;
  motion.rate_radps = gyro.rate_radps;
  motion.known = true;
  if (!body.standing) return motion;
  // Standing wheels hold the heading better than a gyro, as long as nobody lifts them.
  const double threshold_radps =
      pushed_radps(belief) + 4 * config.imu_gyro_noise_rad / std::sqrt(kSlice_s);
  motion.pushed =
      std::abs(gyro.rate_radps - belief.mean[kGyroBias]) > threshold_radps && gyro.rest.running();
  motion.known = motion.pushed;
  return motion;
}

void follow_turn(GyroTrack& gyro, Belief& belief, const BodyMotion& body, Time now, double dt_s,
                 const EstimateConfig& config, const TurnErrors& errors) {
  if (!gyro.fresh(now, from_s(config.imu_stale_s)) || !body.known) {
    forget_slice(gyro);
    forget_recent(gyro);
    gyro.heard = kNever;
    if (gyro.believed()) gyro.trouble = TurnTrouble::none;
    gyro.contested_rad = 0;
    gyro.contested_since = kNever;
    return;
  }
  const double rim_rad = body.twist.wz_radps * dt_s;
  gyro.gyro_since_rad += belief.mean[kGyroScale] * (gyro.rate_radps - bias_of(gyro, belief)) * dt_s;
  gyro.wheels_since_rad += belief.mean[kGain] * rim_rad;
  gyro.slice_s += dt_s;
  gyro.turned_rad += gyro.rate_radps * dt_s;
  gyro.rim_rad += rim_rad;
  gyro.way_m += std::abs(belief.mean[kScale] * body.twist.vx_mps) * dt_s;
  gyro.stood = gyro.stood && body.standing;
  if (gyro.slice_s < kSlice_s) return;
  if (gyro.stood && gyro.trouble != TurnTrouble::gyro) {
    forget_recent(gyro);
    learn_at_rest(gyro, belief, now, config);
  } else {
    compare(gyro, belief, now, config, errors);
  }
  forget_slice(gyro);
}

void hear_heading(GyroTrack& gyro, double yaw_rad, Time at) {
  if (gyro.heard != kNever && at - gyro.heard < kVoteFresh) {
    const double turned_rad = wrap_rad(yaw_rad - gyro.heading_rad);
    const double keep = std::exp(-to_s(at - gyro.heard) / kMemory_s);
    gyro.gyro_residual_rad = keep * gyro.gyro_residual_rad + turned_rad - gyro.gyro_since_rad;
    gyro.wheels_residual_rad = keep * gyro.wheels_residual_rad + turned_rad - gyro.wheels_since_rad;
  } else {
    gyro.gyro_residual_rad = gyro.wheels_residual_rad = 0;
  }
  gyro.gyro_since_rad = gyro.wheels_since_rad = 0;
  gyro.heading_rad = yaw_rad;
  gyro.heard = at;
}

}  // namespace drover::engine::estimate
