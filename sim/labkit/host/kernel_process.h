// Starts the User-Mode Linux kernel on its own CPU with its consoles on pipes.
#pragma once

#include <sys/types.h>

#include <string>
#include <vector>

#include "fd.h"
#include "options.h"

namespace drover::lab {

/// The supervisor's ends of everything the kernel process is connected to.
/// How many people can have a shell in one lab at the same time.
inline constexpr int kSeats = 4;

struct KernelEnds {
  pid_t pid = -1;
  Fd out;                    // what the command writes to standard output
  Fd err;                    // and to standard error
  Fd log;                    // kernel messages, and what process 1 says
  Fd in;                     // keystrokes for the command; open when interactive
  std::vector<Fd> consoles;  // one for each visitor; none when nobody may come
  Fd net;                    // Ethernet frames as datagrams; open when there is a wire to the host
};

/// state_dir holds the start-up files; kernel.log in it takes the kernel's own early output.
KernelEnds start_kernel(const Options& options, const std::string& state_dir, int cpu);

}  // namespace drover::lab
