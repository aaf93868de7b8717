// The registry's line for DAMIAO motors.
#pragma once

#include "drover/registry.h"

namespace drover {

extern const DriverEntry kDamiaoEntry;

}  // namespace drover
