// The same for CubeMars motors in MIT mode, of an arm on can1, ids 1 to 3, which answer under their
// own, read by hand.
//
// Source: AK Series Actuator Driver Manual V1.0.8, chapter 5.3. It shares nothing with the driver
// on purpose.
#pragma once

#include <string>

#include "drover/can_frame.h"

namespace drover::mission::cubemars_mit {

/// As mission::forbidden.
std::string forbidden(const CanFrame& frame);

}  // namespace drover::mission::cubemars_mit
