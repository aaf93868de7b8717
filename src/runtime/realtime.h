// Real-time priority and locked memory, where the system allows them.
#pragma once

#include <string>

namespace drover::runtime {

/// For the calling thread. Returns what was not possible, for the log; empty when all was.
std::string become_real_time(int priority);

}  // namespace drover::runtime
