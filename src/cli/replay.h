// `drover replay`: a recording of droverd played again.
#pragma once

#include <string>

namespace CLI {
class App;
}

namespace drover::cli {

/// Adds `drover replay`; `code` becomes its exit code.
void add_replay_command(CLI::App& app, int& code);

}  // namespace drover::cli
