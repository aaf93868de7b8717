#include "runtime/log.h"

#include <unistd.h>

#include <cstdlib>
#include <string>

namespace drover::runtime {

void log(LogLevel level, std::string_view text) {
  static const bool for_journal = std::getenv("JOURNAL_STREAM") != nullptr;
  std::string line;
  if (for_journal) line = "<" + std::to_string(static_cast<int>(level)) + ">";
  if (!for_journal && level == LogLevel::error) line = "error: ";
  if (!for_journal && level == LogLevel::warning) line = "warning: ";
  line.append(text).push_back('\n');
  (void)!::write(STDERR_FILENO, line.data(), line.size());
}

}  // namespace drover::runtime
