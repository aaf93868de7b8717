// One motor: what it told, and the speed loop that its controller does not have. At the joint,
// behind the gear. Pure: a current is what comes out.
#pragma once

#include "drivers/robomaster_c620/settings.h"

namespace drover::robomaster {

class Motor final {
 public:
  Motor(const Settings& settings, std::size_t channel);

  void on_feedback(const Feedback& feedback, Time received);
  /// Of the line, or of what hangs on it: what it told counts no more.
  void forget();

  Time last() const { return last_; }
  /// Nothing that it told is older.
  bool heard_within(Duration age, Time now) const { return last_ != kNever && now - last_ <= age; }
  double position_rad() const { return position_rad_; }
  double velocity_radps() const { return velocity_radps_; }
  double effort_Nm() const;
  /// Of the motor; absent where it is not told.
  double degC() const;
  bool too_hot() const;
  /// It is pushed hard and tells the same angle for ever: nobody sees what it does.
  bool is_stuck() const { return stuck_; }
  /// A current is asked of it, and it tells that it has none: a line to it is torn, for what is
  /// known. It gets none until it begins anew.
  bool is_torn() const { return torn_; }
  /// It may be: by what it told last it has none.
  bool lacks_current() const { return without_since_ != kNever; }
  bool tells_current() const { return tells_current_; }
  /// Those of one kind tell it all, or none.
  void expect_current() { tells_current_ = true; }
  void begin_anew();

  /// The current that makes it follow: PI, with a ramp, and what is more than the limit is not
  /// added up.
  void follow(double wanted_radps, Duration dt, Time now);
  /// Brakes towards `slowest_radps`, never faster than it turns. At rest it is kept where it
  /// stands.
  void brake(double slowest_radps, Duration dt, Time now);
  void coast();

  /// What was asked for last, on the wire.
  std::int16_t counts() const { return counts_; }
  /// No more than a brake asks for, by what it told last: it cannot make it turn.
  bool is_brake(std::int16_t counts, Time now) const;

 private:
  enum class Loop : std::uint8_t { coasting, braking, following };

  double limit_Nm() const;
  double brake_Nm() const;
  double spring_Nm() const;
  void begin_braking(Time now);
  void anchor(Time now);
  void ramp_to(double wanted_radps, Duration dt);
  bool is_asked(double share_of_limit, double frictions) const;
  bool has_current() const;
  void watch_angle(Time now);
  void watch_current(Time now);
  std::int16_t counts_of(double torque_Nm) const;

  const Settings& settings_;
  double sign_;

  // What it told.
  Time last_ = kNever;
  Feedback feedback_;
  bool angle_known_ = false;
  double position_rad_ = 0;
  double velocity_radps_ = 0;
  Time turned_at_ = kNever;     ///< when its angle was another one last
  Time pushed_since_ = kNever;  ///< hard, without a pause
  bool stuck_ = false;
  bool tells_current_ = false;   ///< it has told one
  Time without_since_ = kNever;  ///< asked for some, and tells that it has none
  bool torn_ = false;            ///< for long

  // The loop.
  Loop loop_ = Loop::coasting;
  double ramped_radps_ = 0;  ///< the set point, on its way
  double integral_Nm_ = 0;
  bool anchored_ = false;  ///< kept at `anchor_rad_`
  double anchor_rad_ = 0;
  double slowest_radps_ = 0;  ///< since it was to stand, and when it got slower last
  Time slower_at_ = kNever;
  std::int16_t counts_ = 0;
};

}  // namespace drover::robomaster
