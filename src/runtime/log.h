// Lines for the journal: "<level>text", one write each, from any thread but the control thread.
#pragma once

#include <cstdint>
#include <string_view>

namespace drover::runtime {

enum class LogLevel { error = 3, warning = 4, info = 6 };

/// Below systemd the level is a prefix that the journal understands; on a terminal it is left out.
/// Never waits while a LogWriter lives: what its queue does not take is dropped and counted.
void log(LogLevel level, std::string_view text);

/// Standard error's own thread while it lives: whoever reads it may stop reading, and only this
/// thread waits. The queue is a pipe (64 KiB). One at a time.
class LogWriter final {
 public:
  LogWriter();  ///< throws std::runtime_error
  /// Waits for what is queued, at most 0.3 s.
  ~LogWriter();
  LogWriter(const LogWriter&) = delete;
  LogWriter& operator=(const LogWriter&) = delete;
  /// Lines that found the queue full; told as a line of their own when somebody reads again.
  static std::uint64_t dropped();
};

}  // namespace drover::runtime
