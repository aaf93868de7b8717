// `drover calibrate`: the robot's own numbers from a drive that was recorded.
#pragma once

#include <CLI/CLI.hpp>

namespace drover::cli {

/// `code` outlives `app`.
void add_calibrate_command(CLI::App& app, int& code);

}  // namespace drover::cli
