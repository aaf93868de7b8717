// The commands about the planning scene: objects and constraints.
#pragma once

#include <CLI/CLI.hpp>
#include <string>

namespace drover::cli {

/// Adds scene. `socket` and `code`, into which the exit code goes, must outlive the app. The
/// commands throw NoAnswer.
void add_scene_commands(CLI::App& app, const std::string& socket, int& code);

}  // namespace drover::cli
