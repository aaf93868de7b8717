// Protobuf and packet bytes from the field numbers alone, independent of the product's encoder.
#pragma once

#include <cstdint>
#include <cstring>
#include <string>
#include <string_view>

namespace drover::test {

/// "0a 03" as bytes; blanks are skipped.
inline std::string hex(std::string_view digits) {
  std::string bytes;
  int high = -1;
  for (const char c : digits) {
    if (c == ' ' || c == '\n') continue;
    const int value = c <= '9' ? c - '0' : c - 'a' + 10;
    if (high >= 0) bytes += static_cast<char>(high * 16 + value);
    high = high < 0 ? value : -1;
  }
  return bytes;
}

inline std::string varint(std::uint64_t value) {
  std::string bytes;
  for (; value >= 0x80; value >>= 7U) bytes += static_cast<char>((value & 0x7FU) | 0x80U);
  return bytes + static_cast<char>(value);
}

inline std::string varint_field(unsigned number, std::uint64_t value) {
  return varint(number << 3U) + varint(value);
}

inline std::string bytes_field(unsigned number, std::string_view bytes) {
  return varint(number << 3U | 2U) + varint(bytes.size()) + std::string(bytes);
}

inline std::string little_endian(double value) {
  std::uint64_t bits = 0;
  std::memcpy(&bits, &value, sizeof bits);
  std::string bytes;
  for (int i = 0; i < 8; ++i) bytes += static_cast<char>(bits >> (8 * i) & 0xFFU);
  return bytes;
}

inline std::string double_field(unsigned number, double value) {
  return varint(number << 3U | 1U) + little_endian(value);
}

/// One entry of JointCommand's joints: name = 1, position, velocity, effort, stiffness, damping.
inline std::string joint_entry(std::string_view name, double position, double velocity,
                               double effort = 0, double stiffness = 0, double damping = 0) {
  return bytes_field(2, bytes_field(1, name) + double_field(2, position) +
                            double_field(3, velocity) + double_field(4, effort) +
                            double_field(5, stiffness) + double_field(6, damping));
}

inline std::string stamp(std::uint64_t time_stamp_ns) {
  return bytes_field(1, varint_field(1, time_stamp_ns));
}

/// The content type "pb", no context, the message.
inline std::string in_packet(std::string_view message) {
  return hex("02 70 62 00") + std::string(message);
}

}  // namespace drover::test
