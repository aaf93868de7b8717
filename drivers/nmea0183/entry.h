// The registry's line for receivers that speak NMEA 0183.
#pragma once

#include "drover/registry.h"

namespace drover {

extern const DriverEntry kNmea0183Entry;

}  // namespace drover
