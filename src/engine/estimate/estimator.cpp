#include "engine/estimate/estimator.h"

#include <algorithm>
#include <cmath>

#include "drover/angle.h"
#include "engine/estimate/antenna_learning.h"
#include "engine/estimate/antenna_tilt.h"
#include "engine/estimate/model_gnss.h"
#include "engine/estimate/model_heading.h"

namespace drover::engine {
namespace {

using namespace estimate;

// Longest stretch predicted at once: the arc of a step is taken as its chord.
constexpr Duration kLongestStep = std::chrono::milliseconds(20);
// A sensor that was away comes back with another bias.
constexpr Duration kGyroAway = std::chrono::seconds(1);
constexpr double kGyroReturn_radps = 0.001;
constexpr std::size_t kOutward =
    kMaxOfKind;                      // whoever is in use: the antenna that others count from
constexpr double kInstant_s = 0.05;  // how well the instants of two receivers are known
constexpr double kStands = 0.5;      // cosine of a pitch of 60 degrees
constexpr double kHeadingGap_s = 1.5;
// Somebody pushes it, or its wheels are not heard: so fast it comes to other ground.
constexpr double kMovedUnheard_mps = 0.5;
// No place changes these.
constexpr std::array<std::size_t, 4> kCarried{kGain, kScale, kGyroBias, kGyroScale};

/// The map is level and the ground may not be: of the way only what is horizontal counts. The turn
/// goes about the base's own z; on ground that is even under the base, and so turns it neither
/// about x nor y, it is this much about the vertical: more facing up or down, less across.
BodyMotion level_motion(const State& state, BodyMotion motion, Duration imu_stale) {
  if (!state.gyro.fresh(state.time, imu_stale)) return motion;
  const double level = std::cos(state.gyro.pitch_rad);
  motion.twist.vx_mps *= level;
  motion.twist.vy_mps *= std::cos(state.gyro.roll_rad);
  // A robot that tips over tells nothing of a turn about the vertical.
  if (level > kStands) motion.twist.wz_radps *= std::cos(state.gyro.roll_rad) / level;
  return motion;
}

Time next_stale(const GyroTrack& gyro, Time now, Duration stale) {
  return gyro.fresh(now, stale) ? gyro.at + stale + Duration{1} : Time::max();
}

}  // namespace

Estimator::Estimator(const EstimateConfig& config, const BaseConfig& base)
    : config_(tuned(kinematics_of(base), config)),
      base_(kinematics_of(base)),
      joints_(joints_of(base_)),
      joint_count_(joints_needed(base)),
      first_gain_(1.0 / base.yaw_slip_factor),
      wheel_stale_(from_s(config.wheel_stale_s)),
      imu_stale_(from_s(config.imu_stale_s)),
      max_delay_(from_s(config.max_measurement_delay_s)),
      imus_{ImuIntake(kSlot), ImuIntake(kSlot), ImuIntake(kSlot), ImuIntake(kSlot)} {
  static_assert(kMaxOfKind == 4);
  history_.restart(blank());
}

State Estimator::blank() const {
  State state;
  state.fit = AntennaFit(config_);
  state.heading_late = HeadingLate(config_);
  state.belief.reset(kGain, first_gain_, config_.yaw_slip_sigma);
  state.belief.reset(kScale, 1.0, config_.wheel_scale_sigma);
  state.belief.reset(kGyroBias, 0.0, config_.imu_gyro_bias_sigma_radps);
  state.belief.reset(kGyroScale, 1.0, config_.imu_gyro_scale_sigma);
  return state;
}

/// The base does not move because somebody counts from elsewhere: its place is told anew, with all
/// that is known of it. North is north in both frames (a kilometre turns it by less than 0.01
/// degrees).
State Estimator::carried_over(const State& old, const GeodeticPoint& origin) const {
  const Pose pose{.x_m = old.belief.mean[kX], .y_m = old.belief.mean[kY], .yaw_rad = 0};
  LocalFrame there;
  there.set_origin(origin);
  const PathPoint place =
      there.local(frame_.geodetic({pose.x_m, pose.y_m}, frame_.origin().altitude_m));
  State state = old;
  state.belief.mean[kX] = place.x_m;
  state.belief.mean[kY] = place.y_m;
  // What compares places with earlier ones begins anew.
  state.gnss.jumps = {};
  state.gnss.dispute = {};
  state.heading.jumps = {};
  state.watch.forget();
  state.course = {};
  state.fit.pause();
  return state;
}

void Estimator::set_origin(const GeodeticPoint& origin) {
  replay();
  const State& old = history_.before(history_.size());
  if (frame_.has_origin() && old.has_position && old.has_heading && !estimate_.disagrees) {
    history_.restart(carried_over(old, origin));
    frame_.set_origin(origin);
    return;
  }
  State state = blank();
  state.time = old.time;
  state.told = old.told;
  state.standing_since = old.standing_since;
  state.refused = old.refused;
  state.broken = old.broken;
  state.gyro = old.gyro;
  state.gnss.unconfirmed_m = old.gnss.unconfirmed_m;
  state.gnss.unbelieved = old.gnss.unbelieved;
  state.gnss.unbelieved_m = old.gnss.unbelieved_m;
  state.heading.receiver = old.heading.receiver;
  state.mounting = old.mounting;
  state.fit = old.fit;
  state.fit.pause();
  state.late_s = old.late_s;
  state.heading_late = old.heading_late;
  state.heading_late.pause();
  for (const std::size_t i : kCarried) {
    state.belief.reset(i, old.belief.mean[i], std::sqrt(old.belief.covariance[i][i]));
  }
  history_.restart(state);
  frame_.set_origin(origin);
}

void Estimator::accept_position() {
  replay();
  State state = history_.before(history_.size());
  state.has_position = false;
  state.gnss.jumps = {};
  state.gnss.dispute = {};
  state.gnss.fixed = kNever;
  state.gnss.unconfirmed_m = 0;
  state.gnss.unbelieved = {};
  state.gnss.unbelieved_m = 0;
  state.gnss.replaced = kNever;
  state.watch = {};
  state.course = {};
  // One that only the gyro carries on is kept: nothing else tells it.
  const bool told = state.heading.last != kNever && state.time - state.heading.last < kHeadingTold;
  state.has_heading = state.has_heading && !told;
  state.heading.jumps = {};
  history_.restart(state);
}

void Estimator::recall_elsewhere(double away_m) {
  replay();
  State state = history_.before(history_.size());
  state.gnss.unconfirmed_m = std::max(state.gnss.unconfirmed_m, away_m);
  history_.restart(state);
}

bool Estimator::has_origin() const {
  return frame_.has_origin();
}
const GeodeticPoint& Estimator::origin() const {
  return frame_.origin();
}
PathPoint Estimator::local(const GeodeticPoint& point) const {
  return frame_.local(point);
}

GeodeticPoint Estimator::antenna_geodetic(const Pose& pose) const {
  const double c = std::cos(pose.yaw_rad);
  const double s = std::sin(pose.yaw_rad);
  // Of a level base, whatever the ground: the same pose is found again from a stored position.
  const LeverArm arm = lever_arm(0, 0, antenna_of(config_, kOutward));
  return frame_.geodetic({.x_m = pose.x_m + arm.ahead_m * c - arm.left_m * s,
                          .y_m = pose.y_m + arm.ahead_m * s + arm.left_m * c},
                         altitude_m_);
}

EstimatorCounters Estimator::counters() const {
  EstimatorCounters counters = counters_;
  counters.refused = history_.before(history_.dirty()).refused;
  counters.broken = history_.before(history_.dirty()).broken;
  return counters;
}

/// The estimate is taken back to the instant of the position, by its speed.
Apart Estimator::apart(const GnssPosition& position, std::uint8_t receiver, Time time) const {
  Apart apart;
  const GnssClass quality = class_of(position, config_);
  const Pose& pose = estimate_.pose;
  if (!frame_.has_origin() || !estimate_.has_position || !estimate_.has_heading ||
      quality == GnssClass::none || estimate_.disagrees)
    return apart;
  const PathPoint there =
      frame_.local({.latitude_deg = position.latitude_deg,
                    .longitude_deg = position.longitude_deg,
                    .altitude_m = position.altitude_msl_m + position.undulation_m});
  const TiltedArm tilted = tilted_arm(history_.before(history_.dirty()).gyro, pose.yaw_rad,
                                      antenna_of(config_, receiver), config_);
  const LeverArm& arm = tilted.arm;
  const double age_s = to_s(pose.time - time);
  const double yaw_rad = pose.yaw_rad - pose.wz_radps * age_s;
  const double ahead_m = arm.ahead_m - pose.vx_mps * age_s;
  const double left_m = arm.left_m - pose.vy_mps * age_s;
  const double c = std::cos(yaw_rad);
  const double s = std::sin(yaw_rad);
  apart.known = true;
  apart.m = std::hypot(there.x_m - pose.x_m - ahead_m * c + left_m * s,
                       there.y_m - pose.y_m - ahead_m * s - left_m * c);
  const double own_m = std::max(sigma_m(quality, position.sigma_east_m, config_),
                                sigma_m(quality, position.sigma_north_m, config_));
  apart.permitted_m =
      config_.gate_sigma * std::hypot(std::hypot(own_m, tilted.guessed_m), pose.position_sigma_m,
                                      std::hypot(arm.ahead_m, arm.left_m) * pose.yaw_sigma_rad) +
      std::hypot(pose.vx_mps, pose.vy_mps) * kInstant_s;
  return apart;
}

/// Inputs stamped after `now` happened now at the latest. They are the newest ones.
void Estimator::clamp_future(Time now) {
  std::size_t i = history_.size();
  while (i > 0 && history_.at(i - 1).time > now) --i;
  if (i == history_.size()) return;
  history_.mark_dirty(i);
  for (; i < history_.size(); ++i) {
    history_.at(i).time = now;
    // Of one instant now: sorted by kind, the earlier stamp first.
    for (std::size_t k = i; k > 0 && history_.out_of_order(k); --k) history_.swap_back(k);
  }
}

/// Computes the states after all inputs that have none yet.
void Estimator::replay() {
  for (std::size_t i = history_.dirty(); i < history_.size(); ++i) {
    Entry& entry = history_.at(i);
    entry.after = history_.before(i);
    advance(entry.after, entry.time);
    take(entry.after, entry.input);
  }
  history_.mark_clean();
}

void Estimator::advance(State& state, Time to) const {
  if (state.time == kNever) state.time = to;
  // After a long silence of everything, coarser steps: bounded work matters more there.
  const Duration longest = std::max(kLongestStep, (to - state.time) / 256);
  while (state.time < to) {
    BodyMotion body = body_motion(base_, state.told, state.time, wheel_stale_);
    body = level_motion(state, body, imu_stale_);
    if (!body.standing) {
      body.vx_var += square(state.watch.slip_mps());
      if (goes_sideways(body.twist)) body.vy_var += square(state.watch.slip_mps());
    }
    const GyroMotion gyro = motion_of(state.gyro, state.belief, body, state.time, config_);
    if (!body.standing || gyro.pushed) {
      state.standing_since = kNever;
    } else if (state.standing_since == kNever) {
      state.standing_since = state.time;
    }
    const Time until =
        std::min({to, state.time + longest, next_stale(state.told, state.time, wheel_stale_),
                  next_stale(state.gyro, state.time, imu_stale_)});
    const double dt_s = to_s(until - state.time);
    reckon(state, body, gyro, dt_s);
    count_unseen_tilt(state, body, dt_s);
    state.time = until;
    follow_turn(state.gyro, state.belief, body, state.time, dt_s, config_, turn_errors(base_));
    if (state.belief.covariance[kYaw][kYaw] > kLostYaw_rad * kLostYaw_rad) {
      state.has_heading = false;
      state.belief.reset(kYaw, state.belief.mean[kYaw], kLostYaw_rad);
    }
  }
}

/// How far the ground may have changed since the sensor of the tilt was heard. It may have been
/// silent for the moment in which it is still taken as fresh.
void Estimator::count_unseen_tilt(State& state, const BodyMotion& body, double dt_s) const {
  if (state.standing_since != kNever) return;
  GyroTrack& gyro = state.gyro;
  const double mps = body.known ? fastest_mps(base_, body.twist) : 0.0;
  gyro.tilt_unseen_m += (std::isfinite(mps) && mps > 0 ? mps : kMovedUnheard_mps) * dt_s;
  if (gyro.fresh(state.time, imu_stale_)) return;
  gyro.tilt_guessed = true;
  gyro.tilt_unseen_s += dt_s;
}

/// Predicts, and tells those who compare the way with the receiver's.
void Estimator::reckon(State& state, const BodyMotion& body, const GyroMotion& gyro,
                       double dt_s) const {
  Belief& belief = state.belief;
  const double x_m = belief.mean[kX];
  const double y_m = belief.mean[kY];
  predict(belief, body, dt_s, state.has_heading, state.gnss.sigma_x_m, state.gnss.sigma_y_m,
          config_, gyro);
  if (state.has_heading && state.gyro.fresh(state.time, imu_stale_)) {
    const double turning_mps2 = body.twist.vx_mps * gyro.rate_radps;
    // Who goes aside by himself is shoved by nobody, however that begins and ends.
    const bool drives = body.known && !body.standing && !gyro.pushed && !goes_sideways(body.twist);
    follow(state.shove, belief, state.gyro.left_mps2 - turning_mps2, dt_s,
           drives && !state.gyro.rocks, state.time);
  }
  const double east_m = belief.mean[kX] - x_m;
  const double north_m = belief.mean[kY] - y_m;
  state.reckoned.east_m += east_m;
  state.reckoned.north_m += north_m;
  if (!body.standing) state.unseen.advance(east_m, north_m);
  state.gnss.dispute.advance(east_m, north_m);
  state.gnss.corrected_way_m += std::hypot(east_m, north_m);
  if (!body.known || gyro.pushed) {
    state.way_unknown = true;
    state.fit.pause();
    state.watch.lose();
    state.course = {};
    return;
  }
  // Roll is positive with the left side up.
  const double slope_rad = state.gyro.fresh(state.time, imu_stale_) ? state.gyro.roll_rad : kAbsent;
  const double crab_rad =
      state.has_heading ? state.watch.crab_rad(belief.mean[kYaw], slope_rad) : 0;
  belief.mean[kX] -= crab_rad * north_m;
  belief.mean[kY] += crab_rad * east_m;
  const double way_m = belief.mean[kScale] * body.twist.vx_mps * dt_s;
  const double in_all_m = std::hypot(way_m, belief.mean[kScale] * body.twist.vy_mps * dt_s);
  const double turn_rad =
      gyro.known ? belief.mean[kGyroScale] * (gyro.rate_radps - belief.mean[kGyroBias]) * dt_s
                 : belief.mean[kGain] * body.twist.wz_radps * dt_s;
  if (state.has_heading) {
    state.fit.advance(east_m, north_m, in_all_m, std::abs(turn_rad));
    // How late positions are shows by the speed ahead alone.
    if (goes_sideways(body.twist)) state.fit.pause();
    state.watch.advance({.east_m = east_m,
                         .north_m = north_m,
                         .way_m = in_all_m,
                         .turn_rad = std::abs(turn_rad),
                         .slope_rad = slope_rad},
                        crab_rad);
  } else if (goes_sideways(body.twist)) {
    state.course = {};
  } else {
    state.course.advance(way_m, turn_rad);
  }
}

/// Another sensor has another zero and another scale; of its zero it is known what it showed at
/// rest.
void Estimator::hand_over_gyro(State& state, const TurnRate& turn) const {
  const bool known = std::isfinite(turn.rest_bias_sigma);
  GyroTrack gyro;
  gyro.source = turn.source;
  gyro.learned_s = known ? 1 : 0;
  state.gyro = gyro;
  state.belief.reset(kGyroBias, known ? turn.rest_bias_radps : 0.0,
                     known ? std::hypot(turn.rest_bias_sigma, kGyroReturn_radps)
                           : config_.imu_gyro_bias_sigma_radps);
  state.belief.reset(kGyroScale, 1.0, config_.imu_gyro_scale_sigma);
}

void Estimator::take_rates(State& state, const MotionInput& input) const {
  if (input.present.any()) state.told.joints.resize(joint_count_);
  for (std::size_t i = 0; i < input.joints_radps.size(); ++i) {
    if (input.present[i]) state.told.joints[i] = {input.joints_radps[i], state.time};
  }
  if (input.body) {
    state.told.body = *input.body;
    state.told.body_at = state.time;
  }
  if (!input.turn) return;
  GyroTrack& gyro = state.gyro;
  if (input.turn->source != gyro.source) hand_over_gyro(state, *input.turn);
  if (gyro.at != kNever && state.time - gyro.at > kGyroAway) {
    state.belief.floor_variance(kGyroBias, kGyroReturn_radps * kGyroReturn_radps);
  }
  gyro.rate_radps = input.turn->radps;
  if (!input.turn->saturated) {  // then it kept the tilt that it had
    gyro.roll_rad = input.turn->roll_rad;
    gyro.pitch_rad = input.turn->pitch_rad;
    gyro.tilt_known = true;
    gyro.tilt_yaw_rad = state.belief.mean[kYaw];
    gyro.tilt_unseen_m = gyro.tilt_unseen_s = 0;
    gyro.tilt_guessed = false;
  }
  gyro.left_mps2 = input.turn->left_mps2;
  gyro.rocks = input.turn->rocks;
  gyro.at = input.turn->saturated ? kNever : state.time;
}

/// A heading as it would have been told without delay.
double Estimator::in_time(State& state, double told_rad) const {
  HeadingLate& late = state.heading_late;
  const GyroTrack& gyro = state.gyro;
  const bool believed = gyro.believed() && gyro.trouble == TurnTrouble::none &&
                        gyro.fresh(state.time, imu_stale_) && gyro.learned_s > 0;
  if (!believed) {
    late.pause();
    return told_rad;
  }
  const double since_s = gyro.heard == kNever ? 0.0 : to_s(state.time - gyro.heard);
  if (!late.begun() || !(since_s > 0 && since_s < kHeadingGap_s)) {
    late.begin(told_rad);
  } else {
    late.hear(told_rad, gyro.gyro_since_rad, since_s, config_);
  }
  return wrap_rad(told_rad + late.lag_rad());
}

void Estimator::take(State& state, const Input& input) const {
  if (const auto* wheels = std::get_if<MotionInput>(&input)) {
    take_rates(state, *wheels);
  } else if (const auto* yaw = std::get_if<YawInput>(&input)) {
    if (yaw->receiver != state.heading.receiver) {  // its line is mounted with an error of its own
      state.heading = {};
      state.heading.receiver = yaw->receiver;
      state.mounting = {};
      forget_fit(state, config_);
      state.heading_late = HeadingLate(config_);
      state.gyro.heard = kNever;
    }
    const double yaw_rad = in_time(state, yaw->yaw_rad);
    hear_heading(state.gyro, yaw_rad, state.time);
    apply_heading(state, yaw_rad, config_);
  } else if (const auto* position = std::get_if<AntennaPosition>(&input)) {
    const BodyMotion body = body_motion(base_, state.told, state.time, wheel_stale_);
    apply(state, *position, body.twist, config_);
  }
  if (state.belief.finite()) return;
  State fresh = blank();
  fresh.time = state.time;
  fresh.told = state.told;
  fresh.refused = state.refused;
  fresh.broken = state.broken + 1;
  state = fresh;
}

const Estimate& Estimator::step(Time now) {
  now_ = now;
  clamp_future(now);
  replay();
  while (history_.size() > 0 && history_.at(0).time < now - max_delay_) history_.drop_oldest();
  // Keeps the newest state near, so that a silence does not make every step longer.
  const Time newest = history_.before(history_.size()).time;
  if (newest != kNever && now - newest > kLongestStep) {
    insert(now, MotionInput{});
    replay();
  }
  State state = history_.before(history_.size());
  advance(state, now);
  report(state, now);
  return estimate_;
}

}  // namespace drover::engine
