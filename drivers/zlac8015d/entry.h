// The registry's line for ZLAC8015D drives.
#pragma once

#include "drover/registry.h"

namespace drover {

extern const DriverEntry kZlac8015dEntry;

}  // namespace drover
