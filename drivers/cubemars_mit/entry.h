// The registry's line for CubeMars motors in MIT mode.
#pragma once

#include "drover/registry.h"

namespace drover {

extern const DriverEntry kCubemarsMitEntry;

}  // namespace drover
