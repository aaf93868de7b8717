// DAMIAO motors in MIT mode, frames as values: pure functions, total over any frame.
//
// Source: the maker's control library (cmjang/DM_Control_Python, DM_CAN.py), protocol notes of
// jia-xie/python-damiao-driver and enactic/openarm_can. Values at this level are the motor's, at
// its output shaft: what the number of a frame means depends on three ranges that stand in its
// registers.
#pragma once

#include <cstdint>
#include <optional>

#include "drivers/mit/frame.h"
#include "drover/can_frame.h"

namespace drover::damiao {

using mit::decode_mit_raw;
using mit::decode_special;
using mit::encode_mit;
using mit::encode_special;
using mit::kDampingMax_Nmsprad;
using mit::kStiffnessMax_Nmprad;
using mit::MitCommand;
using mit::MitRaw;
using mit::only_damps;
using mit::Ranges;
using mit::scale;
using mit::Special;

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
  mit::Motion motion;
  double mos_degC = 0;
  double rotor_degC = 0;

  bool enabled() const { return status == static_cast<std::uint8_t>(MotorStatus::enabled); }
  bool disabled() const { return status == static_cast<std::uint8_t>(MotorStatus::disabled); }
  bool lost_comm() const { return status == static_cast<std::uint8_t>(MotorStatus::lost_comm); }
  /// One of the documented errors.
  bool failed() const;
  /// Its motor gives no torque. Of what nobody has documented nobody knows: it may hold.
  bool off() const { return disabled() || failed(); }
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

// To the motor, beside what MIT mode has.
CanFrame encode_read(std::uint8_t id, std::uint8_t rid);
CanFrame encode_write(std::uint8_t id, std::uint8_t rid, std::uint32_t raw);
/// Asks for a feedback, and enables nothing.
CanFrame encode_request(std::uint8_t id);

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
