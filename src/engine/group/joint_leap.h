// A place that a joint cannot have come to since its drive told the one before.
#pragma once

#include "engine/group/joint_shaper.h"

namespace drover::engine {

/// One frame that lies is passed over: a set point is bound to where the joint is measured, so that
/// it would be a step of torque. What stays where it leapt to, or leaps again and again, is a place
/// that is not known any more. Pure.
class JointLeap final {
 public:
  /// Its drive came into closed loop, or somebody else has it.
  void begin() { *this = JointLeap(); }
  /// What to go by now: `told` at `at`, or the last that could be. Of a drive that tells no speed
  /// (NaN) each is taken.
  JointMeasured look(const JointMeasured& told, Time at);
  /// Since the last look: why its places are not believed; empty: they are.
  const Reason& why() const { return why_; }

 private:
  JointMeasured last_;   ///< that was taken
  Time taken_ = kNever;  ///< when
  Time heard_ = kNever;  ///< the last one, taken or not
  double leaps_ = 0;     ///< of late
  Reason why_;
};

}  // namespace drover::engine
