#include "sim/scenario/held_thread.h"

#include <sys/ptrace.h>
#include <sys/wait.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <string>

namespace drover::sim {
namespace {

pid_t thread_named(pid_t process, std::string_view name) {
  const auto folder = "/proc/" + std::to_string(process) + "/task";
  std::error_code error;
  for (const auto& entry : std::filesystem::directory_iterator(folder, error)) {
    std::string line;
    std::ifstream comm(entry.path() / "comm");
    std::getline(comm, line);
    if (line == name) return std::atoi(entry.path().filename().c_str());
  }
  return -1;
}

}  // namespace

HeldThread::HeldThread(pid_t process, std::string_view name) {
  const pid_t thread = thread_named(process, name);
  if (thread <= 0 || ::ptrace(PTRACE_SEIZE, thread, nullptr, nullptr) != 0) return;
  int status = 0;
  if (::ptrace(PTRACE_INTERRUPT, thread, nullptr, nullptr) == 0 &&
      ::waitpid(thread, &status, __WALL) == thread)
    thread_ = thread;
}

void HeldThread::let_go() {
  if (held()) ::ptrace(PTRACE_DETACH, thread_, nullptr, nullptr);
  thread_ = -1;
}

}  // namespace drover::sim
