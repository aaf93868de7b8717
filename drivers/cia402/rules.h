// What may leave towards a drive of CiA 402, and what each frame does.
#pragma once

#include "drivers/cia402/codec.h"
#include "drivers/cia402/settings.h"
#include "drover/actuator.h"

namespace drover::cia402 {

using RuleList = FixedVector<FrameRule, 4>;

RuleList rules_of(const Settings& settings);

/// `steps`: the only values that may be written. Anything else is forbidden: another object, all
/// nodes at once, flash, a target beside any word but the one that enables.
Effect effect(const CanFrame& frame, const Settings& settings, const StepList& steps);

}  // namespace drover::cia402
