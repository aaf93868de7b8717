// A CAN controller with real error states: the kernel's slcan driver on one end of a
// pseudo-terminal, this file as the adapter's firmware on the other.
#include <net/if.h>
#include <poll.h>
#include <spawn.h>
#include <sys/ioctl.h>
#include <sys/wait.h>
#include <termios.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <cstdio>
#include <cstring>
#include <deque>
#include <stdexcept>
#include <thread>
#include <utility>

#include "sim/robot/can_port.h"
#include "sim/robot/pty.h"
#include "sim/robot/slcan_text.h"

extern char** environ;

namespace drover::sim {
namespace {

constexpr int kLook_ms = 1;
constexpr int kLineDisciplineSlcan = 17;  // N_SLCAN

class SlcanPort final : public CanPort {
 public:
  explicit SlcanPort(std::string interface) : interface_(std::move(interface)) {
    plug();
    while (!brought_up()) {
      pollfd wait{pty_.master.get(), POLLIN, 0};
      ::poll(&wait, 1, kLook_ms);
      pump();
    }
    if (!problem_.empty()) throw std::runtime_error(problem_);
  }
  ~SlcanPort() override {
    pty_ = Pty{};  // the driver lets `ip` go
    if (closer_.joinable()) closer_.join();
    if (child_ > 0) ::waitpid(child_, nullptr, 0);
  }

  void receive(const link::StampWindow& window, std::vector<link::ReceivedFrame>& out) override {
    drain();
    (void)brought_up();
    std::size_t begin = 0;
    for (auto end = in_.find('\r'); end != std::string::npos; end = in_.find('\r', begin)) {
      const auto line = std::string_view(in_).substr(begin, end - begin);
      if (line == "O") bus_off_ = false;
      if (const auto frame = parse_slcan(line); frame && !bus_off_)
        out.push_back({*frame, window.now});
      begin = end + 1;
    }
    in_.erase(0, begin);
  }

  int descriptor() const override { return pty_.master.get(); }
  // The driver hands out a frame when the one before was taken.
  void drain() override {
    if (!stalled_) pump();
  }

  void send(std::span<const CanFrame> frames) override {
    if (bus_off_) return;
    std::string text;
    for (const auto& frame : frames)
      if (!append_slcan(text, frame)) ++dropped_;
    write(text);
  }

  std::string command(std::string_view text) override {
    try {
      if (text.starts_with("slcan ")) {
        write(std::string(text.substr(6)) + "\r");
      } else if (text == "stall" || text == "flow") {
        stalled_ = text == "stall";
      } else if (text == "bus_off") {
        write("sb256256\r");
        bus_off_ = true;
      } else if (text == "restart") {
        restart();
      } else if (text == "unplug") {
        unplug();
      } else if (text == "plug") {
        if (!pty_.master) plug();
      } else {
        return "error: an slcan bus knows: slcan TEXT, stall, flow, bus_off, restart, unplug, plug";
      }
    } catch (const std::exception& error) {
      return std::string("error: ") + error.what();
    }
    return "ok";
  }

  std::uint64_t dropped() const override { return dropped_; }

 private:
  void plug() {
    if (closer_.joinable()) closer_.join();
    pty_ = open_pty();
    if (::ioctl(pty_.slave.get(), TIOCSETD, &kLineDisciplineSlcan) != 0)
      throw std::runtime_error(interface_ + ": this kernel has no slcan: " + std::strerror(errno));
    ifreq request{};
    if (::ioctl(pty_.slave.get(), SIOCGIFNAME, &request) != 0)
      throw std::runtime_error(interface_ + ": slcan has no name: " + std::strerror(errno));
    const std::string made = request.ifr_name;
    problem_.clear();
    todo_.clear();
    if (made != interface_) todo_.push_back({"ip", "link", "set", made, "name", interface_});
    todo_.push_back({"ip", "link", "set", interface_, "type", "can", "bitrate", "500000"});
    todo_.push_back({"ip", "link", "set", interface_, "up"});
  }

  // The kernel takes a second to part with an interface at which others listen: not the robot's.
  void unplug() {
    if (closer_.joinable()) closer_.join();
    closer_ = std::thread([old = std::exchange(pty_, Pty{})]() mutable { old = Pty{}; });
    in_.clear();
    todo_.clear();
  }

  // This driver refuses restart-ms, so a person does it; the adapter is then opened anew.
  void restart() {
    todo_.push_back({"ip", "link", "set", interface_, "down"});
    todo_.push_back({"ip", "link", "set", interface_, "up"});
  }

  // One `ip` after the other, without waiting: the driver wants the adapter to take its commands
  // while `ip` runs, and the robot must not stand still meanwhile. True when there is no more.
  bool brought_up() {
    if (child_ > 0) {
      int status = 0;
      if (::waitpid(child_, &status, WNOHANG) == 0) return false;
      child_ = -1;
      if (status != 0) fail("'ip link set' failed for " + interface_);
    }
    if (todo_.empty()) return true;
    auto words = todo_.front();
    todo_.pop_front();
    std::vector<char*> argv;
    for (auto& word : words) argv.push_back(word.data());
    argv.push_back(nullptr);
    if (const int error =
            ::posix_spawnp(&child_, argv[0], nullptr, nullptr, argv.data(), environ)) {
      child_ = -1;
      fail(std::string("cannot run ip: ") + std::strerror(error));
    }
    return false;
  }
  void fail(std::string problem) {
    todo_.clear();
    problem_ = std::move(problem);
    std::fprintf(stderr, "drover-sim: %s\n", problem_.c_str());
  }

  void pump() {
    std::array<char, 4096> bytes{};
    while (pty_.master) {
      const auto n = ::read(pty_.master.get(), bytes.data(), bytes.size());
      if (n <= 0) return;
      in_.append(bytes.data(), static_cast<std::size_t>(n));
      if (static_cast<std::size_t>(n) < bytes.size()) return;
    }
  }

  void write(const std::string& text) {
    if (text.empty()) return;
    if (!pty_.master ||
        ::write(pty_.master.get(), text.data(), text.size()) != static_cast<ssize_t>(text.size()))
      ++dropped_;
  }

  std::string interface_;
  Pty pty_;
  std::string in_;
  std::thread closer_;
  std::deque<std::vector<std::string>> todo_;
  pid_t child_ = -1;
  std::string problem_;
  bool stalled_ = false;
  bool bus_off_ = false;  // nothing goes either way until the interface is opened anew
  std::uint64_t dropped_ = 0;
};

}  // namespace

std::unique_ptr<CanPort> make_slcan_port(const std::string& interface) {
  return std::make_unique<SlcanPort>(interface);
}

}  // namespace drover::sim
