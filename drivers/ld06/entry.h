// The registry's line for the scanners LD06 and LD19.
#pragma once

#include "drover/registry.h"

namespace drover {

extern const DriverEntry kLd06Entry;

}  // namespace drover
