// The command frame of MIT mode, as DAMIAO's and CubeMars' motors have it, as values: pure
// functions, total over any frame.
//
// Values at this level are the motor's, at its output shaft: what the number of a frame means
// depends on three ranges that stand in the motor.
#pragma once

#include <cstdint>
#include <optional>
#include <span>

#include "drover/can_frame.h"

namespace drover::mit {

/// Ends of the symmetric ranges that fill a frame's fields.
struct Ranges {
  double p_max_rad = 12.5;
  double v_max_radps = 30;
  double t_max_Nm = 10;
};
inline constexpr double kStiffnessMax_Nmprad = 500;
inline constexpr double kDampingMax_Nmsprad = 5;
/// How much a velocity changes by one step of its twelve bits.
constexpr double speed_step_radps(const Ranges& ranges) {
  return 2 * ranges.v_max_radps / 0xFFF;
}

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
  clear_error = 0xFB,  ///< DAMIAO's alone
  enable = 0xFC,
  disable = 0xFD,
  set_zero = 0xFE,  ///< where it stands becomes its zero: never sent
};

/// What a motor's answer says of its shaft.
struct Motion {
  double position_rad = 0;
  double velocity_radps = 0;
  double torque_Nm = 0;
};
inline constexpr std::size_t kMotionBytes = 5;

// To the motor. What is beyond a range stands at its end, what is no number at zero; stiffness and
// damping stay one step below the end of theirs, or a frame with all at the end would be one of the
// special ones.
CanFrame encode_mit(std::uint8_t id, const MitCommand& command, const Ranges& ranges);
CanFrame encode_special(std::uint8_t id, Special special);

// What was sent to it. A velocity or torque in the middle of its range is 0, not half a step less.
std::optional<Special> decode_special(const CanFrame& frame, std::uint8_t id);
/// Absent for a special frame.
std::optional<MitRaw> decode_mit_raw(const CanFrame& frame, std::uint8_t id);
MitCommand scale(const MitRaw& raw, const Ranges& ranges);
/// Neither stiffness nor torque nor a speed: whatever its damping, it only brakes.
bool only_damps(const MitRaw& raw);

// From the motor: position, velocity and torque in five bytes of its answer.
Motion decode_motion(std::span<const std::uint8_t, kMotionBytes> bytes, const Ranges& ranges);
void encode_motion(const Motion& motion, const Ranges& ranges,
                   std::span<std::uint8_t, kMotionBytes> bytes);

}  // namespace drover::mit
