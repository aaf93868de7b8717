// A base that is pushed aside over the ground: no wheel tells of it, an inertial sensor does.
#pragma once

#include "drover/time.h"
#include "engine/estimate/filter.h"

namespace drover::engine::estimate {

/// Adds up what the sensor feels to the left, beyond turns and gravity. What lasts is forgotten
/// within a moment; what comes fast enough to be a shove is followed until the base is at rest
/// sideways again, a second at the longest: wheels do not go on sliding.
struct Shove {
  double usual_mps2 = 0;   ///< what is felt all the time: the sensor's zero, its tilt
  double left_mps = 0;     ///< by the sensor
  double fastest_mps = 0;  ///< of left_mps, with its sign
  Time since = kNever;     ///< kNever: nobody shoves it
  Time quiet = kNever;     ///< since when nothing pushes it
  double quiet_m = 0;      ///< added up since then
  double left_m = 0;       ///< so far, by the present or the last one
  double variance_m2 = 0;  ///< that the belief was given for it
  Time ended = kNever;     ///< the last one

  bool holds() const { return since != kNever; }
};

/// `left_mps2` of the base over `dt_s` until `now`, without gravity and turns; `may_begin`: it
/// drives and does not rock. Moves the belief.
void follow(Shove& shove, Belief& belief, double left_mps2, double dt_s, bool may_begin, Time now);

}  // namespace drover::engine::estimate
