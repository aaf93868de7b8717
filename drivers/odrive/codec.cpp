// CANSimple layouts, byte by byte.
#include "drivers/odrive/codec.h"

#include <bit>
#include <cmath>
#include <limits>

#include "drover/bytes.h"

namespace drover::odrive {
namespace {

void put_u16(CanFrame& frame, std::uint16_t value) {
  store_le(frame.data, frame.len, value);
  frame.len += 2;
}

void put_u32(CanFrame& frame, std::uint32_t value) {
  store_le(frame.data, frame.len, value);
  frame.len += 4;
}

float finite_float(double value) {
  if (!std::isfinite(value)) return 0.0F;
  constexpr double kMax = std::numeric_limits<float>::max();
  return static_cast<float>(std::fmin(std::fmax(value, -kMax), kMax));
}

CanFrame sdo(std::uint8_t node, std::uint8_t opcode, std::uint16_t endpoint) {
  CanFrame frame = make_frame(frame_id(node, cmd::kRxSdo), {opcode});
  put_u16(frame, endpoint);
  frame.data[frame.len++] = 0;
  return frame;
}

}  // namespace

std::uint32_t read_u32(const CanFrame& frame, std::uint8_t at) {
  std::uint32_t value = 0;
  for (std::uint8_t i = 0; i < 4; ++i)
    if (at + i < frame.len) value |= static_cast<std::uint32_t>(frame.data[at + i]) << (8U * i);
  return value;
}

float read_float(const CanFrame& frame, std::uint8_t at) {
  return std::bit_cast<float>(read_u32(frame, at));
}

float SdoValue::as_float() const {
  return std::bit_cast<float>(raw);
}

std::optional<Heartbeat> decode_heartbeat(const CanFrame& frame, Firmware firmware) {
  if (frame.remote || frame.len != 8) return {};
  Heartbeat heartbeat;
  heartbeat.error = read_u32(frame, 0);
  heartbeat.state = frame.data[4];
  if (firmware == Firmware::v0_6) {
    heartbeat.procedure_result = frame.data[5];
    heartbeat.trajectory_done = (frame.data[6] & 1U) != 0;
  } else {
    heartbeat.motor_error = (frame.data[5] & 1U) != 0;
    heartbeat.encoder_error = (frame.data[6] & 1U) != 0;
    heartbeat.controller_error = (frame.data[7] & 1U) != 0;
    heartbeat.trajectory_done = (frame.data[7] & 0x80U) != 0;
  }
  return heartbeat;
}

CanFrame encode_heartbeat(std::uint8_t node, const Heartbeat& heartbeat, Firmware firmware) {
  CanFrame frame = encode_words(node, cmd::kHeartbeat, heartbeat.error, heartbeat.state);
  const std::uint8_t done = heartbeat.trajectory_done ? 1 : 0;
  if (firmware == Firmware::v0_6) {
    frame.data[5] = heartbeat.procedure_result;
    frame.data[6] = done;
  } else {
    frame.data[5] = heartbeat.motor_error ? 1 : 0;
    frame.data[6] = heartbeat.encoder_error ? 1 : 0;
    frame.data[7] = static_cast<std::uint8_t>(done << 7U | (heartbeat.controller_error ? 1U : 0U));
  }
  return frame;
}

std::optional<DriveError> decode_error_0_6(const CanFrame& frame) {
  if (frame.remote || frame.len != 8) return {};
  return DriveError{read_u32(frame, 0), read_u32(frame, 4)};
}

std::optional<std::uint64_t> decode_motor_error_0_5(const CanFrame& frame) {
  if (frame.remote || frame.len != 8) return {};
  return static_cast<std::uint64_t>(read_u32(frame, 4)) << 32U | read_u32(frame, 0);
}

std::optional<std::uint32_t> decode_u32_error_0_5(const CanFrame& frame) {
  if (frame.remote || (frame.len != 4 && frame.len != 8)) return {};
  return read_u32(frame, 0);
}

[[gnu::hot]] std::optional<FloatPair> decode_floats(const CanFrame& frame) {
  if (frame.remote || frame.len != 8) return {};
  return FloatPair{load_le_float(frame.data, 0), load_le_float(frame.data, 4)};
}

std::optional<SdoValue> decode_tx_sdo(const CanFrame& frame) {
  if (frame.remote || frame.len < 4 || frame.len > 8 || frame.data[0] != 0) return {};
  SdoValue value;
  value.endpoint = load_le<std::uint16_t>(frame.data, 1);
  value.size = frame.len - 4;
  value.raw = read_u32(frame, 4);
  return value;
}

CanFrame encode_words(std::uint8_t node, std::uint8_t command, std::uint32_t first,
                      std::uint32_t second) {
  CanFrame frame = make_frame(frame_id(node, command));
  put_u32(frame, first);
  put_u32(frame, second);
  return frame;
}

CanFrame encode_floats(std::uint8_t node, std::uint8_t command, float first, float second) {
  return encode_words(node, command, std::bit_cast<std::uint32_t>(first),
                      std::bit_cast<std::uint32_t>(second));
}

CanFrame encode_set_axis_state(std::uint8_t node, std::uint32_t state) {
  CanFrame frame = make_frame(frame_id(node, cmd::kSetAxisState));
  put_u32(frame, state);
  return frame;
}

CanFrame encode_set_controller_mode(std::uint8_t node, std::uint32_t control, std::uint32_t input) {
  return encode_words(node, cmd::kSetControllerMode, control, input);
}

CanFrame encode_set_input_vel(std::uint8_t node, double velocity_turnps, double torque_Nm) {
  return encode_floats(node, cmd::kSetInputVel, finite_float(velocity_turnps),
                       finite_float(torque_Nm));
}

CanFrame encode_clear_errors(std::uint8_t node) {
  // The byte of firmware 0.6 ("identify": do not blink); 0.5 takes no payload and ignores it.
  return make_frame(frame_id(node, cmd::kClearErrors), {0});
}

CanFrame encode_poll(std::uint8_t node, std::uint8_t command) {
  CanFrame frame = make_frame(frame_id(node, command));
  frame.remote = true;
  return frame;
}

CanFrame encode_sdo_read(std::uint8_t node, std::uint16_t endpoint) {
  return sdo(node, 0, endpoint);
}

CanFrame encode_sdo_write_float(std::uint8_t node, std::uint16_t endpoint, float value) {
  CanFrame frame = sdo(node, 1, endpoint);
  put_u32(frame, std::bit_cast<std::uint32_t>(value));
  return frame;
}

CanFrame encode_sdo_write_bool(std::uint8_t node, std::uint16_t endpoint, bool value) {
  CanFrame frame = sdo(node, 1, endpoint);
  frame.data[frame.len++] = value ? 1 : 0;
  return frame;
}

}  // namespace drover::odrive
