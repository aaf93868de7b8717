// The programs that this one runs within, as the kernel tells them.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace drover::cli {

struct Process {
  std::string name;
  int parent = 0;  ///< 0: none is seen from here
};
/// From the line in /proc/PID/stat; nothing: it is none.
std::optional<Process> process_of(std::string_view stat);

/// Of the parent, of its parent, and so on to the first process. Nothing when the kernel does not
/// tell all of them: as of another user's, where /proc is mounted with hidepid.
std::optional<std::vector<std::string>> names_of_ancestors();

}  // namespace drover::cli
