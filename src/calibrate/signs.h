// Which way round wheels, gyro and antenna line are, and first guesses of what the fit refines.
#pragma once

#include "calibrate/calibrate.h"

namespace drover::calibrate {

struct FirstGuess {
  double turn_gain = 1;    ///< true turn over that of the wheels, by the configured track
  double heading_rad = 0;  ///< of the antenna line from ahead, counter-clockwise
};

/// Linear regression of what the antenna did in windows of a second on what wheels and gyro say.
Signs find_signs(const Drive& drive, const Configured& configured, FirstGuess& guess);

}  // namespace drover::calibrate
