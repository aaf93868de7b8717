// The supervisor's event loop.
#include "session.h"

#include <poll.h>
#include <signal.h>
#include <sys/ioctl.h>
#include <sys/signalfd.h>
#include <sys/stat.h>
#include <sys/wait.h>

#include <chrono>
#include <cstdio>
#include <filesystem>
#include <memory>
#include <optional>

#include "console.h"
#include "kernel_process.h"
#include "net_relay.h"
#include "spool.h"
#include "state_dir.h"
#include "terminal.h"

namespace drover::lab {
namespace {

using Clock = std::chrono::steady_clock;

bool same_file(int a, int b) {
  struct stat left {
  }, right{};
  return ::fstat(a, &left) == 0 && ::fstat(b, &right) == 0 && left.st_dev == right.st_dev &&
         left.st_ino == right.st_ino;
}

std::string joined(const std::vector<std::string>& parts) {
  std::string text;
  for (const auto& part : parts) text += part + '\0';
  return text;
}

// What process 1 mounts first. The state folder is the one place where it writes to the host.
std::string fstab(const std::string& state_dir) {
  return "proc /proc proc\n"
         "sysfs /sys sysfs\n"
         "configfs /sys/kernel/config configfs\n"
         "devtmpfs /dev devtmpfs\n"
         "devpts /dev/pts devpts ptmxmode=0666,X-mount.mkdir\n"
         "tmpfs /dev/shm tmpfs X-mount.mkdir\n"
         "tmpfs /run tmpfs\n"
         "host /run/lab/host hostfs " +
         state_dir + ",X-mount.mkdir\n";
}

// Everything the init inside reads: plain files, so that no quoting is needed.
void write_orders(const Options& options, const StateDir& state) {
  std::filesystem::copy_file(options.init, state.file("init"));
  const bool out_tty = ::isatty(1) != 0;
  const bool err_tty = ::isatty(2) != 0;
  winsize size{};
  if (out_tty) ::ioctl(1, TIOCGWINSZ, &size);
  std::string text;
  auto add = [&](const char* key, const std::string& value) { text += key + ("=" + value + "\n"); };
  add("cwd", std::filesystem::current_path().string());
  add("logs", options.logs_dir);
  add("can", options.can);
  add("seed", std::to_string(options.seed));
  add("time", options.real_time ? "real" : "virtual");
  add("out", options.interactive ? "interactive" : out_tty ? "tty" : "pipe");
  add("err", same_file(1, 2) ? "out" : err_tty ? "tty" : "pipe");
  add("rows", std::to_string(size.ws_row ? size.ws_row : 24));
  add("columns", std::to_string(size.ws_col ? size.ws_col : 80));
  add("shell", options.shell ? "1" : "");
  add("net", options.host_port >= 0 ? "1" : "");
  state.write("fstab", fstab(state.path()));
  state.write("orders", text);
  state.write("command", joined(options.command));
  state.write("environment", joined(options.environment));
}

Fd catch_signals() {
  sigset_t set;
  sigemptyset(&set);
  for (int signal : {SIGINT, SIGTERM, SIGHUP, SIGQUIT, SIGCHLD}) sigaddset(&set, signal);
  ::sigprocmask(SIG_BLOCK, &set, nullptr);
  ::signal(SIGPIPE, SIG_IGN);
  return Fd(::signalfd(-1, &set, SFD_CLOEXEC | SFD_NONBLOCK));
}

class Session final {
 public:
  explicit Session(const Options& options)
      : options_(options),
        signals_(catch_signals()),
        state_(options.base_dir),
        cpu_(lease_cpu(options.base_dir, options.cpu)) {
    write_orders(options, state_);
    ends_ = start_kernel(options, state_.path(), cpu_.cpu);
    // Virtual time must never wait for a reader; a real clock need not buffer without end.
    const std::size_t limit = options.real_time ? 1 << 20 : 0;
    spools_.emplace_back(std::move(ends_.out), 1, limit);
    spools_.emplace_back(std::move(ends_.err), 2, limit);
    log_file_ = Fd(::open(state_.file("kernel.log").c_str(), O_WRONLY | O_APPEND | O_CLOEXEC));
    spools_.emplace_back(std::move(ends_.log), log_file_.get(), 0);
    if (options.shell) console_.emplace(std::move(ends_.consoles), state_.file("console"));
    if (options.host_port >= 0) start_network();
    if (options.interactive) raw_.emplace();
    write_info();
    if (options.shell) {
      std::fprintf(stderr, "a way in: sim/lab enter %d\n", static_cast<int>(::getpid()));
    }
  }
  Session(const Session&) = delete;
  Session& operator=(const Session&) = delete;
  ~Session() { kill_kernel(); }

  int run() {
    const auto deadline = Clock::now() + std::chrono::duration<double>(options_.timeout_s);
    while (!ended_) {
      int wait_ms = -1;
      if (options_.timeout_s > 0) {
        const auto left =
            std::chrono::duration_cast<std::chrono::milliseconds>(deadline - Clock::now());
        if (left.count() <= 0) return timed_out();
        wait_ms = static_cast<int>(left.count()) + 1;
      }
      poll_once(wait_ms);
    }
    if (stop_signal_ != 0) return 128 + stop_signal_;
    finish_output();
    if (reader_left_) return 128 + SIGPIPE;
    return command_status();
  }

 private:
  void start_network() {
    net_.emplace(std::move(ends_.net), options_.host_port, options_.second_port,
                 state_.file("passt.log"));
    const std::string port = std::to_string(net_->port());
    leave_port("host-port", net_->port());
    if (net_->second_port() > 0) leave_port("second-port", net_->second_port());
    std::fprintf(stderr, "broker: 127.0.0.1:%s\n", port.c_str());
  }

  /// Where the command and whoever called find it.
  void leave_port(const std::string& name, int port) {
    if (options_.logs_dir.empty()) return;
    std::FILE* file = std::fopen((options_.logs_dir + "/" + name).c_str(), "w");
    if (file) std::fprintf(file, "%d\n", port);
    if (file) std::fclose(file);
  }

  void write_info() {
    std::string text = options_.real_time ? "real time" : "virtual time";
    text += ", CPU " + std::to_string(cpu_.cpu);
    if (net_) text += ", broker 127.0.0.1:" + std::to_string(net_->port());
    if (options_.shell) text += ", second console";
    text += ":";
    for (const auto& word : options_.command) text += " " + word;
    state_.write("info", text + "\n");
  }

  void poll_once(int wait_ms) {
    polls_.clear();
    auto watch = [&](int fd, short events) {
      polls_.push_back({fd, events, 0});
      return polls_.size() - 1;
    };
    auto happened = [&](std::size_t i) { return polls_[i].revents != 0; };
    const std::size_t signal_at = watch(signals_.get(), POLLIN);
    // A negative descriptor is skipped by poll(), so absent parts need no case of their own.
    const std::size_t spool_at = polls_.size();
    for (const auto& spool : spools_) {
      watch(spool.reading() ? spool.from() : -1, POLLIN);
      watch(spool.writing() ? spool.to() : -1, POLLOUT);
    }
    const std::size_t keys_at = watch(options_.interactive ? 0 : -1, POLLIN);
    const bool wire = net_ && net_->alive();
    const std::size_t net_at = watch(wire ? net_->kernel_fd() : -1, POLLIN);
    watch(wire ? net_->passt_fd() : -1, POLLIN);
    const std::size_t door_at = watch(console_ ? console_->listen_fd() : -1, POLLIN);
    const std::size_t seats = console_ ? console_->seats() : 0;
    for (std::size_t i = 0; i < seats; ++i) {
      watch(console_->kernel_fd(i), POLLIN);
      watch(console_->visitor_fd(i), POLLIN);
    }
    if (::poll(polls_.data(), polls_.size(), wait_ms) < 0) return;

    for (std::size_t i = 0; i < spools_.size(); ++i) {
      if (happened(spool_at + 2 * i)) spools_[i].read_some();
      if (happened(spool_at + 2 * i + 1)) spools_[i].write_some();
    }
    if (happened(keys_at)) forward_keys();
    if (happened(net_at)) net_->from_kernel();
    if (happened(net_at + 1)) net_->from_passt();
    for (std::size_t i = 0; i < seats; ++i) {
      if (happened(door_at + 1 + 2 * i)) console_->from_kernel(i);
      if (happened(door_at + 2 + 2 * i)) console_->from_visitor(i);
    }
    if (happened(door_at)) console_->accept_visitor();
    if (happened(signal_at)) on_signal();
    if (spools_[0].broken() && !reader_left_) {
      reader_left_ = true;
      kill_kernel();
    }
  }

  void forward_keys() {
    char buffer[4096];
    const ssize_t n = ::read(0, buffer, sizeof buffer);
    if (n > 0) (void)!::write(ends_.in.get(), buffer, static_cast<std::size_t>(n));
    if (n <= 0) stop(SIGHUP);
  }

  void on_signal() {
    signalfd_siginfo info{};
    while (::read(signals_.get(), &info, sizeof info) == sizeof info) {
      const int signal = static_cast<int>(info.ssi_signo);
      if (signal != SIGCHLD) stop(signal);
    }
    if (ends_.pid > 0 && ::waitpid(ends_.pid, nullptr, WNOHANG) == ends_.pid) {
      ::kill(-ends_.pid, SIGKILL);
      ends_.pid = -1;
      ended_ = true;
    }
  }

  void stop(int signal) {
    stop_signal_ = signal;
    kill_kernel();
  }

  // The kernel's own children are traced by it and die with it; the group covers the rest.
  void kill_kernel() {
    if (ends_.pid <= 0) return;
    ::kill(-ends_.pid, SIGKILL);
    ::waitpid(ends_.pid, nullptr, 0);
    ends_.pid = -1;
    ended_ = true;
  }

  int timed_out() {
    kill_kernel();
    finish_output();
    std::fprintf(stderr, "sim/lab: ended after %g s of wall time (--timeout)\n",
                 options_.timeout_s);
    return kTimedOut;
  }

  void finish_output() {
    for (auto& spool : spools_) spool.finish();
    if (options_.logs_dir.empty()) return;
    std::error_code ignored;
    std::filesystem::copy_file(state_.file("kernel.log"), options_.logs_dir + "/kernel.log",
                               std::filesystem::copy_options::overwrite_existing, ignored);
  }

  int command_status() {
    const std::string text = state_.read("status");
    if (!text.empty()) return std::stoi(text);
    const std::string log = state_.read("kernel.log");
    const std::size_t from = log.size() > 3000 ? log.size() - 3000 : 0;
    std::fprintf(stderr, "sim/lab: the lab's kernel ended without a status; it said:\n%s\n",
                 log.c_str() + from);
    return kLabBroke;
  }

  const Options& options_;
  Fd signals_;
  StateDir state_;
  CpuLease cpu_;
  KernelEnds ends_;
  Fd log_file_;
  std::vector<Spool> spools_;  // standard output, standard error, kernel log
  std::vector<pollfd> polls_;
  std::optional<ConsoleServer> console_;
  std::optional<NetRelay> net_;
  std::optional<RawTerminal> raw_;
  int stop_signal_ = 0;
  bool reader_left_ = false;
  bool ended_ = false;
};

}  // namespace

int run_session(const Options& options) {
  Session session(options);
  return session.run();
}

}  // namespace drover::lab
