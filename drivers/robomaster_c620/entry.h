// The registry's line for RoboMaster motors.
#pragma once

#include "drover/registry.h"

namespace drover {

extern const DriverEntry kRobomasterC620Entry;

}  // namespace drover
