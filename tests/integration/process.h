// A child process of a test: it cannot outlive the test, and its output is kept in a file.
#pragma once

#include <sys/types.h>

#include <chrono>
#include <optional>
#include <string>
#include <vector>

namespace drover::test {

class Process final {
 public:
  Process() = default;
  /// Starts `words[0]`; standard output and error go to `log`, behind what is there already.
  Process(const std::vector<std::string>& words, std::string log);
  ~Process();
  Process(Process&& other) noexcept;
  Process& operator=(Process&& other) noexcept;

  bool running();
  pid_t pid() const { return pid_; }
  /// After SIGSTOP it returns when each of its threads stands: until then one may still work.
  void signal(int number) const;
  /// Exit status, or 128 and the signal's number; nothing when it still runs at the deadline.
  std::optional<int> wait(std::chrono::milliseconds deadline);
  std::string output() const;

 private:
  void reap(bool block);

  pid_t pid_ = -1;
  std::optional<int> status_;
  std::string log_;
};

}  // namespace drover::test
