// Compares the way by wheels and gyro with the way by RTK positions, over a second for slipping
// wheels and over many seconds for positions that drift away (a wrong base, a spoofer).
#pragma once

#include <array>

#include "drover/time.h"
#include "engine/config.h"
#include "engine/estimate/filter.h"

namespace drover::engine::estimate {

/// Both ways since one RTK position.
struct Leg {
  Time since = kNever;  ///< kNever: not begun
  double x_m = 0;       ///< base_link by that position, in `map`
  double y_m = 0;
  double sigma_m = 0;  ///< of that position
  double east_m = 0;   ///< dead reckoned from there
  double north_m = 0;
  double way_m = 0;  ///< rolled, either direction
  double turn_rad = 0;

  void advance(double east, double north, double way, double turn) {
    east_m += east;
    north_m += north;
    way_m += way;
    turn_rad += turn;
  }
};

/// An RTK fix, turned into the place of base_link.
struct BaseFix {
  double x_m = 0;
  double y_m = 0;
  double sigma_m = 0;
};

struct MotionWatch {
  Leg brief;
  std::array<Leg, 2> lasting;  ///< the younger begins when the older is half as old as it may be
  double last_gap_m = 0;
  double last_east_m = 0;  ///< how far the last position was from dead reckoning
  double last_north_m = 0;
  double largest_step_m = 0;  ///< how much of the gap came between two positions: a jump is no slip

  Time slip_since = kNever;  ///< kNever: the wheels do not slip
  double wheel_mps = 0;      ///< while they do
  double receiver_mps = 0;
  double slipped_m = 0;  ///< and how much the ways of both differ in the legs that are over
  Time drift_since = kNever;
  double drift_m = 0;  ///< how far the position went away from the wheels
  /// It drifted for long enough to be told. Time alone does not end that: the base stands, and what
  /// the receiver says comes back to where dead reckoning is; or a person accepts it.
  bool drifted = false;
  Time back_since = kNever;  ///< it is back, and the base stands
  double crab_rad = 0;       ///< course less heading on straights, as learned
  double crab_way_m = 0;     ///< over this way

  bool slipping() const { return slip_since != kNever; }
  /// The base hardly follows its wheels, or the receiver is stuck: nobody can tell which.
  bool stuck(Time now, Duration patience) const {
    return slipping() && now - slip_since >= patience && receiver_mps < 0.4 * wheel_mps;
  }
  /// Nobody can tell any more whether it comes back: the wheels were not heard, or it was pushed.
  bool lost_track() const { return drifted && lasting[0].since == kNever; }
  /// How wrong the speed by wheels may be, m/s.
  double slip_mps() const;
  /// A step of dead reckoning; `way` rolled in either direction.
  void advance(double east, double north, double way, double turn);
  /// Without positions to compare with: begins anew with the next one. What was learned of the
  /// mounting stays, and the comparison with a drifted position goes on.
  void pause();
  /// Nobody knows what was driven: likewise, but that comparison is over.
  void lose();
  /// Another receiver or another place: only what was learned of the mounting stays.
  void forget();
};

/// A fix before it is judged by the gate. When wheels begin to slip the belief loses trust in its
/// place along the way, so that the fixes are followed.
void watch_slip(MotionWatch& watch, Belief& belief, const BaseFix& fix, Time now);
/// A fix that was believed. `stands`: the base does, by wheels and gyro.
void watch_drift(MotionWatch& watch, const Belief& belief, const BaseFix& fix, Time now,
                 bool stands, const EstimateConfig& config);

}  // namespace drover::engine::estimate
