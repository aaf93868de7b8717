// The same for the DAMIAO motors of the arm on can1, ids 1 to 3, read by hand.
//
// Source: DM_Control_Python (DM_CAN.py) and its README. It shares nothing with the driver on
// purpose.
#pragma once

#include <string>

#include "drover/can_frame.h"

namespace drover::mission::damiao {

/// As mission::forbidden.
std::string forbidden(const CanFrame& frame);

}  // namespace drover::mission::damiao
