// What is written into a ZLAC8015D each time it starts, or is found started.
#pragma once

#include "drivers/canopen/setup.h"
#include "drivers/zlac8015d/settings.h"

namespace drover::zlac8015d {

using StepList = FixedVector<canopen::SdoStep, 128>;

/// Targets of zero first: one that a dead gateway left is still in the drive.
StepList steps_of(const Settings& settings);
/// And between the others, for they feed its time-out: a drive that may hold the robot is not to
/// let go while it is set up, which takes half a second.
StepList fed_steps_of(const Settings& settings);

}  // namespace drover::zlac8015d
