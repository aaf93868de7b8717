// What a drive can tell, and what to drive for the rest.
#pragma once

#include "calibrate/chain.h"
#include "calibrate/fit.h"
#include "calibrate/lag.h"

namespace drover::calibrate {

/// Of the drive alone, before anything is fitted. Empty: it may be of use.
std::string too_little(const Drive& drive);

/// Ways and turns by the numbers that were found.
void measure_drive(const Drive& drive, const Chain& chain, DriveFacts& facts);

struct Evidence {
  const Drive& drive;
  const Configured& configured;
  const DriveFacts& facts;
  const Fit& fit;
  const Late& drive_lag;
  const Late& speed_late;
};
/// Each Quantity with its interval, or with what to drive.
std::vector<Found> judge(const Evidence& evidence);

}  // namespace drover::calibrate
