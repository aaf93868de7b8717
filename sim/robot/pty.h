// A raw pseudo-terminal: the robot holds the master, the other side opens the named slave.
#pragma once

#include <string>

#include "link/unique_fd.h"

namespace drover::sim {

struct Pty {
  link::UniqueFd master;  ///< non-blocking
  link::UniqueFd slave;   ///< raw, no echo; close it to learn from poll() whether somebody has it
  std::string slave_path;
};

/// Throws std::runtime_error.
Pty open_pty();

}  // namespace drover::sim
