// Whether a joint comes to its set point, or presses on against something for ever.
#pragma once

#include "engine/group/joint_shaper.h"

namespace drover::engine {

/// A law of stiffness lags behind what pushes the joint, or hangs on it: that is what it is for,
/// up to most of the joint's limit of effort. What goes on to press harder, and comes no nearer,
/// is blocked, or told the wrong place, and heats its motor. An effort that is told presses on
/// purpose. Pure.
class JointArrival final {
 public:
  explicit JointArrival(const JointRules& rules) : rules_(rules) {}

  void begin() { *this = JointArrival(rules_); }
  /// One cycle after `told`, at `velocity_radps`, was told, on the way to `set_rad`.
  /// `followed`: for somebody.
  void look(const JointMeasured& measured, const Impedance& told, double set_rad,
            double velocity_radps, bool followed, double dt_s);

  /// It has pressed for long.
  bool presses() const { return pressed_s_ > kFor_s; }
  /// What is wrong; empty: it comes to its set point, or nobody knows yet.
  const Reason& why() const { return why_; }

 private:
  static constexpr double kFor_s = 2;

  void look_at_pressing(const JointMeasured& measured, const Impedance& told, double set_rad,
                        double velocity_radps, double dt_s);
  void look_at_way(const JointMeasured& measured, double velocity_radps, double dt_s);

  JointRules rules_;
  Reason why_;
  double pressed_s_ = 0;
  double way_ = 0;        ///< it presses: ahead or back
  double from_rad_ = 0;   ///< it pressed there first
  double asked_rad_ = 0;  ///< its set point went, in all, since the joint went with it
  double went_rad_ = 0;   ///< it went meanwhile
  double before_rad_ = kAbsent;
  double stays_s_ = 0;  ///< so long behind it
};

}  // namespace drover::engine
