#include "integration/process.h"

#include <fcntl.h>
#include <signal.h>
#include <sys/prctl.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <stdexcept>
#include <thread>
#include <utility>

namespace drover::test {
namespace {

/// As its stat tells: what stands behind the name in brackets, which may be any.
bool stands(const std::filesystem::path& thread) {
  std::ifstream file(thread / "stat");
  std::string text;
  std::getline(file, text);
  const auto name_end = text.rfind(')');
  const char state =
      name_end == std::string::npos ? 'X' : text[std::min(name_end + 2, text.size())];
  return state == 'T' || state == 'X' || state == 'Z';
}

bool all_stand(pid_t process) {
  std::error_code gone;
  const auto folder = "/proc/" + std::to_string(process) + "/task";
  const std::filesystem::directory_iterator threads(folder, gone);
  return gone || std::all_of(begin(threads), end(threads),
                             [](const auto& thread) { return stands(thread.path()); });
}

}  // namespace

Process::Process(const std::vector<std::string>& words, std::string log) : log_(std::move(log)) {
  std::vector<char*> arguments;
  for (const auto& word : words) arguments.push_back(const_cast<char*>(word.c_str()));
  arguments.push_back(nullptr);
  const auto parent = ::getpid();
  pid_ = ::fork();
  if (pid_ < 0) throw std::runtime_error("cannot fork");
  if (pid_ > 0) return;
  ::prctl(PR_SET_PDEATHSIG, SIGKILL);
  if (::getppid() != parent) ::_exit(126);
  const int out = ::open(log_.c_str(), O_WRONLY | O_CREAT | O_APPEND, 0644);
  const int in = ::open("/dev/null", O_RDONLY);
  ::dup2(in, STDIN_FILENO);
  ::dup2(out, STDOUT_FILENO);
  ::dup2(out, STDERR_FILENO);
  // What else the test has open, sockets of its libraries, is no business of the program's.
  ::close_range(STDERR_FILENO + 1, ~0U, 0);
  ::execv(arguments[0], arguments.data());
  ::_exit(127);
}

Process::~Process() {
  if (!running()) return;
  signal(SIGKILL);
  reap(true);
}

Process::Process(Process&& other) noexcept {
  *this = std::move(other);
}

Process& Process::operator=(Process&& other) noexcept {
  std::swap(pid_, other.pid_);
  std::swap(status_, other.status_);
  std::swap(log_, other.log_);
  return *this;
}

void Process::reap(bool block) {
  int status = 0;
  if (pid_ < 0 || status_ || ::waitpid(pid_, &status, block ? 0 : WNOHANG) != pid_) return;
  status_ = WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
}

bool Process::running() {
  reap(false);
  return pid_ > 0 && !status_;
}

void Process::signal(int number) const {
  if (pid_ <= 0 || status_) return;
  ::kill(pid_, number);
  for (int i = 0; number == SIGSTOP && i < 1000 && !all_stand(pid_); ++i)
    std::this_thread::sleep_for(std::chrono::milliseconds(1));
}

std::optional<int> Process::wait(std::chrono::milliseconds deadline) {
  const auto end = std::chrono::steady_clock::now() + deadline;
  while (running() && std::chrono::steady_clock::now() < end)
    std::this_thread::sleep_for(std::chrono::milliseconds(5));
  return status_;
}

std::string Process::output() const {
  std::ostringstream text;
  text << std::ifstream(log_).rdbuf();
  return text.str();
}

}  // namespace drover::test
