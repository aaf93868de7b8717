// The registry's line for drives of CiA 402.
#pragma once

#include "drover/registry.h"

namespace drover {

extern const DriverEntry kCia402Entry;

}  // namespace drover
