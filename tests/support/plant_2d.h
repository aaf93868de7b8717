// A small skid-steer base for closed-loop tests: wheel lag, skidding in turns, pose noise, a seed.
// Header only, so that a test needs nothing but the engine.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <random>

#include "drover/angle.h"
#include "drover/snapshot.h"
#include "engine/base/two_sides.h"
#include "engine/config.h"

namespace drover::test {

struct PlantConfig {
  double wheel_lag_s = 0.12;        ///< first order, each side
  double yaw_scrub = 0.08;          ///< the base turns this much less than its wheels say
  double position_noise_m = 0.009;  ///< one sigma of each axis, as the estimate has it
  double yaw_noise_rad = 0.3 * kPi / 180;
  double noise_time_s = 0.5;  ///< of correlation: an estimate does not jump
  std::uint64_t seed = 1;
};

class Plant2d final {
 public:
  Plant2d(const engine::BaseConfig& base, const PlantConfig& config, double x_m, double y_m,
          double yaw_rad)
      : base_(base), config_(config), random_(config.seed) {
    truth_.x_m = x_m;
    truth_.y_m = y_m;
    truth_.yaw_rad = yaw_rad;
    for (double& n : noise_) n = normal();
  }

  /// `aside_mps`: to the left, of rollers.
  void step(const engine::WheelSpeeds& wheels, double dt_s, double aside_mps = 0) {
    const double blend = 1 - std::exp(-dt_s / config_.wheel_lag_s);
    left_mps_ += blend * (wheels.left_radps * base_.wheel_radius_m - left_mps_);
    right_mps_ += blend * (wheels.right_radps * base_.wheel_radius_m - right_mps_);
    truth_.vy_mps += blend * (aside_mps - truth_.vy_mps);
    truth_.vx_mps = 0.5 * (left_mps_ + right_mps_);
    truth_.wz_radps = (right_mps_ - left_mps_) / turn_track_m() * (1 - config_.yaw_scrub);
    const double middle_rad = truth_.yaw_rad + 0.5 * truth_.wz_radps * dt_s;
    const double c = std::cos(middle_rad);
    const double s = std::sin(middle_rad);
    truth_.x_m += (truth_.vx_mps * c - truth_.vy_mps * s) * dt_s;
    truth_.y_m += (truth_.vx_mps * s + truth_.vy_mps * c) * dt_s;
    truth_.yaw_rad = wrap_rad(truth_.yaw_rad + truth_.wz_radps * dt_s);
    const double keep = std::exp(-dt_s / config_.noise_time_s);
    for (double& n : noise_) n = keep * n + std::sqrt(1 - keep * keep) * normal();
  }

  const Pose& truth() const { return truth_; }
  /// What an estimator would say: the truth with slow noise; speeds by the wheels, scrub unknown.
  Pose estimate() const {
    Pose pose = truth_;
    pose.x_m += config_.position_noise_m * noise_[0];
    pose.y_m += config_.position_noise_m * noise_[1];
    pose.yaw_rad = wrap_rad(pose.yaw_rad + config_.yaw_noise_rad * noise_[2]);
    pose.wz_radps /= 1 - config_.yaw_scrub;
    return pose;
  }

  /// How far wheels are apart that turn it by their difference.
  double turn_track_m() const {
    return base_.track_m + (base_.kind == engine::BaseKind::mecanum ? base_.wheelbase_m : 0);
  }

 private:
  /// Box-Muller, so that every standard library gives the same numbers.
  double normal() {
    const double u = (static_cast<double>(random_() >> 11) + 0.5) / 9007199254740992.0;
    const double v = static_cast<double>(random_() >> 11) / 9007199254740992.0;
    return std::sqrt(-2 * std::log(u)) * std::cos(2 * kPi * v);
  }

  engine::BaseConfig base_;
  PlantConfig config_;
  std::mt19937_64 random_;
  Pose truth_;
  double left_mps_ = 0;
  double right_mps_ = 0;
  double noise_[3] = {};
};

/// Limits of acceleration and jerk as a gate has them, for tests that have no gate.
class TwistRamp final {
 public:
  explicit TwistRamp(const engine::LimitsConfig& limits) : limits_(limits) {}
  Twist step(const Twist& wanted, double dt_s) {
    const bool faster = wanted.vx_mps > now_.vx_mps;
    const double most = faster ? limits_.acceleration_mps2 : limits_.deceleration_mps2;
    const double gap_mps = wanted.vx_mps - now_.vx_mps;
    // As hard as the ramp can still be taken back when the gap closes.
    const double closing = std::sqrt(2 * limits_.jerk_mps3 * std::abs(gap_mps));
    const double aim = std::copysign(std::min({most, closing, std::abs(gap_mps) / dt_s}), gap_mps);
    acceleration_ +=
        std::clamp(aim - acceleration_, -limits_.jerk_mps3 * dt_s, limits_.jerk_mps3 * dt_s);
    now_.vx_mps += acceleration_ * dt_s;
    const double most_radps = limits_.yaw_acceleration_radps2 * dt_s;
    now_.wz_radps += std::clamp(wanted.wz_radps - now_.wz_radps, -most_radps, most_radps);
    return now_;
  }

 private:
  engine::LimitsConfig limits_;
  Twist now_;
  double acceleration_ = 0;
};

}  // namespace drover::test
