// The set point of one joint outside the base: what was asked for, without a step in it.
#pragma once

#include <array>
#include <cstdint>
#include <string_view>

#include "drover/actuator.h"
#include "drover/command.h"
#include "drover/measurement.h"
#include "engine/config.h"
#include "engine/group/joint_weight.h"

namespace drover::engine {

/// Place and speed of a joint, as its drive told last.
struct JointMeasured {
  double position_rad = 0;
  double velocity_radps = 0;
  double effort_Nm = kAbsent;  ///< that the drive gives
};

/// What a message asks of a joint, in its order.
enum class JointValue : std::uint8_t { position, velocity, effort, stiffness, damping };
inline constexpr std::array<std::string_view, 5> kJointValueWords{"position", "velocity", "effort",
                                                                  "stiffness", "damping"};
/// A bit for each.
using JointValues = std::uint8_t;
constexpr JointValues bit(JointValue value) {
  return static_cast<JointValues>(1U << static_cast<unsigned>(value));
}

/// Begins without stiffness where the joint is. From then on the position moves by the joint's
/// limits of velocity and acceleration, stiffness, damping and effort rise and fall within
/// `rise_s`, and what drives the joint together (an effort, stiffness by a distance, damping by a
/// speed that it has not come to yet) stays within the limit of effort. Pure.
class JointShaper final {
 public:
  explicit JointShaper(const JointRules& rules) : rules_(rules), weight_(rules) {}

  /// The drive runs from now on, or again: nothing is remembered.
  void take_over(const JointMeasured& measured);

  /// One cycle of following.
  void follow(const JointTarget& target, const JointMeasured& measured, double dt_s);
  /// One cycle of keeping the place where it was when this began; what carried a weight then
  /// carries it on.
  void hold(const JointMeasured& measured, double dt_s) { hold(measured, dt_s, true); }
  /// `keeps_weight`: false where nobody knows what of its effort was a weight's.
  void hold(const JointMeasured& measured, double dt_s, bool keeps_weight);
  /// One cycle of damping alone.
  void damp(const JointMeasured& measured, double dt_s);

  /// Where the set point is; nearer is what is told, where its distance is beyond the limit of
  /// effort.
  double position_rad() const { return position_rad_; }
  double velocity_radps() const { return told_velocity_radps_; }
  const Impedance& impedance() const { return told_; }
  /// What was beyond the joint's limits in the last cycle of following, or its drive's.
  JointValues limited() const { return limited_; }

 private:
  double within(JointValue what, double value, double low, double high);
  double speeds_up_Nm(double velocity_radps, const JointMeasured& measured) const;
  double nearer(double position_rad, double besides_Nm, const JointMeasured& measured);
  double drawn(double stiffness) const;
  double risen(double dt_s) const;
  void keep_torque(double stiffness_before, const JointMeasured& measured);
  void draw_to(double gives_Nm, const JointMeasured& measured);
  void approach_gains(double stiffness, double damping, double effort, double dt_s);
  void approach_position(double wanted_rad, double wanted_radps, double fastest_radps, double dt_s);
  void approach_velocity(double wanted_radps, double dt_s);
  double within_ends(double velocity_radps);
  void end_at(double end_rad, double dt_s);
  double ahead_radps(const JointTarget& target, double wanted_radps, double dt_s);
  void follow_position(const JointTarget& target, double stiffness, double damping,
                       const JointMeasured& measured, double dt_s);
  void follow_velocity(const JointTarget& target, const JointMeasured& measured, double dt_s);
  void follow_effort(const JointTarget& target, const JointMeasured& measured, double dt_s);
  double kept(double effort_Nm, const JointMeasured& measured) const;
  double begins_to_hold_radps(const JointMeasured& measured) const;
  double gives_Nm(const JointMeasured& measured) const;
  void begin_hold(const JointMeasured& measured, bool keeps_weight);
  void look_at_weight(const JointMeasured& measured, double dt_s);
  void go_on(double gave_Nm, const JointMeasured& measured);
  void tell(double velocity_radps, const JointMeasured& measured);

  JointRules rules_;
  double position_rad_ = 0;  ///< of the set point
  double velocity_radps_ = 0;
  double stiffness_ = 0;
  double damping_ = 0;
  // The largest of each since it was last what it is to be: goes up and down by a share of that.
  double stiffest_ = 0;
  double most_damped_ = 0;
  double effort_Nm_ = 0;
  double asked_rad_ = kAbsent;  ///< by the command before
  double stands_s_ = 0;         ///< for so long it asks for the same place
  bool holds_ = false;
  JointWeight weight_;   ///< while it holds
  double held_rad_ = 0;  ///< it was measured, in the cycle of holding before
  JointValues limited_ = 0;
  double told_velocity_radps_ = 0;
  Impedance told_;
};

}  // namespace drover::engine
