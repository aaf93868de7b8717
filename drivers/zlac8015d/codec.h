// Frames of a ZLAC8015D: one CANopen node that drives two hub motors.
// Source: "ZLAC8015D CANopen Communication Routine V1.07 (2025-07-16)"; README.md has the doubts.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string_view>

#include "drivers/canopen/cia402.h"
#include "drover/can_frame.h"
#include "drover/fixed_text.h"

namespace drover::zlac8015d {

inline constexpr std::size_t kWheels = 2;
inline constexpr std::size_t kLeft = 0;
inline constexpr std::size_t kRight = 1;

/// Of the maker's own; everything else is in canopen/cia402.h.
inline constexpr std::uint16_t kSilenceTime = 0x2000;       ///< ms, 0: off
inline constexpr std::uint16_t kSynchronous = 0x200F;       ///< 0: a target for each wheel
inline constexpr std::uint16_t kDriverParameters = 0x2026;  ///< sub 5: 1/n rpm of a target
inline constexpr std::uint16_t kHeartbeatTime = 0x1017;     ///< ms
inline constexpr std::uint16_t kAccelerationTime = 0x6083;  ///< ms
inline constexpr std::uint16_t kDecelerationTime = 0x6084;  ///< ms
inline constexpr std::uint8_t kVelocityMode = 3;
inline constexpr std::uint16_t kStopsAndHolds = 5;  ///< of 605A

/// Ids of one node, each with its number.
enum class Cob : std::uint32_t {
  nmt = 0x000,
  emergency = 0x080,
  status = 0x180,       ///< two statuswords and two error words
  velocities = 0x280,   ///< i32, 0.1 rpm, left and right
  positions = 0x380,    ///< i32, counts, left and right
  controlword = 0x200,  ///< u16, for both wheels
  targets = 0x300,      ///< i32, left and right
  sdo_answer = 0x580,
  sdo_request = 0x600,
  heartbeat = 0x700,
};
constexpr std::uint32_t id_of(Cob cob, std::uint8_t node) {
  return cob == Cob::nmt ? 0U : static_cast<std::uint32_t>(cob) + node;
}

inline constexpr std::uint8_t kSubs[] = {1, 2};  ///< of an object: left, right
inline constexpr std::uint8_t kSdoRead = 0x40;

using Pair = std::array<std::int32_t, kWheels>;

CanFrame encode_controlword(std::uint8_t node, std::uint16_t controlword);
CanFrame encode_targets(std::uint8_t node, const Pair& targets);

/// The maker's papers disagree on which half of these words is the left wheel's, so what holds for
/// one wheel is taken for both.
struct Status {
  std::array<std::uint16_t, kWheels> statuswords{};
  std::array<std::uint16_t, kWheels> errors{};
};

/// Nothing for other frames, and for those of a wrong length.
std::optional<Status> decode_status(const CanFrame& frame, std::uint8_t node);
/// Of `Cob::velocities`, `Cob::positions` or `Cob::targets`.
std::optional<Pair> decode_pair(const CanFrame& frame, Cob cob, std::uint8_t node);
std::optional<std::uint16_t> decode_controlword(const CanFrame& frame, std::uint8_t node);

/// Of one wheel. This maker leaves bit 6 alone: a drive that is off shows none of the lowest bits.
canopen::DriveState wheel_state(std::uint16_t statusword);
/// Of both: a fault of one is a fault, and a step is done when both have done it.
canopen::DriveState drive_state(const Status& status);
/// The power stage of either wheel is on.
bool is_powered(const Status& status);
/// The input on the drive's own connector is pressed.
bool external_estop(const Status& status);
/// The worst error of both wheels in words, and whether only one has any; empty: none.
Reason error_text(const Status& status);

}  // namespace drover::zlac8015d
