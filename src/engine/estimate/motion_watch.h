// Compares the way by wheels and gyro with the way by RTK positions, over a second for slipping
// wheels and over many seconds for positions that drift away (a wrong base, a spoofer).
//
// Driving, a place that drifts aside cannot be told from an antenna line that is mounted askew, nor
// from ground that falls to one side; standing, it can: only the drift goes on. So a suspicion asks
// for rest.
#pragma once

#include <array>

#include "drover/time.h"
#include "engine/config.h"
#include "engine/estimate/filter.h"
#include "engine/estimate/mounting.h"

namespace drover::engine::estimate {

/// A step of dead reckoning.
struct Step {
  double east_m = 0;
  double north_m = 0;
  double way_m = 0;  ///< rolled, either direction
  double turn_rad = 0;
  double slope_rad = 0;  ///< the ground falls so much to the right; NaN: not known
};

/// An RTK fix, turned into the place of base_link.
struct BaseFix {
  double x_m = 0;
  double y_m = 0;
  double sigma_m = 0;
};

/// Both ways since one RTK position.
struct Leg {
  Time since = kNever;  ///< kNever: not begun
  double x_m = 0;       ///< base_link by that position, in `map`
  double y_m = 0;
  double sigma_m = 0;  ///< of that position
  double east_m = 0;   ///< dead reckoned from there
  double north_m = 0;
  double way_m = 0;
  double turn_rad = 0;
  double fall_m = 0;  ///< of the ground to the right, over that way; NaN: not known
  // Of the way what led east, north and both at once, there or back: a share of the way that is
  // lost, and not the same one everywhere, moves the end by so much.
  double spread_ee_m = 0;
  double spread_en_m = 0;
  double spread_nn_m = 0;

  void advance(const Step& step);
  /// As if the heading had been another all the way.
  void turn(double rad);
};

inline Leg begin_leg(const BaseFix& fix, Time now) {
  Leg leg;
  leg.since = now;
  leg.x_m = fix.x_m;
  leg.y_m = fix.y_m;
  leg.sigma_m = fix.sigma_m;
  return leg;
}

/// What looks found: so much the base goes aside of its heading.
struct Sideways {
  double slide_share = 0;  ///< of the slope to the side, wherever that is known
  double crab_rad = 0;     ///< and what else there is, while it drives on in that direction
  double course_rad = 0;
  bool any_direction = false;  ///< the ground was level, so it is of the base
};

/// A suspicion that the position drifts, from its beginning until standing has decided it.
struct Look {
  Time since = kNever;  ///< kNever: nothing is suspected
  bool along = false;   ///< wheels slip, if it is no drift: who drives on may have it decided later
  double east = 0;      ///< direction of the gap between the fixes and dead reckoning
  double north = 0;
  double rate_mps = 0;  ///< at which they parted
  double sigma_m = 0;   ///< of the fixes since it rests, smoothed
  // What it was if it was none, by the youngest leg that shows it; without a chord: none does.
  double across_m = 0;
  double chord_m = 0;
  double course_rad = 0;
  double fall_m = 0;
  bool recent = false;  ///< that leg is the last metres
  StraightLeg lesson;   ///< likewise, of the mounting
  Time moving = kNever;
  Time resting = kNever;
  int fixes = 0;       ///< since it rests
  double first_m = 0;  ///< along that direction: where it stood first, and stands by now
  double by_now_m = 0;
};

struct MotionWatch {
  Leg brief;
  std::array<Leg, 2> lasting;  ///< the younger begins when the older is half as old as it may be
  std::array<Leg, 2> recent;   ///< likewise, of some metres
  Leg study;                   ///< for the mounting of the antenna line
  Look look;
  Sideways sideways;
  double gap_m = 0;     ///< how far the last fix is beside the older of the lasting legs
  double stayed_m = 0;  ///< so far beside it was when a look found no drift; of this fix
  double last_gap_m = 0;
  double last_east_m = 0;  ///< how far the last position was from dead reckoning
  double last_north_m = 0;
  double largest_step_m = 0;  ///< how much of the gap came between two positions: a jump is no slip

  Time slip_since = kNever;  ///< kNever: the wheels do not slip
  double wheel_mps = 0;      ///< while they do
  double receiver_mps = 0;
  double slipped_m = 0;  ///< and how much the ways of both differ in the legs that are over
  /// Learned of the wheels before the brief leg, and before the one before that; 0: not known.
  std::array<double, 2> scale_before{};
  Time stuck_since = kNever;  ///< hardly any of what the wheels roll is seen by the receiver
  double unseen_slip_m = 0;   ///< likewise, of late, since a look found no drift behind it
  Time drift_since = kNever;
  double drift_m = 0;  ///< how far the position went away from the wheels
  /// It drifted for long enough to be told. Time alone does not end that: the base stands, and what
  /// the receiver says comes back to where dead reckoning is; or a person accepts it.
  bool drifted = false;
  Time back_since = kNever;  ///< it is back, and the base stands

  /// Course beside the heading by what looks found, on ground that falls so much to the right (NaN:
  /// nobody knows).
  double crab_rad(double yaw_rad, double slope_rad) const;
  bool looks() const { return look.since != kNever; }
  bool slipping() const { return slip_since != kNever; }
  /// The base hardly follows its wheels, or the receiver is stuck: nobody can tell which.
  bool stuck(Time now, Duration patience) const {
    return stuck_since != kNever && now - stuck_since >= patience;
  }
  /// Nobody can tell any more whether it comes back: the wheels were not heard, or it was pushed.
  bool lost_track() const { return drifted && lasting[0].since == kNever; }
  /// How wrong the speed by wheels may be, m/s.
  double slip_mps() const;
  /// A step by the heading; the way goes so much beside it.
  void advance(Step step, double crab_rad);
  /// The heading is corrected by this, because of its mounting.
  void turn_heading(double yaw_rad, double by_rad);
  /// Without positions to compare with: begins anew with the next one. What a look found stays, and
  /// the comparison with a position that drifted, or is suspected to, goes on.
  void pause();
  /// Likewise; a look begins anew, because another fix may well be another place. Wheels that slip
  /// go on slipping until a fix shows that they do not.
  void lose_fix();
  /// Nobody knows what was driven: likewise, but that comparison is over.
  void lose();
  /// Another receiver or another place.
  void forget() { *this = {}; }
};

/// A fix before it is judged by the gate. When wheels begin to slip the belief loses trust in its
/// place along the way, so that the fixes are followed.
void watch_slip(MotionWatch& watch, Belief& belief, const BaseFix& fix, Time now,
                const EstimateConfig& config);
/// What is known of the base's rest and its ground by wheels, gyro and tilt.
struct Ground {
  bool stands = false;
  double slope_rad = kAbsent;  ///< it falls so much to the right; NaN: nobody knows
};

/// A fix that was believed.
void watch_drift(MotionWatch& watch, Mounting& mounting, const Belief& belief, const BaseFix& fix,
                 Time now, const Ground& ground, const EstimateConfig& config);

}  // namespace drover::engine::estimate
