// What a joint truly does beside what it was told: whether its drive drives it beyond its limits.
#pragma once

#include "engine/group/joint_shaper.h"

namespace drover::engine {

/// A set point within the limits does not keep the joint within them: an effort alone, or a speed
/// without stiffness, drives on what nothing holds back. Somebody who pushes is none of this: it
/// counts only where what the drive was told drives the joint that way. Pure.
class JointWatch final {
 public:
  explicit JointWatch(const JointRules& rules) : rules_(rules) {}

  /// One cycle after `told`, at `velocity_radps`, was told: why the joint has to be stopped; empty:
  /// it may go on.
  Reason look(const JointMeasured& measured, const Impedance& told, double velocity_radps,
              double dt_s);
  void begin() { fast_s_ = drawn_s_ = beyond_s_ = 0; }

 private:
  JointRules rules_;
  // For so long, now:
  double fast_s_ = 0;    ///< its effort drives it, too fast
  double drawn_s_ = 0;   ///< or its stiffness does
  double beyond_s_ = 0;  ///< it is driven on beyond an end
};

}  // namespace drover::engine
