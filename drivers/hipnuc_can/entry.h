// HiPNUC inertial sensors on CAN, for the registry.
#pragma once

#include "drover/registry.h"

namespace drover {

extern const DriverEntry kHipnucCanEntry;

}  // namespace drover
