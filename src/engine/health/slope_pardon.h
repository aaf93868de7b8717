// Where a cut would let the base roll away: what drives on there, and what is spared because it
// only rolls, creeps or stands.
#pragma once

#include "engine/health/motion_witness.h"
#include "engine/health/rest_input.h"
#include "engine/health/rim_motion.h"

namespace drover::engine {

/// How the base was driven, and since when it should rest.
struct LastDrive {
  double direction = 0;    ///< RimMotion::ahead of the last command of one who drove
  double turn = 0;         ///< RimMotion::turn of it
  double fastest_mps = 0;  ///< that was asked of a rim, since it rested last before
  bool inherited = false;  ///< the program before this one may have, and it has not rested yet
  Time rest_due = kNever;  ///< as RestWatch has it, but it does not move on while it rests
  double seen_mps = 0;     ///< what the receiver said first since then
};

/// One cycle. What a cut would set in motion must be seen to drive, by what cannot be wrong alone.
struct SlopePardon {
  const RestInput& input;
  const MotionWitness& witness;
  const LastDrive& last;

  /// By a receiver with a fix. What goes by 5 cm in a second passes for standing at first.
  bool stands() const;
  /// By the wheels, or by two devices, or by one that does not contradict itself.
  bool goes(bool wheels_turn) const;
  /// Driven on, rather than rolling down where it stands. Only what shows it counts.
  bool drives_on(const RimMotion& rims) const;
  /// It is not heard, and the receiver shows that it goes down slowly.
  bool creeps_unheard() const;
  /// Its supply is away: faster than it was ever driven, or back; and not up. How fast the program
  /// before this one drove it is not known.
  bool rolls() const;

 private:
  bool creeps_down(double ahead, double mps) const;
  double ahead_m() const;
};

}  // namespace drover::engine
