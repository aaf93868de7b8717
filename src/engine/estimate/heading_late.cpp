#include "engine/estimate/heading_late.h"

#include <algorithm>
#include <cmath>

#include "drover/angle.h"
#include "engine/estimate/filter.h"

namespace drover::engine::estimate {
namespace {

constexpr double kFirst_rad = 0.05;
// What lies between gyro and receiver wanders: per square root of second, and of radian turned.
constexpr double kWanders_rad = 0.003;
constexpr double kWandersTurning_rad = 0.005;
constexpr double kLateHeadingWalk_s = 0.0005;
constexpr double kHeadingGate = 6.0;  // sigmas: it jumped
constexpr double kMostLateHeading_s = 0.4;
constexpr double kLateHeadingKnown_s = 0.04;
constexpr double kLateHeadingLeast_s = 0.03;
constexpr double kCertainlyLate = 4.0;  // sigmas
constexpr double kShortestStep_s = 0.01;
constexpr double kSmooth_s = 0.15;  // a base jerks about, and what is late tells of the mean

}  // namespace

HeadingLate::HeadingLate(const EstimateConfig& config) {
  covariance_[1][1] = square(config.gnss_late_sigma_s);
}

void HeadingLate::begin(double told_rad) {
  begun_ = true;
  told_rad_ = told_rad;
  beside_rad_ = offset_rad_ = radps_ = 0;
  covariance_[0] = {square(kFirst_rad), 0};
  covariance_[1][0] = 0;
}

void HeadingLate::hear(double told_rad, double gyro_turn_rad, double dt_s,
                       const EstimateConfig& config) {
  radps_ += dt_s / (dt_s + kSmooth_s) * (gyro_turn_rad / dt_s - radps_);
  const double gyro_radps = radps_;
  beside_rad_ += wrap_rad(told_rad - told_rad_ - gyro_turn_rad);
  told_rad_ = told_rad;
  auto& p = covariance_;
  p[0][0] += square(kWanders_rad) * dt_s + square(kWandersTurning_rad) * std::abs(gyro_turn_rad);
  if (config.gnss_late_sigma_s > 0) p[1][1] += square(kLateHeadingWalk_s);
  const std::array<double, 2> spread{p[0][0] - gyro_radps * p[0][1],
                                     p[1][0] - gyro_radps * p[1][1]};
  const double repeated = 1 + 2 * config.heading_correlation_s / std::max(dt_s, kShortestStep_s);
  const double total =
      spread[0] - gyro_radps * spread[1] + square(to_rad(config.heading_sigma_deg)) * repeated;
  const double innovation_rad = beside_rad_ - (offset_rad_ - gyro_radps * late_s_);
  if (square(innovation_rad) > square(kHeadingGate) * total) return pause();
  offset_rad_ += spread[0] / total * innovation_rad;
  late_s_ += spread[1] / total * innovation_rad;
  late_s_ = std::clamp(late_s_, -kMostLateHeading_s, kMostLateHeading_s);
  for (std::size_t r = 0; r < 2; ++r)
    for (std::size_t c = 0; c < 2; ++c) p[r][c] -= spread[r] * spread[c] / total;
}

bool HeadingLate::known() const {
  return sigma_s() < kLateHeadingKnown_s &&
         std::abs(late_s_) > std::max(kCertainlyLate * sigma_s(), kLateHeadingLeast_s);
}

double HeadingLate::sigma_s() const {
  return std::sqrt(std::max(covariance_[1][1], 0.0));
}

}  // namespace drover::engine::estimate
