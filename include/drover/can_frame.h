// One CAN or CAN FD frame, as every driver sees it.
#pragma once

#include <array>
#include <cstdint>
#include <initializer_list>
#include <span>

namespace drover {

struct CanFrame {
  std::uint32_t id = 0;  ///< 11 or 29 bits, without flags
  bool extended = false;
  bool remote = false;
  bool fd = false;
  bool error = false;  ///< error frame of the controller; `id` then holds the error classes
  std::uint8_t len = 0;
  std::array<std::uint8_t, 64> data{};

  /// Neither extended nor remote nor FD nor an error: all that devices with 11-bit ids say.
  constexpr bool is_plain() const { return !extended && !remote && !fd && !error; }
  std::span<const std::uint8_t> payload() const { return {data.data(), len}; }
  friend bool operator==(const CanFrame& a, const CanFrame& b) {
    if (a.id != b.id || a.extended != b.extended || a.remote != b.remote || a.fd != b.fd ||
        a.error != b.error || a.len != b.len)
      return false;
    for (std::uint8_t i = 0; i < a.len; ++i)
      if (a.data[i] != b.data[i]) return false;
    return true;
  }
};

inline CanFrame make_frame(std::uint32_t id, std::initializer_list<std::uint8_t> bytes = {}) {
  CanFrame frame;
  frame.id = id;
  for (const auto byte : bytes)
    if (frame.len < 8) frame.data[frame.len++] = byte;
  return frame;
}

}  // namespace drover
