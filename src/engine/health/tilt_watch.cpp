#include "engine/health/tilt_watch.h"

#include <algorithm>
#include <cmath>

#include "drover/angle.h"

namespace drover::engine {
namespace {

constexpr double kTiltHeld_s = 0.3;
constexpr double kTiltSmooth_s = 0.3;
constexpr double kTiltStale_s = 0.5;
constexpr double kGravity_mps2 = 9.81;
constexpr double kShaken_mps2 = 3.0;
constexpr double kUpright = 0.5;  // of gravity along z: 60 degrees, farther than any limit
constexpr double kBack = 0.9;     // of the limit: upright again

}  // namespace

void TiltWatch::on_sample(const ImuSample& sample, Time at) {
  const Vector3& force = sample.acceleration_mps2;
  const double magnitude = std::hypot(force.x, force.y, force.z);
  if (!std::isfinite(magnitude) || sample.saturated) return;
  const double dt_s = to_s(at - sample_at_);
  const bool begin = sample_at_ == kNever || !(dt_s >= 0 && dt_s < kTiltStale_s);
  const double share = begin ? 1.0 : dt_s / (kTiltSmooth_s + dt_s);
  if (begin) up_mps2_ = force_mps2_ = 0;
  up_mps2_ += share * (force.z - up_mps2_);
  force_mps2_ += share * (magnitude - force_mps2_);
  sample_at_ = at;
}

void TiltWatch::update(Time now, double roll_rad, double pitch_rad) {
  const bool felt = sample_at_ != kNever && now - sample_at_ < from_s(kTiltStale_s) &&
                    std::abs(force_mps2_ - kGravity_mps2) < kShaken_mps2;
  // Its driver may reject such a sensor: what was felt last stands, until it feels otherwise.
  if (felt) wrong_axis_ = up_mps2_ < kUpright * kGravity_mps2;
  const double tilt_rad =
      std::acos(std::clamp(std::cos(roll_rad) * std::cos(pitch_rad), -1.0, 1.0));
  // A tilt that is not known any more leaves the verdict as it was.
  if (!std::isfinite(tilt_rad) && !wrong_axis_) {
    tilted_since_ = kNever;
    return;
  }
  const double limit_rad = to_rad(config_.tilt_limit_deg) * (reason_.empty() ? 1.0 : kBack);
  const bool tilted = tilt_rad > limit_rad;
  if (!wrong_axis_ && !tilted) {
    tilted_since_ = kNever;
    reason_.clear();
    return;
  }
  if (tilted_since_ == kNever) tilted_since_ = now;
  if (now - tilted_since_ < from_s(kTiltHeld_s)) return;
  if (wrong_axis_) {
    reason_ =
        "the IMU feels gravity on the wrong axis: it is mounted another way than configured, or "
        "the robot lies on its side";
  } else {
    reason_.format("the robot is tilted by more than %.0f degrees", config_.tilt_limit_deg);
  }
}

}  // namespace drover::engine
