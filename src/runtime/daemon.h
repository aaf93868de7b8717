// droverd put together: threads, their exchanges, start and end.
#pragma once

#include <string>

#include "config/config.h"

namespace drover::runtime {

/// Runs until SIGTERM or SIGINT; returns the exit code. Throws std::runtime_error for what makes a
/// start impossible (folders, sockets, a second daemon): exit code 2.
int run_daemon(const config::DroverConfig& config);

}  // namespace drover::runtime
