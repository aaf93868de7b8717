// Frames as a serial-line CAN adapter writes them: tIIILDD..., TIIIIIIIILDD..., rIIIL, RIIIIIIIIL.
#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "drover/can_frame.h"

namespace drover::sim {

/// Appends one frame with its final carriage return. False for frames that the format cannot carry
/// (CAN FD, error frames).
bool append_slcan(std::string& text, const CanFrame& frame);
/// `line` without its carriage return. Nothing for commands ("S6", "O") and malformed frames.
std::optional<CanFrame> parse_slcan(std::string_view line);

}  // namespace drover::sim
