// Helpers for tests that speak NMEA 0183: checksums and bytes.
#pragma once

#include <cstdint>
#include <cstdio>
#include <span>
#include <string>
#include <string_view>

namespace drover::nmea0183::test {

inline std::string checksum(std::string_view body) {
  unsigned sum = 0;
  for (const char c : body) sum ^= static_cast<unsigned char>(c);
  char text[3];
  std::snprintf(text, sizeof text, "%02X", sum & 0xFFU);
  return text;
}
/// The whole line of a body, right checksum and line end included.
inline std::string line(std::string_view body) {
  return "$" + std::string(body) + "*" + checksum(body) + "\r\n";
}
inline std::span<const std::uint8_t> bytes(std::string_view text) {
  return {reinterpret_cast<const std::uint8_t*>(text.data()), text.size()};
}

}  // namespace drover::nmea0183::test
