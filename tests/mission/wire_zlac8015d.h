// The same for a ZLAC8015D, node 1, read by hand.
//
// Source: "ZLAC8015D CANopen Communication Routine V1.07"; CiA 301 for the service channel. It
// shares nothing with the driver on purpose.
#pragma once

#include <array>
#include <optional>
#include <string>

#include "drover/can_frame.h"

namespace drover::mission::zlac8015d {

/// Targets of the left and the right motor, in motor turns a second, positive ahead: the right one
/// is mounted against the left one.
std::optional<std::array<float, 2>> targets_turnps(const CanFrame& frame);

/// What the guard asks of a node that takes no process data: a target of zero.
bool is_zero_by_service(const CanFrame& frame);

/// As mission::forbidden.
std::string forbidden(const CanFrame& frame);

}  // namespace drover::mission::zlac8015d
