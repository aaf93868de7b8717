#include "engine/estimate/tilt.h"

#include <algorithm>
#include <cmath>

namespace drover::engine::estimate {
namespace {

constexpr double kAtRest_s = 0.5;
constexpr double kInMotion_s = 5.0;
constexpr double kLongestGap_s = 0.2;
// A force farther from gravity than this is a shock.
constexpr double kShock_mps2 = 3.0;
constexpr double kSteepest_rad = 1.0;  // no field robot stands so; keeps the cosine away from zero

}  // namespace

void Tilt::level(const ImuSample& sample, double dt_s, bool standing, double speed_mps,
                 const Vector3& bias_radps) {
  const Vector3& force = sample.acceleration_mps2;
  const Vector3& rate = sample.angular_velocity_radps;
  const double side_mps2 = force.y - speed_mps * rate.z;
  const double magnitude = std::hypot(force.x, side_mps2, force.z);
  const bool shock = std::abs(magnitude - kGravity_mps2) > kShock_mps2;
  const double roll = std::atan2(side_mps2, force.z);
  const double pitch = std::atan2(-force.x, std::hypot(side_mps2, force.z));
  if (!known() || dt_s > kLongestGap_s) {
    if (shock) return;
    roll_rad_ = roll;
    pitch_rad_ = pitch;
    return;
  }
  const double p = rate.x - bias_radps.x;
  const double q = rate.y - bias_radps.y;
  const double s = std::sin(roll_rad_);
  const double c = std::cos(roll_rad_);
  roll_rad_ += (p + std::tan(pitch_rad_) * (s * q + c * rate.z)) * dt_s;
  pitch_rad_ += (c * q - s * rate.z) * dt_s;
  if (shock) return;
  const double share = dt_s / ((standing ? kAtRest_s : kInMotion_s) + dt_s);
  roll_rad_ += share * (roll - roll_rad_);
  pitch_rad_ += share * (pitch - pitch_rad_);
}

void Tilt::update(const ImuSample& sample, Time at, bool standing, double speed_mps,
                  const Vector3& bias_radps) {
  if (sample.has_orientation) {
    const Quaternion& q = sample.orientation;
    roll_rad_ = std::atan2(2 * (q.w * q.x + q.y * q.z), 1 - 2 * (q.x * q.x + q.y * q.y));
    pitch_rad_ = std::asin(std::clamp(2 * (q.w * q.y - q.z * q.x), -1.0, 1.0));
  } else {
    level(sample, known() ? std::max(to_s(at - last_), 0.0) : 0.0, standing, speed_mps, bias_radps);
  }
  roll_rad_ = std::clamp(roll_rad_, -kSteepest_rad, kSteepest_rad);
  pitch_rad_ = std::clamp(pitch_rad_, -kSteepest_rad, kSteepest_rad);
  last_ = at;
}

double Tilt::vertical_radps(const Vector3& rate_radps) const {
  return (std::sin(roll_rad_) * rate_radps.y + std::cos(roll_rad_) * rate_radps.z) /
         std::cos(pitch_rad_);
}

}  // namespace drover::engine::estimate
