// The registry's line for ODrive axes.
#pragma once

#include "drover/registry.h"

namespace drover {

extern const DriverEntry kOdriveEntry;

}  // namespace drover
