// Where the antenna is over a base that stands on ground that is not level, also while the inertial
// sensor is silent: the ground is about as steep as it was.
#pragma once

#include "engine/config.h"
#include "engine/estimate/course.h"
#include "engine/estimate/gyro_track.h"

namespace drover::engine::estimate {

/// Roll and pitch of the base, measured or guessed.
struct TiltGuess {
  double roll_rad = 0;
  double pitch_rad = 0;
  double sigma_rad = 0;  ///< of either, beside what the sensor errs by; 0: it is heard
};

/// While the sensor is silent the last tilt, which the base drives away from. Level and known where
/// there never was a sensor.
TiltGuess guess_tilt(const GyroTrack& gyro);

struct TiltedArm {
  LeverArm arm;
  double variance_m2 = 0;  ///< of where the antenna is, by the sensor of the tilt
  double guessed_m = 0;    ///< sigma of it while that is silent, m; not white: it stays
};

TiltedArm tilted_arm(const GyroTrack& gyro, const AntennaConfig& antenna,
                     const EstimateConfig& config);

}  // namespace drover::engine::estimate
