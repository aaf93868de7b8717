// An AgileX Hunter on CAN, for the registry.
#pragma once

#include "drover/registry.h"

namespace drover {

extern const DriverEntry kAgilexHunterEntry;

}  // namespace drover
