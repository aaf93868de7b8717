// The commands that show a device: live from droverd, or from a recorded file without it.
#pragma once

#include <CLI/CLI.hpp>
#include <string>

namespace drover::cli {

/// Adds gnss, imu, bms, can and gpio. `socket` and `code`, into which the exit code goes, must
/// outlive the app. The commands throw NoAnswer and WrongUsage.
void add_device_commands(CLI::App& app, const std::string& socket, int& code);

}  // namespace drover::cli
