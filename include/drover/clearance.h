// How far the robot may go before it would touch something, or leave where it may be.
#pragma once

#include <cstdint>

#include "drover/fixed_text.h"
#include "drover/measurement.h"
#include "drover/time.h"
#include "drover/twist.h"

namespace drover {

/// Ways, each with what is not known of the position left out.
struct BareWays {
  double along_m = 0;
  double ahead_m = 0;
  double back_m = 0;
  double left_rad = 0;
  double right_rad = 0;
  double aside_left_m = 0;
  double aside_right_m = 0;
};

/// Made outside the control thread, of objects, zones, constraints and the points of obstacle
/// sensors, for one pose, one path and one twist: what is asked of another one it does not answer.
/// Ways begin where the base was at `t`, with the margin and the position's error taken off; what
/// was not looked at is not free. Never negative.
struct Clearance {
  Time t = kNever;          ///< of the pose that it is for
  std::uint64_t scene = 0;  ///< number of the scene's state, which grows with each change
  std::uint64_t path = 0;   ///< Path::number that `along_m` is for; 0: none
  Twist twist;              ///< whose curve was looked along, ahead and back
  double along_m = 0;       ///< on the path, to its goal
  double ahead_m = 0;
  double back_m = 0;
  double left_rad = 0;  ///< turning on the spot, counter-clockwise
  double right_rad = 0;
  double aside_left_m = 0;  ///< straight to the side, the heading kept; of a base that goes so
  double aside_right_m = 0;
  /// The same by the margin alone. An error of the position that grows in one moment takes a way
  /// away in which nothing came nearer: what is truly near is judged by these, where they are more.
  BareWays bare;
  /// What is met first on the way that is asked for, a turn on the spot too, and how far away, in
  /// an operator's words; empty: nothing near.
  Reason first;
  /// What ends the turn on the spot that is asked for, and after which angle; empty: nothing, or
  /// none is asked for.
  Reason turn;
  /// Why nothing can be said: no position, a blind sensor, a scene that could not be read. Then
  /// nothing is free.
  Reason unknown;
  /// Which constraint does not hold where the robot is, and why; empty: all do.
  Reason broken;
};

}  // namespace drover
