#include "engine/estimate/antenna_tilt.h"

#include <cmath>

#include "drover/angle.h"
#include "engine/estimate/model_gnss.h"

namespace drover::engine::estimate {
namespace {

// The ground changes like this while a base drives: it begins to at once, and a base is on a ramp
// when it has driven as far as it is long. Of any field nothing else is known than this sigma, of
// which two are as steep as ramps are, and three as steep as a base may stand. That it is the same
// ground is likelier for longer.
constexpr double kGroundChanges_m = 1.0;
constexpr double kGroundLasts_s = 20.0;
constexpr double kGroundSigma_rad = to_rad(5.0);

}  // namespace

TiltGuess guess_tilt(const GyroTrack& gyro, double yaw_rad) {
  if (!gyro.tilt_known) return {};
  if (!gyro.tilt_guessed) return {.roll_rad = gyro.roll_rad, .pitch_rad = gyro.pitch_rad};
  const double left = std::exp(-gyro.tilt_unseen_s / kGroundLasts_s);
  const double same = std::exp(-gyro.tilt_unseen_m / kGroundChanges_m);
  // Who turns on it has it fall another way: ahead it rises by less pitch, to the left by roll.
  const double c = std::cos(yaw_rad - gyro.tilt_yaw_rad);
  const double s = std::sin(yaw_rad - gyro.tilt_yaw_rad);
  return {.roll_rad = left * (c * gyro.roll_rad + s * gyro.pitch_rad),
          .pitch_rad = left * (c * gyro.pitch_rad - s * gyro.roll_rad),
          .sigma_rad = kGroundSigma_rad * std::sqrt(1 - same * same)};
}

double unmeasured_sigma_m(const GyroTrack& gyro, const AntennaConfig& antenna) {
  return gyro.tilt_known ? 0.0 : std::abs(antenna.z_m) * kGroundSigma_rad;
}

TiltedArm tilted_arm(const GyroTrack& gyro, double yaw_rad, const AntennaConfig& antenna,
                     const EstimateConfig& config) {
  const TiltGuess tilt = guess_tilt(gyro, yaw_rad);
  const double sensor_rad = gyro.tilt_known ? to_rad(config.imu_orientation_sigma_deg) : 0.0;
  return {.arm = lever_arm(tilt.roll_rad, tilt.pitch_rad, antenna),
          .variance_m2 = square(antenna.z_m * sensor_rad),
          .guessed_m = std::abs(antenna.z_m) * tilt.sigma_rad};
}

}  // namespace drover::engine::estimate
