// A word to a socket of packets, and the packet that comes back: how drover-guard is asked.
#pragma once

#include <chrono>
#include <string>
#include <string_view>

#include "drover/result.h"

namespace drover::link {

/// Waits for `patience` at each step, as long as three of them at most. The error is errno's:
/// ENOENT or ECONNREFUSED where nobody listens, EAGAIN or EINPROGRESS where nobody answers.
Result<std::string, int> ask_packet(const std::string& path, std::string_view word,
                                    std::chrono::milliseconds patience);

}  // namespace drover::link
