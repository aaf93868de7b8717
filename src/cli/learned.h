// `drover learned`: what drives taught the robot of itself.
#pragma once

#include <CLI/CLI.hpp>
#include <string>

namespace drover::cli {

/// Adds learned. `socket` and `code`, into which the exit code goes, must outlive the app. The
/// commands throw NoAnswer.
void add_learned_commands(CLI::App& app, const std::string& socket, int& code);

}  // namespace drover::cli
