// Finds LD06 packets in a stream of bytes, one byte at a time.
#pragma once

#include <array>
#include <cstdint>
#include <span>

#include "drivers/ld06/codec.h"

namespace drover::ld06 {

/// The header's two bytes may stand in the data, so a packet that does not fit costs one byte and
/// no more: the next may begin inside it.
class Framer final {
 public:
  enum class Event : std::uint8_t {
    none,     ///< nothing finished with this byte
    packet,   ///< packet() holds one whose checksum is right
    dropped,  ///< what began as a packet is none
  };

  Event push(std::uint8_t byte);
  /// After Event::packet and until the next push().
  std::span<const std::uint8_t> packet() const { return found_; }
  void reset() { size_ = 0; }

 private:
  bool could_begin() const;
  void drop_one();

  std::array<std::uint8_t, kPacketSize> buffer_{};
  std::size_t size_ = 0;
  std::array<std::uint8_t, kPacketSize> found_{};
};

}  // namespace drover::ld06
