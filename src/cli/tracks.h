// drover traj, drover task: saved tracks, and driving along one.
#pragma once

#include <CLI/CLI.hpp>
#include <string>

namespace drover::cli {

/// Each adds its verb. `socket` and `code`, into which the exit code goes, must outlive the app.
/// The commands throw NoAnswer.
void add_track_commands(CLI::App& app, const std::string& socket, int& code);
void add_task_commands(CLI::App& app, const std::string& socket, int& code);

}  // namespace drover::cli
