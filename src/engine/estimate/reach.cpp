#include "engine/estimate/reach.h"

#include <algorithm>
#include <cmath>

#include "drover/angle.h"

namespace drover::engine::estimate {
namespace {

constexpr double kIdle_mps = 0.3;
constexpr double kFirst_m = 0.05;
constexpr double kGrowth = 1.15;
constexpr int kSteps = 40;

/// Of the bounds: 0 none, 1 all.
double used_share(const Belief& belief, const HeadingDoubt& doubt, const EstimateConfig& config) {
  return std::max(doubt.two_sigma_m(belief) / config.bound_run_m,
                  doubt.two_sigma_rad(belief) / to_rad(config.bound_yaw_deg));
}

}  // namespace

double HeadingDoubt::two_sigma_m(const Belief& belief) const {
  return std::hypot(two_sigma_position_m(belief), 2 * sigma_rad * std::hypot(east_m, north_m));
}

double HeadingDoubt::two_sigma_rad(const Belief& belief) const {
  return 2 * std::sqrt(belief.covariance[kYaw][kYaw] + square(sigma_rad));
}

double metres_left(Belief belief, HeadingDoubt doubt, BodyMotion body, GyroMotion gyro,
                   double bias_sigma_x_m, double bias_sigma_y_m, const EstimateConfig& config) {
  if (!body.known || gyro.pushed || used_share(belief, doubt, config) >= 1) return 0;
  double speed_mps = std::abs(belief.mean[kScale] * body.twist.vx_mps);
  if (speed_mps < kIdle_mps / 4) {  // it stands or turns on the spot
    speed_mps = kIdle_mps;
    body.twist = {kIdle_mps, 0};
    body.standing = false;
    gyro.rate_radps = belief.mean[kGyroBias];
  }
  // Each step longer than the one before: a few suffice for a near bound and for a far one.
  double left_m = 0;
  double step_m = kFirst_m;
  double used = used_share(belief, doubt, config);
  for (int i = 0; i < kSteps; ++i) {
    const Vector before = belief.mean;
    predict(belief, body, step_m / speed_mps, true, bias_sigma_x_m, bias_sigma_y_m, config, gyro);
    doubt.east_m += belief.mean[kX] - before[kX];
    doubt.north_m += belief.mean[kY] - before[kY];
    const double next = used_share(belief, doubt, config);
    if (next >= 1) return left_m + step_m * (1 - used) / (next - used);
    used = next;
    left_m += step_m;
    step_m *= kGrowth;
  }
  return left_m;
}

}  // namespace drover::engine::estimate
