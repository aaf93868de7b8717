// A fuzzer's bytes, read to their end and zero beyond.
#pragma once

#include <bit>
#include <cstddef>
#include <cstdint>
#include <span>

#include "drover/can_frame.h"

namespace drover::fuzz {

class Input {
 public:
  explicit Input(std::span<const std::uint8_t> bytes) : bytes_(bytes) {}
  bool more() const { return at_ < bytes_.size(); }
  std::uint8_t byte() { return more() ? bytes_[at_++] : std::uint8_t{0}; }
  std::uint16_t word() {
    const std::uint8_t low = byte();
    return static_cast<std::uint16_t>(low | byte() << 8U);
  }
  float real() {
    std::uint32_t bits = 0;
    for (int i = 0; i < 4; ++i) bits |= static_cast<std::uint32_t>(byte()) << (8 * i);
    return std::bit_cast<float>(bits);
  }

 private:
  std::span<const std::uint8_t> bytes_;
  std::size_t at_ = 0;
};

/// Length, then that many bytes.
inline void read_data(Input& input, CanFrame& frame) {
  frame.len = static_cast<std::uint8_t>(input.byte() % (frame.data.size() + 1));
  for (std::uint8_t i = 0; i < frame.len && input.more(); ++i) frame.data[i] = input.byte();
}

/// Flags, length, bytes.
inline CanFrame read_frame(Input& input, std::uint32_t id) {
  CanFrame frame;
  const std::uint8_t flags = input.byte();
  frame.id = id;
  frame.extended = (flags & 1U) != 0;
  frame.remote = (flags & 2U) != 0;
  frame.fd = (flags & 4U) != 0;
  frame.error = (flags & 8U) != 0;
  read_data(input, frame);
  return frame;
}

}  // namespace drover::fuzz
