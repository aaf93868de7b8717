// droverd put together: threads, their exchanges, start and end.
#pragma once

#include <string>

#include "config/load.h"

namespace drover::runtime {

/// Runs until SIGTERM or SIGINT; returns the exit code. `file` is the configuration's name, for its
/// warnings; `record` is the file of a recording, or empty. Throws std::runtime_error for what
/// makes a start impossible (folders, sockets, a second daemon, a recording that cannot be made):
/// exit code 2.
int run_daemon(const config::Loaded& loaded, const std::string& file, const std::string& record);

}  // namespace drover::runtime
