// One lab run from boot to exit status.
#pragma once

#include "options.h"

namespace drover::lab {

// Exit codes that are not the command's own.
constexpr int kTimedOut = 124;
constexpr int kLabBroke = 125;  // the kernel ended without a status; its log was shown

/// Boots, copies output, waits, removes every trace. Throws std::runtime_error when it
/// cannot start.
int run_session(const Options& options);

}  // namespace drover::lab
