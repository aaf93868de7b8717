// What may leave towards a ZLAC8015D, and what each frame does.
#pragma once

#include "drivers/zlac8015d/settings.h"
#include "drivers/zlac8015d/setup_steps.h"
#include "drover/actuator.h"

namespace drover::zlac8015d {

using RuleList = FixedVector<FrameRule, 4>;

RuleList rules_of(const Settings& settings);

/// `steps`: the only values that may be written. `target`: what was asked last, and with it how an
/// enabled drive would turn. Anything else is forbidden: another object, all nodes at once, flash.
Effect effect(const CanFrame& frame, const Settings& settings, const StepList& steps,
              const Pair& target);

}  // namespace drover::zlac8015d
