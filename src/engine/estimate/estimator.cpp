#include "engine/estimate/estimator.h"

#include <algorithm>
#include <cmath>

#include "drover/angle.h"
#include "engine/estimate/model_gnss.h"
#include "engine/estimate/model_heading.h"

namespace drover::engine {
namespace {

using namespace estimate;

// Rim speeds that become known within one slot share an entry of the history, so its length does
// not depend on the number of wheels. At 0.4 m/s2 the speed changes by 2 mm/s in one.
constexpr Duration kWheelSlot = std::chrono::milliseconds(4);
// Longest stretch predicted at once: the arc of a step is taken as its chord.
constexpr Duration kLongestStep = std::chrono::milliseconds(20);
constexpr double kFastestRim_mps = 20.0;  // faster is a broken encoder, not a field robot
constexpr double kFarthest_m = 100000.0;  // from the origin: another place, not this field

}  // namespace

Estimator::Estimator(const EstimateConfig& config, const BaseConfig& base)
    : config_(config),
      base_(base),
      wheel_stale_(from_s(config.wheel_stale_s)),
      max_delay_(from_s(config.max_measurement_delay_s)) {
  history_.restart(blank());
}

State Estimator::blank() const {
  State state;
  state.belief.reset(kGain, 1.0 / base_.yaw_slip_factor, config_.yaw_slip_sigma);
  state.belief.reset(kScale, 1.0, config_.wheel_scale_sigma);
  return state;
}

void Estimator::set_origin(const GeodeticPoint& origin) {
  replay();
  const State& old = history_.before(history_.size());
  State state = blank();
  state.time = old.time;
  state.wheels = old.wheels;
  state.standing_since = old.standing_since;
  state.refused = old.refused;
  state.broken = old.broken;
  for (const std::size_t i : {std::size_t{kGain}, std::size_t{kScale}}) {
    state.belief.reset(i, old.belief.mean[i], std::sqrt(old.belief.covariance[i][i]));
  }
  history_.restart(state);
  frame_.set_origin(origin);
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
  return frame_.geodetic({.x_m = pose.x_m + config_.antenna_x_m * c - config_.antenna_y_m * s,
                          .y_m = pose.y_m + config_.antenna_x_m * s + config_.antenna_y_m * c},
                         altitude_m_);
}

EstimatorCounters Estimator::counters() const {
  EstimatorCounters counters = counters_;
  counters.refused = history_.before(history_.dirty()).refused;
  counters.broken = history_.before(history_.dirty()).broken;
  return counters;
}

void Estimator::on_measurement(const Measurement& measurement) {
  if (measurement.time == kNever) return;
  // Nothing is true later than it was heard.
  const Time time = measurement.received == kNever
                        ? measurement.time
                        : std::min(measurement.time, measurement.received);
  // A GNSS velocity is not used: it is the same carrier phase as the position, and later.
  if (const auto* motion = std::get_if<AxisMotion>(&measurement.value)) {
    on_wheel(*motion, time);
  } else if (const auto* position = std::get_if<GnssPosition>(&measurement.value)) {
    on_position(*position, time);
  } else if (const auto* heading = std::get_if<GnssHeading>(&measurement.value)) {
    on_heading(*heading, time);
  }
}

void Estimator::on_wheel(const AxisMotion& motion, Time time) {
  const std::size_t wheel = wheel_of(base_, motion.axis);
  if (wheel == kWheels) return;
  const double rim_mps = motion.velocity_radps * base_.wheel_radius_m;
  if (!(std::abs(rim_mps) <= kFastestRim_mps)) {
    ++counters_.absurd;
    return;
  }
  const Time slot = time - time.time_since_epoch() % kWheelSlot;
  if (too_old(slot)) return;
  WheelInput input;
  const std::size_t i = history_.find(slot, 0);
  if (i < history_.size()) input = *std::get_if<WheelInput>(&history_.at(i).input);
  input.present = static_cast<std::uint16_t>(input.present | 1U << wheel);
  input.rim_mps[wheel] = rim_mps;
  if (i < history_.size()) {
    history_.at(i).input = input;
    history_.mark_dirty(i);
  } else {
    insert(slot, input);
  }
}

void Estimator::on_position(const GnssPosition& position, Time time) {
  if (!frame_.has_origin()) return;
  AntennaPosition antenna;
  antenna.quality = class_of(position, config_);
  if (antenna.quality == GnssClass::none) return;
  const double altitude_m = position.altitude_msl_m + position.undulation_m;
  const PathPoint point = frame_.local({.latitude_deg = position.latitude_deg,
                                        .longitude_deg = position.longitude_deg,
                                        .altitude_m = altitude_m});
  antenna.x_m = point.x_m;
  antenna.y_m = point.y_m;
  antenna.sigma_x_m = sigma_m(antenna.quality, position.sigma_east_m, config_);
  antenna.sigma_y_m = sigma_m(antenna.quality, position.sigma_north_m, config_);
  const bool sane = std::abs(position.latitude_deg) <= 90 &&
                    std::abs(position.longitude_deg) <= 180 &&
                    std::hypot(antenna.x_m, antenna.y_m) <= kFarthest_m;
  if (!sane) {
    ++counters_.absurd;
    return;
  }
  if (std::isfinite(altitude_m)) altitude_m_ = altitude_m;
  insert(time, antenna);
}

void Estimator::on_heading(const GnssHeading& heading, Time time) {
  if (!(std::abs(heading.heading_deg) <= 360)) {
    ++counters_.absurd;
    return;
  }
  insert(time, YawInput{yaw_of_baseline_rad(heading.heading_deg, config_)});
}

bool Estimator::too_old(Time time) {
  const bool old = time < history_.base().time || time < now_ - max_delay_;
  counters_.late += old ? 1 : 0;
  return old;
}

void Estimator::insert(Time time, const Input& input) {
  if (too_old(time)) return;
  if (history_.find(time, input.index()) < history_.size()) {
    ++counters_.repeated;
    return;
  }
  if (history_.full()) {
    replay();
    history_.drop_oldest();
    if (too_old(time)) return;
  }
  history_.insert(time, input);
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
    const WheelMotion motion = state.wheels.motion(state.time, wheel_stale_);
    if (!motion.standing) {
      state.standing_since = kNever;
    } else if (state.standing_since == kNever) {
      state.standing_since = state.time;
    }
    const Time until =
        std::min({to, state.time + longest, state.wheels.next_stale(state.time, wheel_stale_)});
    predict(state.belief, motion, to_s(until - state.time), state.has_heading, state.gnss.sigma_x_m,
            state.gnss.sigma_y_m, config_, base_.track_m);
    state.time = until;
    if (state.belief.covariance[kYaw][kYaw] > kLostYaw_rad * kLostYaw_rad) {
      state.has_heading = false;
      state.belief.reset(kYaw, state.belief.mean[kYaw], kLostYaw_rad);
    }
  }
}

void Estimator::take(State& state, const Input& input) const {
  if (const auto* wheels = std::get_if<WheelInput>(&input)) {
    for (std::size_t i = 0; i < kWheels; ++i) {
      if ((wheels->present >> i & 1U) != 0) state.wheels.set(i, wheels->rim_mps[i], state.time);
    }
  } else if (const auto* yaw = std::get_if<YawInput>(&input)) {
    apply_heading(state, yaw->yaw_rad, config_);
  } else if (const auto* position = std::get_if<AntennaPosition>(&input)) {
    const WheelMotion motion = state.wheels.motion(state.time, wheel_stale_);
    apply(state, *position, (motion.left_mps + motion.right_mps) / 2, config_);
  }
  if (state.belief.finite()) return;
  State fresh = blank();
  fresh.time = state.time;
  fresh.wheels = state.wheels;
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
    insert(now, WheelInput{});
    replay();
  }
  State state = history_.before(history_.size());
  advance(state, now);
  report(state, now);
  return estimate_;
}

void Estimator::report(const State& state, Time now) {
  const Belief& belief = state.belief;
  const WheelMotion motion = state.wheels.motion(now, wheel_stale_);
  Estimate& e = estimate_;
  e.has_position = state.has_position;
  e.has_heading = state.has_heading;
  e.pose.time = now;
  e.pose.x_m = belief.mean[kX];
  e.pose.y_m = belief.mean[kY];
  e.pose.yaw_rad = belief.mean[kYaw];
  e.pose.vx_mps = belief.mean[kScale] * (motion.left_mps + motion.right_mps) / 2;
  e.pose.wz_radps = belief.mean[kGain] * (motion.right_mps - motion.left_mps) / base_.track_m;
  e.left_mps = motion.left_mps;
  e.right_mps = motion.right_mps;
  e.yaw_slip_factor = 1.0 / belief.mean[kGain];

  const double two_sigma_m = two_sigma_position_m(belief);
  const double two_sigma_rad = 2 * std::sqrt(belief.covariance[kYaw][kYaw]);
  e.pose.position_sigma_m = state.has_position ? two_sigma_m / 2 : kAbsent;
  e.pose.yaw_sigma_rad = state.has_heading ? two_sigma_rad / 2 : kAbsent;
  e.predicted_error_m = state.has_position ? two_sigma_m : kAbsent;
  e.yaw_error_rad = state.has_heading ? two_sigma_rad : kAbsent;

  const Duration patience = from_s(config_.jump_time_s);
  const bool position_disagrees = state.gnss.jumps.disagrees(patience);
  const bool heading_disagrees = state.heading.jumps.disagrees(patience);
  e.disagrees = position_disagrees || heading_disagrees;
  // One of the two is wrong, and nobody knows which: the error may be all that lies between them.
  if (position_disagrees && state.has_position) {
    e.predicted_error_m = std::max(two_sigma_m, state.gnss.contradiction_m);
  }
  if (position_disagrees) {
    e.reason = "position disagrees with odometry";
  } else if (heading_disagrees) {
    e.reason = "heading disagrees with odometry";
  } else if (!frame_.has_origin()) {
    e.reason = "no origin";
  } else if (!state.has_position) {
    e.reason = "no position yet";
  } else if (!state.has_heading) {
    e.reason = "no heading";
  } else if (!motion.known) {
    e.reason = "wheels are silent";
  } else {
    e.reason.clear();
  }
}

}  // namespace drover::engine
