// How the robot and each of its parts is, for diagnostic_msgs.
#pragma once

#include "drover/snapshot.h"
#include "json/json_text.h"

namespace drover::publish::ros2 {

/// Appends "diagnostics": a list of {name, level (0 good, 1 warning, 2 error), message, values}.
/// The robot itself comes first: its message is the cause why it does not move, or may not.
void write_diagnostics(json::JsonText& out, const Snapshot& seen);

}  // namespace drover::publish::ros2
