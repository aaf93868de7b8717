// `drover calibrate`: the robot's own numbers from a drive that was recorded.
#pragma once

#include <CLI/CLI.hpp>
#include <string>

namespace drover::cli {

/// `socket` and `code` outlive `app`.
void add_calibrate_command(CLI::App& app, const std::string& socket, int& code);

}  // namespace drover::cli
