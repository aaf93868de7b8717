// LD06 and LD19 packets: bytes to values and back. Total functions, no state.
//
// Source: LDROBOT LD06 and LD19 development manuals; ldrobotSensorTeam/ldlidar_stl_ros2
// (ldlidar_driver/src/dataprocess/lipkg.cpp), for the checksum and the points a second.
#pragma once

#include <array>
#include <cstdint>
#include <span>

#include "drover/result.h"

namespace drover::ld06 {

inline constexpr std::uint8_t kHeader = 0x54;
inline constexpr std::uint8_t kKind = 0x2C;  ///< packet type 1 and, in five bits, 12 beams
inline constexpr std::size_t kPacketSize = 47;
inline constexpr std::size_t kBeams = 12;
inline constexpr double kPoints_Hz = 4500;  ///< measured, whatever the motor does
inline constexpr double kTurn_Hz = 10;      ///< as it is shipped and left alone
inline constexpr int kTurn_cdeg = 36000;    ///< angles on the wire are hundredths of a degree
inline constexpr std::uint16_t kStampWrap = 30000;  ///< of the device's milliseconds

struct Beam {
  std::uint16_t range_mm = 0;  ///< 0: no return
  std::uint8_t intensity = 0;
  friend bool operator==(const Beam&, const Beam&) = default;
};

/// One packet: twelve beams, equally spaced from the first angle to the last. Angles count
/// clockwise seen from the sensor's top.
struct Slice {
  std::uint16_t speed_degps = 0;
  std::uint16_t start_cdeg = 0;  ///< of the first beam, below kTurn_cdeg
  std::array<Beam, kBeams> beams{};
  std::uint16_t end_cdeg = 0;  ///< of the last beam
  std::uint16_t stamp_ms = 0;
};

/// From the first beam to the last; an end below the start is past zero.
int span_cdeg(const Slice& slice);

enum class Fault : std::uint8_t {
  length,
  header,
  checksum,
  angle,  ///< beyond a turn
  span,   ///< more than twelve beams can cover
  stamp,  ///< beyond its wrap
};

/// CRC-8: polynomial 0x4D, begins at 0, not reflected.
std::uint8_t crc8(std::span<const std::uint8_t> bytes);

/// A packet whose checksum is right may still be refused: an 8-bit sum lets one in 256 pass.
Result<Slice, Fault> decode(std::span<const std::uint8_t> bytes);

std::array<std::uint8_t, kPacketSize> encode(const Slice& slice);

}  // namespace drover::ld06
