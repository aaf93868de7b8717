#include "cli/ancestors.h"

#include <unistd.h>

#include <charconv>
#include <fstream>

namespace drover::cli {

std::optional<Process> process_of(std::string_view stat) {
  // A name may have brackets itself; behind it there are none.
  const auto open = stat.find('(');
  const auto close = stat.rfind(") ");
  if (open == std::string_view::npos || close == std::string_view::npos || close < open)
    return std::nullopt;
  constexpr std::size_t kState = 4;  // ") S "
  if (stat.size() <= close + kState) return std::nullopt;
  Process process{std::string(stat.substr(open + 1, close - open - 1)), 0};
  const char* const number = stat.data() + close + kState;
  if (std::from_chars(number, stat.data() + stat.size(), process.parent).ec != std::errc())
    return std::nullopt;
  return process;
}

std::optional<std::vector<std::string>> names_of_ancestors() {
  constexpr std::size_t kMost = 1000;  // a process that ends meanwhile may give its number away
  std::vector<std::string> names;
  for (int pid = ::getppid(); pid > 0 && names.size() < kMost;) {
    std::ifstream file("/proc/" + std::to_string(pid) + "/stat");
    const std::string stat((std::istreambuf_iterator<char>(file)), {});
    const auto process = process_of(stat);
    if (!process) return std::nullopt;
    names.push_back(process->name);
    pid = process->parent;
  }
  return names;
}

}  // namespace drover::cli
