// The robot's end of a CAN bus: an interface, a controller on a pseudo-terminal, or a socket.
#pragma once

#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "link/can_link.h"
#include "sim/robot/scenario.h"

namespace drover::sim {

/// The seam between the kinds of buses. Nothing here blocks after construction.
class CanPort {
 public:
  virtual ~CanPort() = default;
  /// Appends what has come in; a bus that vanished is opened again when it is back.
  virtual void receive(const link::StampWindow& window, std::vector<link::ReceivedFrame>& out) = 0;
  virtual void send(std::span<const CanFrame> frames) = 0;
  /// A fault of the bus ("slcan sb256256", "unplug", ...). Returns "ok" or "error: ...".
  virtual std::string command(std::string_view text) = 0;
  /// Of a bus that cannot wait for the next tick to take what comes; -1: it can.
  virtual int descriptor() const { return -1; }
  /// Takes what has come; receive() hands it out.
  virtual void drain() {}
  /// Frames that found no room.
  virtual std::uint64_t dropped() const = 0;
};

/// All throw std::runtime_error. A SocketCAN interface that is not there yet is waited for.
std::unique_ptr<CanPort> make_socketcan_port(const std::string& interface);
std::unique_ptr<CanPort> make_slcan_port(const std::string& interface);
/// Listens at `path` and is the bus itself: what one client sends, all others and the robot get.
std::unique_ptr<CanPort> make_unix_port(const std::string& path);

}  // namespace drover::sim
