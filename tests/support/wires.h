// The far ends of a robot's wires, for tests that run the control loop over sockets and terminals.
#pragma once

#include <fcntl.h>
#include <stdlib.h>
#include <sys/socket.h>
#include <sys/un.h>
#include <unistd.h>

#include <string>
#include <string_view>
#include <vector>

#include "drover/can_frame.h"
#include "link/can_wire.h"
#include "link/unique_fd.h"

namespace drover::test {

/// The other end of a bus, as the simulator has it.
class Bus final {
 public:
  explicit Bus(const std::string& path)
      : listener_(::socket(AF_UNIX, SOCK_SEQPACKET | SOCK_NONBLOCK, 0)) {
    sockaddr_un address{};
    address.sun_family = AF_UNIX;
    path.copy(address.sun_path, sizeof address.sun_path - 1);
    (void)::bind(listener_.get(), reinterpret_cast<sockaddr*>(&address), sizeof address);
    (void)::listen(listener_.get(), 2);
  }
  bool connected() {
    if (!peer_) peer_ = link::UniqueFd(::accept(listener_.get(), nullptr, nullptr));
    return static_cast<bool>(peer_);
  }
  void put(const CanFrame& frame) const {
    canfd_frame wire;
    const auto size = link::to_wire(frame, wire);
    (void)!::send(peer_.get(), &wire, size, MSG_DONTWAIT | MSG_NOSIGNAL);
  }
  /// How many frames came since the last call.
  int take() const {
    int frames = 0;
    for (canfd_frame wire; ::recv(peer_.get(), &wire, sizeof wire, MSG_DONTWAIT) > 0;) ++frames;
    return frames;
  }
  /// The frames themselves.
  std::vector<CanFrame> frames() const {
    std::vector<CanFrame> all;
    canfd_frame wire;
    CanFrame frame;
    for (ssize_t size = 0; (size = ::recv(peer_.get(), &wire, sizeof wire, MSG_DONTWAIT)) > 0;)
      if (link::from_wire(wire, static_cast<std::size_t>(size), frame)) all.push_back(frame);
    return all;
  }
  void hang_up() { peer_.reset(); }

 private:
  link::UniqueFd listener_;
  link::UniqueFd peer_;
};

/// The device's end of its line.
class Tty final {
 public:
  Tty() : fd_(::posix_openpt(O_RDWR | O_NOCTTY | O_NONBLOCK)) {
    (void)::grantpt(fd_.get());
    (void)::unlockpt(fd_.get());
  }
  std::string path() const { return ::ptsname(fd_.get()); }
  void say(std::string_view text) const { (void)!::write(fd_.get(), text.data(), text.size()); }
  void hang_up() { fd_.reset(); }
  int fd() const { return fd_.get(); }

 private:
  link::UniqueFd fd_;
};

}  // namespace drover::test
