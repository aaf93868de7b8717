#include "engine/estimate/antenna_learning.h"

#include <algorithm>
#include <cmath>

#include "drover/angle.h"
#include "engine/estimate/antenna_tilt.h"

namespace drover::engine::estimate {
namespace {

constexpr double kLevel_rad = 0.035;   // steeper ground takes the base aside
constexpr double kLateStep_s = 0.003;  // a smaller change is not worth it
constexpr double kNoticed_m = 0.01;    // positions so far from the last ones are not compared

/// What the base goes in so many seconds, as it is turned now.
struct Way {
  double x_m = 0;
  double y_m = 0;
  double metres = 0;
};
Way way_in(const State& state, const Twist& twist, double seconds) {
  const double ahead_m = state.belief.mean[kScale] * twist.vx_mps * seconds;
  const double left_m = state.belief.mean[kScale] * twist.vy_mps * seconds;
  const double c = std::cos(state.belief.mean[kYaw]);
  const double s = std::sin(state.belief.mean[kYaw]);
  return {ahead_m * c - left_m * s, ahead_m * s + left_m * c, std::hypot(ahead_m, left_m)};
}

}  // namespace

void learn_fit(State& state, const AntennaPosition& raw, AntennaPoint point, const Twist& twist,
               const EstimateConfig& config) {
  const bool told = state.heading.last != kNever && state.heading.jumps.running() == false;
  const TiltGuess tilt = guess_tilt(state.gyro, state.belief.mean[kYaw]);
  const bool level = std::hypot(tilt.roll_rad, tilt.pitch_rad) < kLevel_rad;
  const bool sure = told && level && !state.watch.slipping() && !state.watch.looks() &&
                    !state.watch.drifted && !state.shove.holds();
  if (!sure) return state.fit.pause();
  const Vector& mean = state.belief.mean;
  point.time = state.time;
  point.x_m = raw.x_m;
  point.y_m = raw.y_m;
  point.yaw_rad = mean[kYaw];
  point.vx_mps = mean[kScale] * twist.vx_mps * std::cos(mean[kYaw]);
  point.vy_mps = mean[kScale] * twist.vx_mps * std::sin(mean[kYaw]);
  point.white_m = config.gnss_white_share * larger_sigma_m(raw);
  point.slow_m = larger_sigma_m(raw);
  state.fit.hear(point, config);
}

void forget_fit(State& state, const EstimateConfig& config) {
  state.fit = AntennaFit(config);
  state.late_s = 0;
}

void correct_mounting(State& state, const LeverArm& arm, const EstimateConfig& config) {
  const double turn_rad = state.has_heading ? state.mounting.catch_up(config) : 0;
  if (turn_rad == 0) return;
  Vector& mean = state.belief.mean;
  const auto arm_x_m = [&] {
    return arm.ahead_m * std::cos(mean[kYaw]) - arm.left_m * std::sin(mean[kYaw]);
  };
  const auto arm_y_m = [&] {
    return arm.ahead_m * std::sin(mean[kYaw]) + arm.left_m * std::cos(mean[kYaw]);
  };
  mean[kX] += arm_x_m();
  mean[kY] += arm_y_m();
  mean[kYaw] = wrap_rad(mean[kYaw] + turn_rad);
  mean[kX] -= arm_x_m();
  mean[kY] -= arm_y_m();
  state.watch.turn_heading(mean[kYaw], turn_rad);
}

AntennaPosition in_time(const State& state, AntennaPosition position, const Twist& twist) {
  const Way way = way_in(state, twist, state.late_s);
  position.x_m += way.x_m;
  position.y_m += way.y_m;
  return position;
}

void correct_lateness(State& state, const Twist& twist) {
  const double late_s = state.fit.late_used_s();
  const double more_s = late_s - state.late_s;
  if (std::abs(more_s) < kLateStep_s) return;
  state.late_s = late_s;
  const auto [x_m, y_m, metres] = way_in(state, twist, more_s);
  state.belief.mean[kX] += x_m;
  state.belief.mean[kY] += y_m;
  Matrix& p = state.belief.covariance;
  p[kX][kX] += square(x_m) / 4;
  p[kY][kY] += square(y_m) / 4;
  p[kX][kY] += x_m * y_m / 4;
  p[kY][kX] = p[kX][kY];
  if (metres > kNoticed_m) state.watch.pause();
}

}  // namespace drover::engine::estimate
