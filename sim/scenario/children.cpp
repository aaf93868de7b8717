#include "sim/scenario/children.h"

#include <fcntl.h>
#include <sys/prctl.h>
#include <sys/syscall.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <csignal>
#include <cstring>
#include <utility>

namespace drover::sim {
namespace {

/// In the child: nothing here allocates.
[[noreturn]] void become(char* const* arguments, int log_fd, pid_t parent) {
  // A person's Ctrl-C is for the player, which then ends the others in order.
  ::setpgid(0, 0);
  ::prctl(PR_SET_PDEATHSIG, SIGKILL);
  if (::getppid() != parent) ::_exit(127);
  sigset_t none;
  ::sigemptyset(&none);
  ::sigprocmask(SIG_SETMASK, &none, nullptr);
  ::signal(SIGPIPE, SIG_DFL);
  const int null_fd = ::open("/dev/null", O_RDONLY);
  ::dup2(null_fd, STDIN_FILENO);
  ::dup2(log_fd, STDOUT_FILENO);
  ::dup2(log_fd, STDERR_FILENO);
  ::execv(arguments[0], arguments);
  ::_exit(127);
}

}  // namespace

std::string Children::start(const Program& program) {
  if (runs(program.name)) return program.name + " runs already";
  const auto path = log_folder_ + "/" + program.name + ".log";
  link::UniqueFd log(::open(path.c_str(), O_WRONLY | O_CREAT | O_APPEND | O_CLOEXEC, 0644));
  if (!log) return path + ": " + std::strerror(errno);
  std::vector<char*> arguments;
  for (const auto& word : program.command) arguments.push_back(const_cast<char*>(word.c_str()));
  arguments.push_back(nullptr);
  const pid_t parent = ::getpid();
  const pid_t pid = ::fork();
  if (pid == 0) become(arguments.data(), log.get(), parent);
  if (pid < 0) return program.name + ": " + std::strerror(errno);
  const auto pidfd = static_cast<int>(::syscall(SYS_pidfd_open, pid, 0));
  children_[program.name] = {pid, link::UniqueFd(pidfd)};
  return {};
}

bool Children::signal(const std::string& name, int number) {
  const auto child = children_.find(name);
  return child != children_.end() && ::kill(child->second.pid, number) == 0;
}

std::unique_ptr<HeldThread> Children::hold(const std::string& name,
                                           const std::string& thread) const {
  const auto child = children_.find(name);
  if (child == children_.end()) return nullptr;
  auto held = std::make_unique<HeldThread>(child->second.pid, thread);
  return held->held() ? std::move(held) : nullptr;
}

std::vector<int> Children::descriptors() const {
  std::vector<int> fds;
  for (const auto& [name, child] : children_) fds.push_back(child.pidfd.get());
  return fds;
}

std::vector<Children::Ended> Children::reap() {
  std::vector<Ended> ended;
  for (auto it = children_.begin(); it != children_.end();) {
    int status = 0;
    if (::waitpid(it->second.pid, &status, WNOHANG) == it->second.pid) {
      ended.push_back({it->first, status});
      it = children_.erase(it);
    } else {
      ++it;
    }
  }
  return ended;
}

void Children::kill_all() {
  for (auto& [name, child] : children_) ::kill(child.pid, SIGKILL);
  for (auto& [name, child] : children_) ::waitpid(child.pid, nullptr, 0);
  children_.clear();
}

std::string find_program(const std::string& folder, const std::string& name) {
  for (const char* place : {"", "src/", "src/guard/", "src/cli/", "sim/robot/", "sim/scenario/"}) {
    const auto path = folder + "/" + place + name;
    if (::access(path.c_str(), X_OK) == 0) return path;
  }
  return {};
}

}  // namespace drover::sim
