// The little turn to each side on the first way: how it is asked for, and whether it happened.
#pragma once

#include <cstdint>

#include "drover/measurement.h"
#include "engine/config.h"

namespace drover::engine {

/// Since the motion began. Left is positive.
struct SwingInput {
  double rolled_m = 0;
  double asked_rad = 0;         ///< commanded; by the same account as the next one
  double wheels_rad = 0;        ///< by the base's own account
  double turned_rad = kAbsent;  ///< by the gyro, or else the receiver; absent: nobody knows
  bool by_places = false;       ///< where nobody does, the receiver's places are to show it
  bool shown = false;           ///< and have shown it
};

/// Straight, left, right, left again, straight. What drives do not follow at once, or tyres take
/// up, is no turn yet: each side is asked for longer, and for more, until it is seen to have
/// turned. One whose command is hindered (by an obstacle, say) is given up after a way, and proves
/// nothing. Where only places show a turn it is a wider one, with a straight way behind the first
/// turn: there they show it.
class Swing final {
 public:
  /// Over a way of `first_m`, where the robot turns as it is asked to.
  Swing(const BaseConfig& config, double first_m);

  /// The way that a base which turns on curves only needs for it; otherwise `first_m`.
  static double way_m(const BaseConfig& base, double first_m);

  void begin();
  void step(const SwingInput& input);
  /// What it asks for now, left positive, whichever way the robot rolls.
  double radpm() const;
  /// Where the robot turns as it is asked to.
  double usual_radpm() const;
  /// It was asked for to both sides, and straight again.
  bool is_over() const { return phase_ == Phase::over; }
  /// It was seen to turn to both sides; or nobody could see it.
  bool happened() const;
  /// So much was asked for, or said to have been turned by the base, and it was not seen.
  bool failed() const { return failed_; }
  /// Of the side that failed. What the base made of it is 0 where it made next to nothing.
  double asked_rad() const { return asked_rad_; }
  double wheels_rad() const { return wheels_rad_; }
  double turned_rad() const { return turned_rad_; }

 private:
  enum class Phase : std::uint8_t { before, left, right, back, after, over };

  double side() const;
  double least_m() const;
  bool turns() const { return phase_ == Phase::left || phase_ == Phase::right; }
  bool ends(const SwingInput& input) const;
  bool wide_ends(const SwingInput& input) const;
  void judge(const SwingInput& input);

  double first_m_;
  double most_asked_rad_;
  double most_more_;    ///< so many times the usual turn, at the most
  double least_share_;  ///< so much of the turn by the wheels is seen at least
  Phase phase_ = Phase::before;
  SwingInput from_;      ///< where the phase began
  double beyond_m_ = 0;  ///< rolled in this phase longer than usual
  bool wide_ = false;
  bool aslant_ = false;  ///< of a wide one: it has turned, and goes straight on
  bool known_ = false;
  bool left_ = false;
  bool right_ = false;
  bool failed_ = false;
  double asked_rad_ = 0;
  double wheels_rad_ = 0;
  double turned_rad_ = kAbsent;
};

}  // namespace drover::engine
