#include "engine/estimate/filter.h"

#include <algorithm>
#include <cmath>

#include "drover/angle.h"

namespace drover::engine::estimate {
namespace {

// With silent wheels the base may be pushed or towed: the variance grows by the square of these
// each second (0.3 m and 0.3 rad after one second).
constexpr double kUnknownMotion_m = 0.3;
constexpr double kUnknownTurn_rad = 0.3;
// What a standing base still does: tyres settle, soil gives. Per square root of second.
constexpr double kStanding_m = 0.0005;
constexpr double kStanding_rad = 0.0002;
// What wheels that contradict each other, or slip, get wrong keeps its sign for about this long.
constexpr double kSpreadTime_s = 1.0;
// What a gyro's non-linearity and its tilt add to a turn, per square root of radian.
constexpr double kGyroTurn_rad = 0.002;

/// Adds `factor` times row `from` to row `to`, and the same for columns: covariance of
/// x_to + factor * x_from.
struct RowSum {
  std::size_t from;
  double factor;
};

template <std::size_t N>
void add_rows(Matrix& p, std::size_t to, const std::array<RowSum, N>& sums) {
  for (std::size_t c = 0; c < kStates; ++c) {
    for (const RowSum& sum : sums) p[to][c] += sum.factor * p[sum.from][c];
  }
  for (std::size_t r = 0; r < kStates; ++r) {
    for (const RowSum& sum : sums) p[r][to] += sum.factor * p[r][sum.from];
  }
}

void fade_bias(Belief& belief, double dt_s, double correlation_s, double sigma_x_m,
               double sigma_y_m) {
  const double keep = 1.0 / (1.0 + dt_s / correlation_s);
  for (const std::size_t i : {std::size_t{kBiasX}, std::size_t{kBiasY}}) {
    belief.mean[i] *= keep;
    for (std::size_t k = 0; k < kStates; ++k) belief.covariance[i][k] *= keep;
    for (std::size_t k = 0; k < kStates; ++k) belief.covariance[k][i] *= keep;
    const double sigma_m = i == kBiasX ? sigma_x_m : sigma_y_m;
    belief.covariance[i][i] += (1.0 - keep * keep) * square(sigma_m);
  }
}

}  // namespace

void Belief::reset(std::size_t i, double value, double sigma) {
  for (std::size_t k = 0; k < kStates; ++k) covariance[i][k] = covariance[k][i] = 0;
  covariance[i][i] = square(sigma);
  mean[i] = value;
}

void Belief::correct(const Vector& row, double innovation, double variance) {
  Vector spread{};  // covariance * row^T
  for (std::size_t r = 0; r < kStates; ++r) {
    for (std::size_t c = 0; c < kStates; ++c) spread[r] += covariance[r][c] * row[c];
  }
  double total = variance;
  for (std::size_t c = 0; c < kStates; ++c) total += row[c] * spread[c];
  if (!(total > 0)) return;
  for (std::size_t r = 0; r < kStates; ++r) {
    mean[r] += spread[r] / total * innovation;
    for (std::size_t c = 0; c <= r; ++c) {
      covariance[r][c] -= spread[r] * spread[c] / total;
      covariance[c][r] = covariance[r][c];
    }
  }
  mean[kYaw] = wrap_rad(mean[kYaw]);
  // Far outside of what any tyre does the model does not hold; stay where it does.
  mean[kGain] = std::clamp(mean[kGain], 0.2, 2.0);
  mean[kScale] = std::clamp(mean[kScale], 0.8, 1.2);
  mean[kGyroScale] = std::clamp(mean[kGyroScale], 0.8, 1.2);
}

double Belief::project(const Vector& row, const Vector& other) const {
  double sum = 0;
  for (std::size_t r = 0; r < kStates; ++r) {
    if (row[r] == 0) continue;
    for (std::size_t c = 0; c < kStates; ++c) sum += row[r] * covariance[r][c] * other[c];
  }
  return sum;
}

void Belief::floor_variance(std::size_t i, double variance) {
  covariance[i][i] = std::max(covariance[i][i], variance);
}

void Belief::limit_variance(std::size_t i, double variance) {
  if (!(covariance[i][i] > variance)) return;
  const double factor = std::sqrt(variance / covariance[i][i]);
  for (std::size_t k = 0; k < kStates; ++k) covariance[i][k] *= factor;
  for (std::size_t k = 0; k < kStates; ++k) covariance[k][i] *= factor;
}

bool Belief::finite() const {
  for (std::size_t r = 0; r < kStates; ++r) {
    if (!std::isfinite(mean[r]) || !(covariance[r][r] >= 0)) return false;
    for (const double c : covariance[r]) {
      if (!std::isfinite(c)) return false;
    }
  }
  return true;
}

double two_sigma_position_m(const Belief& belief) {
  const double xx = belief.covariance[kX][kX];
  const double yy = belief.covariance[kY][kY];
  const double xy = belief.covariance[kX][kY];
  const double larger = (xx + yy) / 2 + std::sqrt(square((xx - yy) / 2) + square(xy));
  return 2 * std::sqrt(larger);
}

namespace {

/// The turn of an interval with all that it depends on.
struct Turn {
  double rad = 0;
  double by_gain = 0;        ///< derivative by kGain
  double by_gyro_bias = 0;   ///< by kGyroBias
  double by_gyro_scale = 0;  ///< by kGyroScale
  double variance = 0;       ///< of its own noise
};

Turn turn_of_gyro(Belief& belief, const GyroMotion& gyro, double dt_s,
                  const EstimateConfig& config) {
  const Vector& x = belief.mean;
  const double measured_rad = (gyro.rate_radps - x[kGyroBias]) * dt_s;
  const double rad = x[kGyroScale] * measured_rad;
  belief.covariance[kGyroBias][kGyroBias] += square(config.imu_gyro_bias_walk_radps) * dt_s;
  return {
      .rad = rad,
      .by_gyro_bias = -x[kGyroScale] * dt_s,
      .by_gyro_scale = measured_rad,
      .variance = square(config.imu_gyro_noise_rad) * dt_s + square(kGyroTurn_rad) * std::abs(rad)};
}

Turn turn_of_body(const Belief& belief, const BodyMotion& body, double dt_s, double metres,
                  const EstimateConfig& config) {
  const double told_rad = body.twist.wz_radps * dt_s;
  const double rad = belief.mean[kGain] * told_rad;
  return {.rad = rad,
          .by_gain = told_rad,
          .variance = square(config.odometry_yaw_rad) * metres +
                      square(config.turning_yaw_rad) * std::abs(rad) +
                      body.wz_var * kSpreadTime_s * dt_s};
}

/// Turns the yaw; what x and y depend on must have been carried before.
void apply_turn(Belief& belief, const Turn& turn) {
  belief.mean[kYaw] = wrap_rad(belief.mean[kYaw] + turn.rad);
  // A factor that is zero adds nothing: with wheels alone the gyro's numbers stay out of it.
  if (turn.by_gain != 0) {
    add_rows<1>(belief.covariance, kYaw, {{{kGain, turn.by_gain}}});
  } else {
    add_rows<2>(belief.covariance, kYaw,
                {{{kGyroBias, turn.by_gyro_bias}, {kGyroScale, turn.by_gyro_scale}}});
  }
  belief.covariance[kYaw][kYaw] += turn.variance;
}

}  // namespace

void predict(Belief& belief, const BodyMotion& body, double dt_s, bool heading_known,
             double bias_sigma_x_m, double bias_sigma_y_m, const EstimateConfig& config,
             const GyroMotion& gyro) {
  if (!(dt_s > 0)) return;
  Vector& x = belief.mean;
  Matrix& p = belief.covariance;
  fade_bias(belief, dt_s, config.gnss_correlation_s, bias_sigma_x_m, bias_sigma_y_m);

  if (!body.known || gyro.pushed) {
    p[kX][kX] += square(kUnknownMotion_m) * dt_s;
    p[kY][kY] += square(kUnknownMotion_m) * dt_s;
    if (gyro.known) {
      if (heading_known) apply_turn(belief, turn_of_gyro(belief, gyro, dt_s, config));
    } else {
      p[kYaw][kYaw] += square(kUnknownTurn_rad) * dt_s;
    }
    return;
  }
  const double told_m = body.twist.vx_mps * dt_s;
  const double way_m = x[kScale] * body.twist.vx_mps * dt_s;
  const double told_left_m = body.twist.vy_mps * dt_s;
  const double left_m = x[kScale] * told_left_m;
  const double metres = std::hypot(way_m, left_m);
  const double way_variance = body.vx_var * kSpreadTime_s * dt_s;
  const double left_variance = body.vy_var * kSpreadTime_s * dt_s;

  if (!heading_known) {
    p[kX][kX] = square(std::sqrt(p[kX][kX]) + metres) + way_variance + left_variance;
    p[kY][kY] = square(std::sqrt(p[kY][kY]) + metres) + way_variance + left_variance;
    return;
  }
  const Turn turn = gyro.known ? turn_of_gyro(belief, gyro, dt_s, config)
                               : turn_of_body(belief, body, dt_s, metres, config);
  const double middle_rad = x[kYaw] + turn.rad / 2;
  const double c = std::cos(middle_rad);
  const double s = std::sin(middle_rad);
  const double dx_m = way_m * c - left_m * s;
  const double dy_m = way_m * s + left_m * c;
  x[kX] += dx_m;
  x[kY] += dy_m;

  // x and y first: their derivatives use the yaw before the turn. That half a gyro's error of this
  // short step bends its chord is left out.
  add_rows<3>(
      p, kX,
      {{{kYaw, -dy_m}, {kGain, -dy_m * turn.by_gain / 2}, {kScale, told_m * c - told_left_m * s}}});
  add_rows<3>(
      p, kY,
      {{{kYaw, dx_m}, {kGain, dx_m * turn.by_gain / 2}, {kScale, told_m * s + told_left_m * c}}});
  apply_turn(belief, turn);

  const double radians = std::abs(turn.rad);
  const double shift = square(config.turning_shift_m) * radians + square(kStanding_m) * dt_s;
  const double ahead_metres = std::abs(way_m);
  const double left_metres = std::abs(left_m);
  const double along = square(config.odometry_along_m) * ahead_metres +
                       square(config.odometry_across_m) * left_metres + way_variance;
  const double across = square(config.odometry_across_m) * ahead_metres +
                        square(config.odometry_along_m) * left_metres + left_variance;
  p[kX][kX] += along * c * c + across * s * s + shift;
  p[kY][kY] += along * s * s + across * c * c + shift;
  p[kX][kY] += (along - across) * c * s;
  p[kY][kX] = p[kX][kY];
  p[kYaw][kYaw] += square(kStanding_rad) * dt_s;
  p[kGain][kGain] += square(config.yaw_slip_walk) * radians;
  p[kScale][kScale] += square(config.wheel_scale_walk) * metres;
}

}  // namespace drover::engine::estimate
