#include "engine/estimate/antenna_tilt.h"

#include <cmath>

#include "drover/angle.h"
#include "engine/estimate/model_gnss.h"

namespace drover::engine::estimate {
namespace {

// The ground changes like this while a base drives: it begins to at once, and of any field nothing
// else is known than this sigma, of which two are as steep as ramps are. That it is the same one is
// likelier for longer.
constexpr double kGroundChanges_s = 5.0;
constexpr double kGroundLasts_s = 20.0;
constexpr double kGroundSigma_rad = to_rad(5.0);

}  // namespace

TiltGuess guess_tilt(const GyroTrack& gyro) {
  if (!gyro.tilt_known) return {};
  const double left = std::exp(-gyro.tilt_unseen_s / kGroundLasts_s);
  const double same = std::exp(-gyro.tilt_unseen_s / kGroundChanges_s);
  return {.roll_rad = left * gyro.roll_rad,
          .pitch_rad = left * gyro.pitch_rad,
          .sigma_rad = kGroundSigma_rad * std::sqrt(1 - same * same)};
}

TiltedArm tilted_arm(const GyroTrack& gyro, const AntennaConfig& antenna,
                     const EstimateConfig& config) {
  const TiltGuess tilt = guess_tilt(gyro);
  const double sensor_rad = gyro.tilt_known ? to_rad(config.imu_orientation_sigma_deg) : 0.0;
  return {.arm = lever_arm(tilt.roll_rad, tilt.pitch_rad, antenna),
          .variance_m2 = square(antenna.z_m * sensor_rad),
          .guessed_m = std::abs(antenna.z_m) * tilt.sigma_rad};
}

}  // namespace drover::engine::estimate
