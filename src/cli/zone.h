// The commands about zones: where the robot may be, and where not.
#pragma once

#include <CLI/CLI.hpp>
#include <string>

namespace drover::cli {

/// Adds zone. `socket` and `code`, into which the exit code goes, must outlive the app. The
/// commands throw NoAnswer and WrongUsage.
void add_zone_commands(CLI::App& app, const std::string& socket, int& code);

}  // namespace drover::cli
