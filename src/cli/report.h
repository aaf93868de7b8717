// `drover report`: what became of a task.
#pragma once

#include <CLI/CLI.hpp>
#include <string>

namespace drover::cli {

/// `socket` and `code` outlive `app`.
void add_report_command(CLI::App& app, const std::string& socket, int& code);

}  // namespace drover::cli
