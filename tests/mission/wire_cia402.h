// The same for two nodes of CiA 402, 1 left and 2 right, whose 60FF counts turns a minute, by hand.
//
// Source: CiA 301 for the ids and the service channel, CiA 402-2 for the objects and the words. It
// shares nothing with the driver on purpose.
#pragma once

#include <optional>
#include <string>

#include "drover/can_frame.h"
#include "mission/wire.h"

namespace drover::mission::cia402 {

/// The target of one wheel, in turns of its motor a second, positive ahead: the right one is
/// mounted against the left one.
std::optional<WheelCommand> wheel_command(const CanFrame& frame);

/// What the guard asks of a node that takes no process data: a target of zero.
bool is_zero_by_service(const CanFrame& frame);

/// As mission::forbidden.
std::string forbidden(const CanFrame& frame);

}  // namespace drover::mission::cia402
