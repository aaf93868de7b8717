// AgileX chassis that speak protocol v2 on CAN, for the registry.
#pragma once

#include "drover/registry.h"

namespace drover {

extern const DriverEntry kAgilexV2Entry;

}  // namespace drover
