// Finds packets in a stream of bytes.
#pragma once

#include <array>
#include <cstdint>
#include <span>

#include "drivers/gt01/serial/codec.h"

namespace drover::gt01::serial {

/// The head may stand in the data and the sum is weak, so bytes that do not fit cost one byte and
/// no more: the next packet may begin inside them.
class Framer final {
 public:
  /// Calls `found(packet)` for each whole packet that ends in these bytes, `dropped()` for what
  /// began as one and is none.
  template <class Found, class Dropped>
  void push(std::span<const std::uint8_t> bytes, Found found, Dropped dropped) {
    for (const std::uint8_t byte : bytes) {
      buffer_[size_++] = byte;
      while (true) {
        const Look look = examine();
        if (look == Look::wait) break;
        if (look == Look::packet)
          found(std::span<const std::uint8_t>(packet_));
        else if (look == Look::bad)
          dropped();
      }
    }
  }
  void reset() { size_ = 0; }

 private:
  enum class Look : std::uint8_t { wait, packet, bad, noise };

  Look examine();
  void drop(std::size_t count);

  std::array<std::uint8_t, kLongest> buffer_{};
  std::size_t size_ = 0;
  FixedVector<std::uint8_t, kLongest> packet_;
};

}  // namespace drover::gt01::serial
