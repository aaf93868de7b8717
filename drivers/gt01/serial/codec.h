// Packets of the GT01's serial sibling (protocol 1.0.3, RS-232, 115200 8N1) as values: pure
// functions, total over any bytes.
//
// Source: the maker's documents (ushisoft/searobot-docs, searobot/*.md). A packet is ED DE, a
// sequence number (u16), its id, the length of the whole packet, data, the sum of all bytes before
// it (u16), BD BC. All numbers are little endian.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <variant>

#include "drover/message.h"
#include "drover/twist.h"

namespace drover::gt01::serial {

inline constexpr std::uint8_t kHead[2] = {0xED, 0xDE};
inline constexpr std::uint8_t kTail[2] = {0xBD, 0xBC};
/// What stands before a packet's data, and behind it.
inline constexpr std::size_t kBeforeData = 6;
inline constexpr std::size_t kAfterData = 4;
/// No packet of the documents is longer than half of it.
inline constexpr std::size_t kLongest = 64;

namespace id {
inline constexpr std::uint8_t kUploadSwitch = 0x01;  ///< turns the upload off: never to be sent
inline constexpr std::uint8_t kMotion = 0x02;
inline constexpr std::uint8_t kEstop = 0x03;
inline constexpr std::uint8_t kUpload = 0x81;
inline constexpr std::uint8_t kChassis = 0x89;
}  // namespace id

/// Bits of Upload::status.
namespace status {
inline constexpr std::uint16_t kHardEstop = 1U << 0U;
inline constexpr std::uint16_t kRemoteEstop = 1U << 1U;
inline constexpr std::uint16_t kSoftEstop = 1U << 2U;
inline constexpr std::uint16_t kRemoteOffline = 1U << 3U;
inline constexpr std::uint16_t kFrontDriveOffline = 1U << 4U;
inline constexpr std::uint16_t kRearDriveOffline = 1U << 5U;
inline constexpr std::uint16_t kFrontLeftError = 1U << 6U;
inline constexpr std::uint16_t kFrontRightError = 1U << 7U;
inline constexpr std::uint16_t kRearLeftError = 1U << 8U;
inline constexpr std::uint16_t kRearRightError = 1U << 9U;
inline constexpr std::uint16_t kFrontBumper = 1U << 10U;
inline constexpr std::uint16_t kRearBumper = 1U << 11U;
inline constexpr std::uint16_t kDockingOn = 1U << 12U;
}  // namespace status

/// 50 times a second from power-up on.
struct Upload {
  double voltage_V = 0;
  std::uint16_t status = 0;
  std::uint16_t docking = 0;
  Twist twist;                         ///< of the chassis, as measured
  std::array<double, 4> wheels_mps{};  ///< front left, front right, rear left, rear right
};

/// The answer to 0x09.
struct Chassis {
  double track_m = 0;
  double wheelbase_m = 0;
  double wheel_diameter_m = 0;
  int gear_ratio = 0;
  int encoder_lines = 0;
};

/// A packet that is well formed, and says nothing that is used.
struct Other {
  std::uint8_t id = 0;
};

using Report = std::variant<Upload, Chassis, Other>;

/// The sum that ends a packet.
std::uint16_t checksum(std::span<const std::uint8_t> bytes);
/// The whole size of the packet that begins with these bytes, at least kBeforeData of them; 0 when
/// none can. The manual's own example of 0x89 states two bytes less than it has.
std::size_t packet_size(std::span<const std::uint8_t> begin);
/// Absent unless it is one whole packet with its head, tail, sum, and data as long as its id says.
std::optional<Report> decode(std::span<const std::uint8_t> packet);
/// One whole packet with its head, tail and sum.
bool is_whole(std::span<const std::uint8_t> packet);

/// A whole packet of this id; `data` of at most kLongest - kBeforeData - kAfterData bytes.
Packet compose(std::uint16_t sequence, std::uint8_t id, std::span<const std::uint8_t> data);
/// Drive so: the speed in whole mm/s, never more than asked. Beyond what a packet can say
/// (32.767 m/s) it says the most; what is no number is rest.
Packet motion(std::uint16_t sequence, const Twist& twist);
/// The software's own emergency stop; `on` false ends it.
Packet estop(std::uint16_t sequence, bool on);

/// The twist that a packet asks for; absent when it asks for none, or for wheel speeds.
std::optional<Twist> asked_twist(std::span<const std::uint8_t> packet);

}  // namespace drover::gt01::serial
