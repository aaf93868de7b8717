// How late one recorded speed is behind another.
#pragma once

#include <string>

#include "calibrate/calibrate.h"
#include "calibrate/chain.h"

namespace drover::calibrate {

/// What to drive where a delay does not show.
inline constexpr const char* kDriveSpeeds =
    "change the speed while straight, from 0.2 m/s to the highest and back, three times";

struct Late {
  bool known = false;
  double late_s = 0;
  double sigma_s = 0;
  std::string refused;  ///< when it is not known
};

/// From what the rims were told to what they did: a dead time and a first-order lag, together.
Late drive_late(const Drive& drive);

/// Of the receiver's own speed behind the antenna's, by wheels and turn.
Late speed_late(const Drive& drive, const Chain& chain);

/// Whether the errors of the receiver's speed are those of the way between its positions.
struct SpeedVerdict {
  SpeedSource source = SpeedSource::unknown;
  std::string refused;
};
SpeedVerdict judge_speed(const Drive& drive, const Chain& chain, const Late& late,
                         double position_sigma_s);

}  // namespace drover::calibrate
