// Lines for the journal, of this program and of the DDS library in it.
#pragma once

#include <string_view>

#include "runtime/log.h"

namespace drover::ros2 {

using Level = runtime::LogLevel;

/// One line on standard error. Never waits while main's LogWriter lives: neither the loop, which
/// relays a stop, nor a thread of DDS' is held up by a journal that nobody reads.
inline void say(Level level, std::string_view text) {
  runtime::log(level, text);
}

/// From here on the DDS library's lines go the same way, at most ten at once and one a second: what
/// strangers send must not fill the journal.
void take_over_dds_log();

}  // namespace drover::ros2
