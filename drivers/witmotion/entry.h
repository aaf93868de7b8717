// The registry's line for WitMotion inertial sensors.
#pragma once

#include "drover/registry.h"

namespace drover {

extern const DriverEntry kWitmotionEntry;

}  // namespace drover
