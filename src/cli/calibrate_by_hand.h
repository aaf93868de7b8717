// `drover calibrate drive`: the drive of a calibration, with a key that is held down.
#pragma once

#include <CLI/CLI.hpp>
#include <string>

namespace drover::cli {

/// `socket` and `code` outlive `app`.
void add_calibrate_drive_command(CLI::App& calibrate, const std::string& socket, int& code);

}  // namespace drover::cli
