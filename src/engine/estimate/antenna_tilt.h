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

/// While the sensor is silent the last tilt, on ground which the base turns on and drives away
/// from. Level and known where there never was a sensor.
TiltGuess guess_tilt(const GyroTrack& gyro, double yaw_rad);

/// How far the antenna may be from over a level base where no sensor ever told how it is tilted,
/// as a sigma, m. For people: the place is used as if the ground were level.
double unmeasured_sigma_m(const GyroTrack& gyro, const AntennaConfig& antenna);

struct TiltedArm {
  LeverArm arm;
  double variance_m2 = 0;  ///< of where the antenna is, by the sensor of the tilt
  double guessed_m = 0;    ///< sigma of it while that is silent, m; not white: it stays
};

TiltedArm tilted_arm(const GyroTrack& gyro, double yaw_rad, const AntennaConfig& antenna,
                     const EstimateConfig& config);

}  // namespace drover::engine::estimate
