#include "drivers/cia402/codec.h"

#include "drover/bytes.h"

namespace drover::cia402 {
namespace {

using canopen::DriveState;

bool is(const CanFrame& frame, Cob cob, std::uint8_t node, std::uint8_t len) {
  return frame.is_plain() && frame.id == id_of(cob, node) && frame.len == len;
}

}  // namespace

CanFrame encode_command(std::uint8_t node, const Command& command) {
  CanFrame frame = make_frame(id_of(Cob::command, node));
  frame.len = 6;
  store_le(frame.data, 0, command.controlword);
  store_le(frame.data, 2, command.target);
  return frame;
}

std::optional<Command> decode_command(const CanFrame& frame, std::uint8_t node) {
  if (!is(frame, Cob::command, node, 6)) return {};
  return Command{load_le<std::uint16_t>(frame.data, 0), load_le<std::int32_t>(frame.data, 2)};
}

std::optional<Status> decode_status(const CanFrame& frame, std::uint8_t node) {
  if (!is(frame, Cob::status, node, 6)) return {};
  return Status{load_le<std::uint16_t>(frame.data, 0), load_le<std::int32_t>(frame.data, 2)};
}

std::optional<Position> decode_position(const CanFrame& frame, std::uint8_t node, bool torque) {
  if (!is(frame, Cob::position, node, torque ? 6 : 4)) return {};
  Position position{load_le<std::int32_t>(frame.data, 0), 0};
  if (torque) position.torque_permille = load_le<std::int16_t>(frame.data, 4);
  return position;
}

std::uint16_t keeping_controlword(DriveState state) {
  switch (state) {
    case DriveState::ready_to_switch_on: return canopen::kShutdown;
    case DriveState::switched_on: return canopen::kSwitchOn;
    case DriveState::operation_enabled: return canopen::kEnableOperation;
    case DriveState::quick_stop_active: return canopen::kQuickStop;
    default: return canopen::kDisableVoltage;
  }
}

}  // namespace drover::cia402
