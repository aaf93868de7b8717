// The registry's line for a battery that is read over Modbus.
#pragma once

#include "drover/registry.h"

namespace drover {

extern const DriverEntry kModbusBmsEntry;

}  // namespace drover
