// Checksums that more than one room needs.
#pragma once

#include <cstdint>
#include <span>

namespace drover {

/// CRC-16 of Modbus RTU (polynomial 0xA001 reflected, begins at 0xFFFF); its low byte goes first on
/// the wire. Source: MODBUS over Serial Line V1.02, 6.2.2.
constexpr std::uint16_t modbus_crc(std::span<const std::uint8_t> bytes) {
  unsigned crc = 0xFFFF;
  for (const std::uint8_t byte : bytes) {
    crc ^= byte;
    for (int i = 0; i < 8; ++i) crc = (crc & 1U) != 0 ? (crc >> 1U) ^ 0xA001U : crc >> 1U;
  }
  return static_cast<std::uint16_t>(crc);
}

}  // namespace drover
