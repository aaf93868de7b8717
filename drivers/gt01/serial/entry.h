// The serial chassis' line for the registry.
#pragma once

#include "drover/registry.h"

namespace drover {

extern const DriverEntry kGt01SerialEntry;

}  // namespace drover
