// Two computers with a wire between, as network namespaces: this process moves into the first.
#pragma once

#include <cstdint>
#include <span>

#include "link/unique_fd.h"

namespace drover::test {

/// An address and a port of IPv4, in the host's order.
struct Place {
  std::uint32_t address = 0;
  std::uint16_t port = 0;
};

constexpr std::uint32_t kLoopback = 0x7f00'0001;  ///< 127.0.0.1
constexpr std::uint32_t kHere = 0x0a09'0001;      ///< 10.9.0.1, this computer on the wire
constexpr std::uint32_t kThere = 0x0a09'0002;     ///< 10.9.0.2, the other one

/// Construct it before any thread is started. The first computer's kernel is as careless as one can
/// be told to be: it takes from the wire what says that it comes from 127.0.0.1, or goes there.
class TwoComputers {
 public:
  /// Throws std::runtime_error where there can be no namespaces: such a test has failed.
  TwoComputers();

  /// A datagram from the other computer's end of the wire, whatever it says where it is from.
  void send(Place from, Place to, std::span<const std::uint8_t> datagram) const;

 private:
  link::UniqueFd card_;  ///< the other one's
  int card_index_ = 0;
};

}  // namespace drover::test
