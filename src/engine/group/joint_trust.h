// Whether what a joint's drive measures can be believed: its torque goes the way it is told, and
// its encoder turns with it.
#pragma once

#include "engine/group/joint_shaper.h"

namespace drover::engine {

/// Where it cannot, no law that is made of it holds the joint: keeping its place, or an effort,
/// would drive it on. Pure.
///
/// The sign is asked for from when the drive came into closed loop until the joint went with its
/// set point for a while: until then somebody who pushes against it looks alike. Afterwards he is
/// known, and asked is only for a flight: far beyond its fastest speed, and ever faster, against
/// nearly all of its effort.
class JointTrust final {
 public:
  explicit JointTrust(const JointRules& rules);

  /// Its drive came into closed loop: nothing is known.
  void begin() { *this = JointTrust(rules_); }
  /// One cycle after `told`, at `velocity_radps`, was told; `since_s`: from the measurement before
  /// to this one; 0: it is the same. Why it is not believed; empty: it is.
  Reason look(const JointMeasured& measured, double since_s, const Impedance& told,
              double velocity_radps);
  /// Somebody else has it, or it is not believed anyhow.
  void look_away();
  /// After that, told to damp: it gets faster the way it went.
  bool runs_on(const JointMeasured& measured) const;

 private:
  void follow(const JointMeasured& measured, double velocity_radps, double since_s);
  bool is_proved() const;
  bool is_fast(double speed_radps) const;
  bool goes_against(double speed_radps, double wanted_Nm, double gives_Nm) const;
  Reason look_at_sign(const JointMeasured& measured, double wanted_Nm, double gives_Nm,
                      double since_s);
  Reason look_at_encoder(const JointMeasured& measured, double gives_Nm, double since_s);
  Reason look_at_range(const JointMeasured& measured) const;
  bool stands(const JointMeasured& measured) const;
  void forget_stand();
  Reason look_at_motion(const JointMeasured& measured, double since_s);

  JointRules rules_;
  double with_rad_ = 0;     ///< it went with its set point
  double against_rad_ = 0;  ///< against what is wanted of it, and ever faster
  double began_radps_ = 0;  ///< that
  double fastest_radps_ = 0;
  int faster_ = 0;               ///< than before, so many times since
  double stands_rad_ = kAbsent;  ///< to the bit
  double least_Nm_ = 0;          ///< told since
  double most_Nm_ = 0;
  double stands_s_ = 0;           ///< though what was told changed by much
  bool fast_ = false;             ///< in the measurement before
  double moved_radps_ = kAbsent;  ///< when it was fast last
  double moved_s_ = 0;            ///< so long ago
  double still_s_ = 0;            ///< to the bit
};

}  // namespace drover::engine
