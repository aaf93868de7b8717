// What the navigator needs each cycle.
#pragma once

#include "engine/gate/target_gate.h"
#include "engine/health/health.h"
#include "engine/health/wheels.h"

namespace drover::engine {

struct NavInput {
  Time now = kNever;
  Duration dt{};
  const Estimate& estimate;
  const HealthReport& health;
  WheelFault wheels = WheelFault::none;
  const Reason& wheel_reason;
  bool at_rest = true;                          ///< the target gate commands nothing
  TargetRefusal refusal = TargetRefusal::none;  ///< of the last cycle
  double speed_cap_mps = 1e9;                   ///< of the first way after the start
  double along_cap_mps = 1e9;                   ///< of what is free along the track
  Reason unasked{};                             ///< as ClearanceWatch::unasked
  bool may_go_aside = false;                    ///< one that can
};

}  // namespace drover::engine
