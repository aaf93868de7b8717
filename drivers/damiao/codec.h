// DAMIAO motors in MIT mode, frames as values: pure functions, total over any frame.
//
// Source: the maker's control library (cmjang/DM_Control_Python, DM_CAN.py), protocol notes of
// jia-xie/python-damiao-driver and enactic/openarm_can. Values at this level are the motor's, at
// its output shaft: what the number of a frame means depends on three ranges that stand in its
// registers.
#pragma once

#include <cstdint>
#include <optional>

#include "drover/can_frame.h"

namespace drover::damiao {

/// Ends of the symmetric ranges (PMAX, VMAX, TMAX) that fill a frame's fields.
struct Ranges {
  double p_max_rad = 12.5;
  double v_max_radps = 30;
  double t_max_Nm = 10;
};
inline constexpr double kStiffnessMax_Nmprad = 500;
inline constexpr double kDampingMax_Nmsprad = 5;

/// What an MIT frame says: torque = stiffness (position - p) + damping (velocity - v) + torque.
struct MitCommand {
  double position_rad = 0;
  double velocity_radps = 0;
  double stiffness_Nmprad = 0;
  double damping_Nmsprad = 0;
  double torque_Nm = 0;
};

/// Its fields as they stand in the frame.
struct MitRaw {
  std::uint16_t position = 0;  ///< 16 bits
  std::uint16_t velocity = 0;  ///< 12 bits, as the others
  std::uint16_t stiffness = 0;
  std::uint16_t damping = 0;
  std::uint16_t torque = 0;
};

/// The last byte of a frame that begins with seven FF.
enum class Special : std::uint8_t {
  clear_error = 0xFB,
  enable = 0xFC,
  disable = 0xFD,
  set_zero = 0xFE,  ///< where it stands becomes its zero: never sent
};

enum class MotorStatus : std::uint8_t {
  disabled = 0,
  enabled = 1,
  over_voltage = 8,
  under_voltage = 9,
  over_current = 0xA,
  mos_hot = 0xB,
  rotor_hot = 0xC,
  lost_comm = 0xD,
  overload = 0xE,
};

struct Feedback {
  std::uint8_t status = 0;  ///< a MotorStatus, or what nobody has documented
  double position_rad = 0;
  double velocity_radps = 0;
  double torque_Nm = 0;
  double mos_degC = 0;
  double rotor_degC = 0;

  bool enabled() const { return status == static_cast<std::uint8_t>(MotorStatus::enabled); }
  bool disabled() const { return status == static_cast<std::uint8_t>(MotorStatus::disabled); }
  bool lost_comm() const { return status == static_cast<std::uint8_t>(MotorStatus::lost_comm); }
  /// One of the documented errors.
  bool failed() const;
};

/// Requests that any motor may hear, under one id; its own is in the first two bytes.
inline constexpr std::uint32_t kRequestId = 0x7FF;

namespace reg {
inline constexpr std::uint8_t kTimeout = 9;  ///< u32 in units of 50 us; 0: none
inline constexpr std::uint8_t kMode = 10;    ///< u32, 1: MIT
inline constexpr std::uint8_t kPMax = 21;    ///< float, as the two below
inline constexpr std::uint8_t kVMax = 22;
inline constexpr std::uint8_t kTMax = 23;
inline constexpr std::uint8_t kLast = 81;
}  // namespace reg
inline constexpr std::uint32_t kMitMode = 1;
inline constexpr std::uint32_t kTimeoutUnitsPerMs = 20;

enum class Verb : std::uint8_t { read = 0x33, write = 0x55, store = 0xAA, feedback = 0xCC };

struct RegisterReply {
  Verb verb = Verb::read;
  std::uint8_t rid = 0;
  std::uint32_t raw = 0;
  float as_float() const;
};

// To the motor. What is beyond a range stands at its end, what is no number at zero; stiffness and
// damping stay one step below the end of theirs, or a frame with all at the end would be one of the
// special ones.
CanFrame encode_mit(std::uint8_t id, const MitCommand& command, const Ranges& ranges);
CanFrame encode_special(std::uint8_t id, Special special);
CanFrame encode_read(std::uint8_t id, std::uint8_t rid);
CanFrame encode_write(std::uint8_t id, std::uint8_t rid, std::uint32_t raw);
/// Asks for a feedback, and enables nothing.
CanFrame encode_request(std::uint8_t id);

// What was sent to it. A velocity or torque in the middle of its range is 0, not half a step less.
std::optional<Special> decode_special(const CanFrame& frame, std::uint8_t id);
/// Absent for a special frame.
std::optional<MitRaw> decode_mit_raw(const CanFrame& frame, std::uint8_t id);
MitCommand scale(const MitRaw& raw, const Ranges& ranges);
/// Neither stiffness nor torque nor a speed: whatever its damping, it only brakes.
bool only_damps(const MitRaw& raw);

// From the motor, under its master id.
/// A feedback may look like this one by chance: position and speed near the lower ends of their
/// ranges, the motor disabled.
std::optional<RegisterReply> decode_reply(const CanFrame& frame, std::uint8_t id);
/// Absent when it is another motor's, or shorter.
std::optional<Feedback> decode_feedback(const CanFrame& frame, std::uint8_t id,
                                        const Ranges& ranges);

// Building blocks that the twin uses from the other side.
CanFrame encode_feedback(std::uint32_t master_id, std::uint8_t id, const Feedback& feedback,
                         const Ranges& ranges);
CanFrame encode_reply(std::uint32_t master_id, std::uint8_t id, const RegisterReply& reply);

}  // namespace drover::damiao
