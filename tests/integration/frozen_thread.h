// One thread of a child process stands still, as if it hung: a debugger's stop, which the others do
// not notice.
#pragma once

#include <sys/ptrace.h>
#include <sys/types.h>
#include <sys/wait.h>

#include <filesystem>
#include <fstream>
#include <string>

namespace drover::test {

class FrozenThread final {
 public:
  FrozenThread(pid_t process, const std::string& name) {
    const auto tasks = "/proc/" + std::to_string(process) + "/task";
    for (const auto& task : std::filesystem::directory_iterator(tasks)) {
      std::string line;
      std::getline(std::ifstream(task.path() / "comm"), line);
      if (line == name) thread_ = std::stoi(task.path().filename().string());
    }
    if (thread_ == 0 || ::ptrace(PTRACE_SEIZE, thread_, nullptr, nullptr) != 0) return;
    held_ = ::ptrace(PTRACE_INTERRUPT, thread_, nullptr, nullptr) == 0 &&
            ::waitpid(thread_, nullptr, __WALL) == thread_;
  }
  ~FrozenThread() { let_go(); }
  FrozenThread(const FrozenThread&) = delete;
  FrozenThread& operator=(const FrozenThread&) = delete;

  /// False: there is no such thread, or this machine lets nobody hold one.
  bool held() const { return held_; }
  void let_go() {
    if (held_) (void)::ptrace(PTRACE_DETACH, thread_, nullptr, nullptr);
    held_ = false;
  }

 private:
  pid_t thread_ = 0;
  bool held_ = false;
};

}  // namespace drover::test
