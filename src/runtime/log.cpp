#include "runtime/log.h"

#include <fcntl.h>
#include <limits.h>
#include <unistd.h>

#include <array>
#include <atomic>
#include <cerrno>
#include <chrono>
#include <cstdlib>
#include <stdexcept>
#include <string>
#include <thread>

#include "runtime/worker.h"
#include "text/control.h"

namespace drover::runtime {

namespace {

constexpr int kNoQueue = -1;
// Of the process, as standard error is: they outlive a writer that waits for its reader for ever.
std::atomic<int> queue{kNoQueue};
std::atomic<std::uint64_t> dropped_lines{0};
std::atomic<bool> all_written{true};

std::string formatted(LogLevel level, std::string_view text) {
  static const bool for_journal = std::getenv("JOURNAL_STREAM") != nullptr;
  std::string line;
  if (for_journal) line = "<" + std::to_string(static_cast<int>(level)) + ">";
  if (!for_journal && level == LogLevel::error) line = "error: ";
  if (!for_journal && level == LogLevel::warning) line = "warning: ";
  line.append(text::harmless(text)).push_back('\n');
  return line;
}

void write_out(std::string_view text) {
  while (!text.empty()) {
    const auto n = ::write(STDERR_FILENO, text.data(), text.size());
    if (n < 0 && errno == EAGAIN) {  // somebody else made it non-blocking
      std::this_thread::sleep_for(std::chrono::milliseconds(10));
      continue;
    }
    if (n < 0 && errno == EINTR) continue;
    if (n <= 0) return;
    text.remove_prefix(static_cast<std::size_t>(n));
  }
}

/// Until the queue's other end is closed.
void write_lines(int from) {
  name_thread("log");
  std::uint64_t told = 0;
  std::array<char, PIPE_BUF> chunk{};
  for (;;) {
    const auto n = ::read(from, chunk.data(), chunk.size());
    if (n < 0 && errno == EINTR) continue;
    if (n <= 0) break;
    write_out({chunk.data(), static_cast<std::size_t>(n)});
    const auto lost = dropped_lines.load(std::memory_order_relaxed);
    if (lost == told) continue;
    write_out(formatted(LogLevel::warning,
                        std::to_string(lost - told) + " lines were dropped: nobody read the log"));
    told = lost;
  }
  ::close(from);
  all_written.store(true, std::memory_order_release);
}

}  // namespace

void log(LogLevel level, std::string_view text) {
  std::string line = formatted(level, text);
  const int into = queue.load(std::memory_order_acquire);
  if (into == kNoQueue) return write_out(line);
  if (line.size() > PIPE_BUF) {  // only so much is written as a whole
    line.resize(PIPE_BUF - 1);
    line.push_back('\n');
  }
  if (::write(into, line.data(), line.size()) != static_cast<ssize_t>(line.size()))
    dropped_lines.fetch_add(1, std::memory_order_relaxed);
}

LogWriter::LogWriter() {
  std::array<int, 2> ends{};
  if (::pipe2(ends.data(), O_CLOEXEC) != 0) throw std::runtime_error("the log has no queue");
  ::fcntl(ends[1], F_SETFL, O_NONBLOCK);
  all_written.store(false);
  std::thread([from = ends[0]] { write_lines(from); }).detach();
  queue.store(ends[1], std::memory_order_release);
}

LogWriter::~LogWriter() {
  ::close(queue.exchange(kNoQueue));
  for (int i = 0; i < 60 && !all_written.load(std::memory_order_acquire); ++i)
    std::this_thread::sleep_for(std::chrono::milliseconds(5));
}

std::uint64_t LogWriter::dropped() {
  return dropped_lines.load(std::memory_order_relaxed);
}

}  // namespace drover::runtime
