// Lines for the journal, of this program and of the DDS library in it.
#pragma once

#include <string_view>

namespace drover::ros2 {

enum class Level { error = 3, warning = 4, info = 6 };

/// One line on standard error. Below systemd with the level that the journal understands.
void say(Level level, std::string_view text);

/// From here on the DDS library's lines go the same way, at most ten at once and one a second: what
/// strangers send must not fill the journal.
void take_over_dds_log();

}  // namespace drover::ros2
