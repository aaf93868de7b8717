#include "engine/odometry.h"

#include <algorithm>
#include <cmath>

#include "drover/angle.h"

namespace drover::engine {
namespace {

constexpr Duration kLongestStep = std::chrono::seconds(1);
// A base that is silent may do anything: so fast, (m/s)^2, (rad/s)^2.
constexpr double kUnknownSpeed = 0.25;
constexpr double kUnknownTurn = 0.25;
/// An error of a speed keeps its sign for about a second.
constexpr double kSpreadTime_s = 1.0;

constexpr double square(double x) {
  return x * x;
}

/// The map is level and the ground may not be.
double level_share(double tilt_rad) {
  return std::isfinite(tilt_rad) ? std::cos(tilt_rad) : 1.0;
}

}  // namespace

const Odometry& OdometryTrack::step(Time now, const Estimate& estimate) {
  way_.known = estimate.body.known;
  way_.vx_mps = way_.known ? estimate.pose.vx_mps * level_share(estimate.pitch_rad) : 0;
  way_.vy_mps = way_.known ? estimate.pose.vy_mps * level_share(estimate.roll_rad) : 0;
  way_.wz_radps = way_.known || estimate.gyro_used ? estimate.pose.wz_radps : 0;
  if (!std::isfinite(way_.vx_mps)) way_.vx_mps = 0;
  if (!std::isfinite(way_.vy_mps)) way_.vy_mps = 0;
  if (!std::isfinite(way_.wz_radps)) way_.wz_radps = 0;
  way_.vx_var = way_.known ? estimate.body.vx_var : kUnknownSpeed;
  way_.vy_var = way_.known ? estimate.body.vy_var : kUnknownSpeed;
  way_.wz_var = estimate.gyro_used ? square(config_.imu_rate_sigma_radps)
                : way_.known       ? estimate.body.wz_var
                                   : kUnknownTurn;
  if (way_.time != kNever && now > way_.time)
    advance(to_s(std::min(now - way_.time, kLongestStep)), estimate);
  way_.time = now;
  return way_;
}

void OdometryTrack::advance(double dt_s, const Estimate& estimate) {
  const double way_m = way_.vx_mps * dt_s;
  const double left_m = way_.vy_mps * dt_s;
  const double turn_rad = way_.wz_radps * dt_s;
  const double middle_rad = way_.yaw_rad + turn_rad / 2;
  const double c = std::cos(middle_rad);
  const double s = std::sin(middle_rad);
  const double dx_m = way_m * c - left_m * s;
  const double dy_m = way_m * s + left_m * c;
  way_.x_m += dx_m;
  way_.y_m += dy_m;
  way_.yaw_rad = wrap_rad(way_.yaw_rad + turn_rad);

  // x and y depend on the yaw: of a wrong yaw the way leads aside.
  way_.x_var += -2 * dy_m * way_.x_yaw_var + dy_m * dy_m * way_.yaw_var;
  way_.xy_var += dx_m * way_.x_yaw_var - dy_m * way_.y_yaw_var - dx_m * dy_m * way_.yaw_var;
  way_.y_var += 2 * dx_m * way_.y_yaw_var + dx_m * dx_m * way_.yaw_var;
  way_.x_yaw_var -= dy_m * way_.yaw_var;
  way_.y_yaw_var += dx_m * way_.yaw_var;

  const double ahead_metres = std::abs(way_m);
  const double left_metres = std::abs(left_m);
  const double metres = std::hypot(way_m, left_m);
  const double radians = std::abs(turn_rad);
  const double spread_s2 = kSpreadTime_s * dt_s;
  const double shift = square(config_.turning_shift_m) * radians;
  const double along = square(config_.odometry_along_m) * ahead_metres +
                       square(config_.odometry_across_m) * left_metres + way_.vx_var * spread_s2 +
                       shift;
  const double across = square(config_.odometry_across_m) * ahead_metres +
                        square(config_.odometry_along_m) * left_metres + way_.vy_var * spread_s2 +
                        (way_.known ? 0 : shift);
  way_.x_var += along * c * c + across * s * s;
  way_.xy_var += (along - across) * c * s;
  way_.y_var += along * s * s + across * c * c;
  way_.yaw_var += estimate.gyro_used ? square(config_.imu_gyro_noise_rad) * dt_s
                                     : square(config_.odometry_yaw_rad) * metres +
                                           square(config_.turning_yaw_rad) * radians +
                                           way_.wz_var * kSpreadTime_s * dt_s;
}

}  // namespace drover::engine
