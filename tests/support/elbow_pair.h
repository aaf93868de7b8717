// Two joints of an arm behind one address, which nobody builds: for tests of what such a device
// needs of the configuration. It says nothing.
#pragma once

#include "drover/registry.h"

namespace drover::test {

extern const DriverEntry kElbowPairEntry;

}  // namespace drover::test
