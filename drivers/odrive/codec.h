// ODrive CANSimple frames as values: pure functions, little endian, total over any frame.
//
// Source: ODrive documentation "CAN Protocol" for firmware 0.5.6 (docs/can-protocol.rst) and for
// firmware 0.6 (docs.odriverobotics.com). Decoders return nothing when the frame is not exactly
// as documented. Units at this level are the drive's: turns of the motor, turns per second.
#pragma once

#include <cstdint>
#include <optional>

#include "drover/can_frame.h"

namespace drover::odrive {

/// The two families share the frame ids and differ in layouts and in the meaning of errors.
enum class Firmware : std::uint8_t { v0_5_6, v0_6 };

namespace cmd {
inline constexpr std::uint8_t kHeartbeat = 0x01;
inline constexpr std::uint8_t kEstop = 0x02;
inline constexpr std::uint8_t kError = 0x03;         ///< 0.5: motor error u64; 0.6: two u32
inline constexpr std::uint8_t kEncoderError = 0x04;  ///< 0.5
inline constexpr std::uint8_t kRxSdo = 0x04;         ///< 0.6, to the drive
inline constexpr std::uint8_t kTxSdo = 0x05;         ///< 0.6, from the drive
inline constexpr std::uint8_t kSetAxisState = 0x07;
inline constexpr std::uint8_t kEstimates = 0x09;
inline constexpr std::uint8_t kSetControllerMode = 0x0B;
inline constexpr std::uint8_t kSetInputPos = 0x0C;
inline constexpr std::uint8_t kSetInputVel = 0x0D;
inline constexpr std::uint8_t kSetInputTorque = 0x0E;
inline constexpr std::uint8_t kIq = 0x14;
inline constexpr std::uint8_t kTemperature = 0x15;  ///< 0.6
inline constexpr std::uint8_t kBus = 0x17;
inline constexpr std::uint8_t kClearErrors = 0x18;
inline constexpr std::uint8_t kTorques = 0x1C;          ///< 0.6
inline constexpr std::uint8_t kControllerError = 0x1D;  ///< 0.5
}  // namespace cmd

inline constexpr std::uint8_t kStateIdle = 1;
inline constexpr std::uint8_t kStateClosedLoop = 8;
inline constexpr std::uint32_t kControlVelocity = 2;
inline constexpr std::uint32_t kInputPassthrough = 1;
/// Node 0x3F is the broadcast of firmware 0.6.
inline constexpr std::uint8_t kMaxNode = 62;

constexpr std::uint32_t frame_id(std::uint8_t node, std::uint8_t command) {
  return static_cast<std::uint32_t>(node) << 5U | command;
}
constexpr std::uint8_t command_of(std::uint32_t id) {
  return id & 0x1FU;
}
/// True for a plain 11-bit frame of that node, data or remote.
inline bool belongs_to(const CanFrame& frame, std::uint8_t node) {
  return !frame.extended && !frame.fd && !frame.error && frame.id >> 5U == node;
}

struct Heartbeat {
  std::uint32_t error = 0;
  std::uint8_t state = 0;
  std::uint8_t procedure_result = 0;  ///< 0.6
  bool motor_error = false;           ///< 0.5.6, as the two below
  bool encoder_error = false;
  bool controller_error = false;
  bool trajectory_done = false;

  bool failed() const { return error != 0 || motor_error || encoder_error || controller_error; }
};
struct DriveError {
  std::uint32_t active = 0;
  std::uint32_t disarm_reason = 0;
};
/// Two floats of one frame; what they are says the decoder's name.
struct FloatPair {
  float first = 0;
  float second = 0;
};
struct SdoValue {
  std::uint16_t endpoint = 0;
  std::uint8_t size = 0;   ///< bytes that came, 0 to 4
  std::uint32_t raw = 0;   ///< missing bytes are zero
  float as_float() const;  ///< meaningful when size is 4
};

// From the drive.
std::optional<Heartbeat> decode_heartbeat(const CanFrame& frame, Firmware firmware);
std::optional<DriveError> decode_error_0_6(const CanFrame& frame);
std::optional<std::uint64_t> decode_motor_error_0_5(const CanFrame& frame);
/// Encoder and controller errors of 0.5. Some releases fill the frame up to 8 bytes.
std::optional<std::uint32_t> decode_u32_error_0_5(const CanFrame& frame);
/// Two floats: position (turn) and velocity (turn/s); Iq set point and measured (A); temperature
/// of inverter and motor (degC, NaN: no thermistor); bus voltage (V) and current (A); torque
/// target and estimate (Nm at the motor).
std::optional<FloatPair> decode_floats(const CanFrame& frame);
std::optional<SdoValue> decode_tx_sdo(const CanFrame& frame);

// To the drive.
CanFrame encode_set_axis_state(std::uint8_t node, std::uint32_t state);
CanFrame encode_set_controller_mode(std::uint8_t node, std::uint32_t control, std::uint32_t input);
/// What is not finite becomes zero: a drive must never see it.
CanFrame encode_set_input_vel(std::uint8_t node, double velocity_turnps, double torque_Nm = 0);
CanFrame encode_clear_errors(std::uint8_t node);
CanFrame encode_poll(std::uint8_t node, std::uint8_t command);
CanFrame encode_sdo_read(std::uint8_t node, std::uint16_t endpoint);
CanFrame encode_sdo_write_float(std::uint8_t node, std::uint16_t endpoint, float value);
CanFrame encode_sdo_write_bool(std::uint8_t node, std::uint16_t endpoint, bool value);

// Building blocks that the twin uses from the other side.
CanFrame encode_floats(std::uint8_t node, std::uint8_t command, float first, float second);
CanFrame encode_words(std::uint8_t node, std::uint8_t command, std::uint32_t first,
                      std::uint32_t second);
CanFrame encode_heartbeat(std::uint8_t node, const Heartbeat& heartbeat, Firmware firmware);
/// Little endian at `at`; zero beyond the payload.
std::uint32_t read_u32(const CanFrame& frame, std::uint8_t at);
float read_float(const CanFrame& frame, std::uint8_t at);

}  // namespace drover::odrive
