// Lines for the journal: "<level>text", one write each, from any thread but the control thread.
#pragma once

#include <string_view>

namespace drover::runtime {

enum class LogLevel { error = 3, warning = 4, info = 6 };

/// Below systemd the level is a prefix that the journal understands; on a terminal it is left out.
void log(LogLevel level, std::string_view text);

}  // namespace drover::runtime
