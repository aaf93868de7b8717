// The registry's line for a plain digital input.
#pragma once

#include "drover/registry.h"

namespace drover {

extern const DriverEntry kGpioLineEntry;

}  // namespace drover
