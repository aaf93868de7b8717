// Frames of RoboMaster C620 and C610 motor controllers. Sources: README.md.
#pragma once

#include <array>
#include <cstdint>
#include <optional>

#include "drover/can_frame.h"

namespace drover::robomaster {

inline constexpr std::size_t kMotors = 4;  ///< that one command is for

inline constexpr std::uint32_t kCommandFirst = 0x200;   ///< motors 1 to 4
inline constexpr std::uint32_t kCommandSecond = 0x1FF;  ///< motors 5 to 8
inline constexpr std::uint32_t kFeedback = 0x200;       ///< and the motor's number
inline constexpr int kAnglesPerTurn = 8192;             ///< of the rotor

/// As they stand on the wire, in the order of the motors' numbers.
using Currents = std::array<std::int16_t, kMotors>;

CanFrame encode_currents(std::uint32_t command_id, const Currents& currents);
/// Nothing for other frames, and for those of a wrong length.
std::optional<Currents> decode_currents(const CanFrame& frame, std::uint32_t command_id);

/// What a controller tells, unasked, a thousand times a second.
struct Feedback {
  std::uint16_t angle = 0;  ///< of the rotor, 0 to 8191
  std::int16_t rpm = 0;     ///< of the rotor
  std::int16_t current = 0;
  std::uint8_t degC = 0;  ///< of the motor; a C610 says 0
};

CanFrame encode_feedback(int motor, const Feedback& feedback);
/// Nothing for other frames, for those of a wrong length, and for an angle beyond a turn.
std::optional<Feedback> decode_feedback(const CanFrame& frame, int motor);

}  // namespace drover::robomaster
