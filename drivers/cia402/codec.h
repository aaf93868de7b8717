// Process data of a drive of CiA 402 in a velocity mode, as this driver maps it.
// Source: CiA 301, section 7.2.2; CiA 402-2 (IEC 61800-7-201).
#pragma once

#include <cstdint>
#include <optional>

#include "drivers/canopen/cia402.h"
#include "drover/can_frame.h"

namespace drover::cia402 {

/// Ids of one node, each with its number.
enum class Cob : std::uint32_t {
  emergency = 0x080,
  status = 0x180,    ///< 6041, 606C
  position = 0x280,  ///< 6064, and 6077 where it is asked for
  command = 0x200,   ///< 6040, 60FF
  sdo_answer = 0x580,
  sdo_request = 0x600,
  heartbeat = 0x700,
};
constexpr std::uint32_t id_of(Cob cob, std::uint8_t node) {
  return static_cast<std::uint32_t>(cob) + node;
}

struct Command {
  std::uint16_t controlword = 0;
  std::int32_t target = 0;
  friend bool operator==(const Command&, const Command&) = default;
};
struct Status {
  std::uint16_t statusword = 0;
  std::int32_t velocity = 0;
  canopen::DriveState state() const { return canopen::drive_state(statusword); }
};
struct Position {
  std::int32_t counts = 0;
  std::int16_t torque_permille = 0;
};

/// All give nothing for other frames, and for those of a wrong length.
CanFrame encode_command(std::uint8_t node, const Command& command);
std::optional<Command> decode_command(const CanFrame& frame, std::uint8_t node);
std::optional<Status> decode_status(const CanFrame& frame, std::uint8_t node);
std::optional<Position> decode_position(const CanFrame& frame, std::uint8_t node, bool torque);

/// The controlword that leaves a drive in the state that it is in.
std::uint16_t keeping_controlword(canopen::DriveState state);

}  // namespace drover::cia402
