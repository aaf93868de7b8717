// A CAN controller with real error states: the kernel's slcan driver on one end of a
// pseudo-terminal, this file as the adapter's firmware on the other.
#include <fcntl.h>
#include <net/if.h>
#include <poll.h>
#include <spawn.h>
#include <sys/ioctl.h>
#include <sys/syscall.h>
#include <sys/wait.h>
#include <termios.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <cstring>
#include <stdexcept>

#include "sim/robot/can_port.h"
#include "sim/robot/pty.h"
#include "sim/robot/slcan_text.h"

extern char** environ;

namespace drover::sim {
namespace {

constexpr int kLineDisciplineSlcan = 17;  // N_SLCAN

class SlcanPort final : public CanPort {
 public:
  explicit SlcanPort(std::string interface) : interface_(std::move(interface)) { plug(); }

  void receive(const link::StampWindow& window, std::vector<link::ReceivedFrame>& out) override {
    if (!stalled_) pump();
    std::size_t begin = 0;
    for (auto end = in_.find('\r'); end != std::string::npos; end = in_.find('\r', begin)) {
      if (const auto frame = parse_slcan(std::string_view(in_).substr(begin, end - begin)))
        out.push_back({*frame, window.now});
      begin = end + 1;
    }
    in_.erase(0, begin);
  }

  void send(std::span<const CanFrame> frames) override {
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
      } else if (text == "unplug") {
        pty_ = Pty{};
        in_.clear();
      } else if (text == "plug") {
        if (!pty_.master) plug();
      } else {
        return "error: an slcan bus knows: slcan TEXT, stall, flow, unplug, plug";
      }
    } catch (const std::exception& error) {
      return std::string("error: ") + error.what();
    }
    return "ok";
  }

  std::uint64_t dropped() const override { return dropped_; }

 private:
  void plug() {
    pty_ = open_pty();
    if (::ioctl(pty_.slave.get(), TIOCSETD, &kLineDisciplineSlcan) != 0)
      throw std::runtime_error(interface_ + ": this kernel has no slcan: " + std::strerror(errno));
    ifreq request{};
    if (::ioctl(pty_.slave.get(), SIOCGIFNAME, &request) != 0)
      throw std::runtime_error(interface_ + ": slcan has no name: " + std::strerror(errno));
    const std::string made = request.ifr_name;
    if (made != interface_) run({"ip", "link", "set", made, "name", interface_});
    run({"ip", "link", "set", interface_, "type", "can", "bitrate", "500000"});
    run({"ip", "link", "set", interface_, "up"});
  }

  // The driver waits for the adapter to take its commands while `ip` runs, so keep taking them.
  void run(std::vector<std::string> words) {
    std::vector<char*> argv;
    for (auto& word : words) argv.push_back(word.data());
    argv.push_back(nullptr);
    pid_t child = -1;
    if (const int error = ::posix_spawnp(&child, argv[0], nullptr, nullptr, argv.data(), environ))
      throw std::runtime_error(std::string("ip: ") + std::strerror(error));
    const link::UniqueFd ended(static_cast<int>(::syscall(SYS_pidfd_open, child, 0)));
    std::array<pollfd, 2> wait{{{ended.get(), POLLIN, 0}, {pty_.master.get(), POLLIN, 0}}};
    while ((wait[0].revents & POLLIN) == 0) {
      if (::poll(wait.data(), wait.size(), -1) < 0 && errno != EINTR) break;
      if (wait[1].revents != 0) pump();
    }
    int status = 0;
    ::waitpid(child, &status, 0);
    if (status == 0) return;
    std::string text;
    for (const auto& word : words) text += (text.empty() ? "" : " ") + word;
    throw std::runtime_error("'" + text + "' failed");
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
  bool stalled_ = false;
  std::uint64_t dropped_ = 0;
};

}  // namespace

std::unique_ptr<CanPort> make_slcan_port(const std::string& interface) {
  return std::make_unique<SlcanPort>(interface);
}

}  // namespace drover::sim
