// `drover estimate`: what the robot's estimator makes of a log or of a recording.
#pragma once

#include <CLI/CLI.hpp>

namespace drover::cli {

/// `code` outlives `app`.
void add_estimate_command(CLI::App& app, int& code);

}  // namespace drover::cli
