// A CAN bus made of a listening SOCK_SEQPACKET socket: each message is a `struct can_frame` (or
// `canfd_frame`), and every client hears every other.
#include <sys/socket.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <stdexcept>

#include "link/unix_address.h"
#include "sim/robot/can_port.h"

namespace drover::sim {
namespace {

constexpr std::size_t kMaxClients = 8;

class UnixPort final : public CanPort {
 public:
  explicit UnixPort(std::string path) : path_(std::move(path)) {
    const auto address = link::unix_address(path_);
    if (!address) throw std::runtime_error(path_ + ": the socket's path is too long");
    ::unlink(path_.c_str());
    listen_ = link::UniqueFd(::socket(AF_UNIX, SOCK_SEQPACKET | SOCK_CLOEXEC | SOCK_NONBLOCK, 0));
    if (::bind(listen_.get(), reinterpret_cast<const sockaddr*>(&*address), sizeof *address) != 0 ||
        ::listen(listen_.get(), 4) != 0)
      throw std::runtime_error(path_ + ": cannot listen: " + std::strerror(errno));
  }
  ~UnixPort() override { ::unlink(path_.c_str()); }

  void receive(const link::StampWindow& window, std::vector<link::ReceivedFrame>& out) override {
    accept_clients();
    for (std::size_t i = 0; i < clients_.size();) {
      if (drain(i, window, out))
        ++i;
      else
        clients_.erase(clients_.begin() + static_cast<std::ptrdiff_t>(i));
    }
  }

  void send(std::span<const CanFrame> frames) override { relay(frames, kMaxClients); }

  std::string command(std::string_view text) override {
    if (text != "disconnect") return "error: a socket bus knows: disconnect";
    clients_.clear();
    return "ok";
  }

  std::uint64_t dropped() const override {
    std::uint64_t dropped = 0;
    for (const auto& client : clients_) dropped += client->counters().send_refused;
    return dropped;
  }

 private:
  void accept_clients() {
    while (true) {
      link::UniqueFd fd(::accept4(listen_.get(), nullptr, nullptr, SOCK_CLOEXEC | SOCK_NONBLOCK));
      if (!fd) return;
      if (clients_.size() < kMaxClients)
        clients_.push_back(std::make_unique<link::CanLink>(std::move(fd)));
    }
  }
  bool drain(std::size_t client, const link::StampWindow& window,
             std::vector<link::ReceivedFrame>& out) {
    do {
      if (!clients_[client]->receive(window, batch_)) return false;
      frames_.clear();
      for (auto& received : batch_) {
        received.received = window.now;  // no stamp: the drain's own time
        out.push_back(received);
        frames_.push_back(received.frame);
      }
      relay(frames_, client);
    } while (batch_.full());
    return true;
  }
  /// A client whose socket is dead is found by the next receive.
  void relay(std::span<const CanFrame> frames, std::size_t except) {
    for (std::size_t i = 0; i < clients_.size() && !frames.empty(); ++i)
      if (i != except) (void)clients_[i]->send(frames);
  }

  std::string path_;
  link::UniqueFd listen_;
  std::vector<std::unique_ptr<link::CanLink>> clients_;
  link::FrameBatch batch_;
  std::vector<CanFrame> frames_;
};

}  // namespace

std::unique_ptr<CanPort> make_unix_port(const std::string& path) {
  return std::make_unique<UnixPort>(path);
}

}  // namespace drover::sim
