// Frames of the AgileX protocol v2: 11-bit ids, highest byte first, no checksum.
#pragma once

#include <cstdint>
#include <optional>
#include <string_view>

#include "drover/can_frame.h"
#include "drover/fixed_text.h"
#include "drover/twist.h"

namespace drover::agilex_v2 {

inline constexpr std::uint32_t kMotionCommandId = 0x111;
inline constexpr std::uint32_t kSystemStateId = 0x211;
inline constexpr std::uint32_t kMotionId = 0x221;
inline constexpr std::uint32_t kBrakeCommandId = 0x131;
inline constexpr std::uint32_t kModeCommandId = 0x421;
/// System state of protocol v1; v2 has no such id.
inline constexpr std::uint32_t kV1SystemStateId = 0x151;

enum class Vehicle : std::uint8_t { well = 0, estop = 1, exception = 2 };

/// Chassis that number modes and errors in ways of their own.
enum class Model : std::uint8_t { scout, hunter };

/// As a Scout numbers them; on other chassis only 1 means the same.
enum class Mode : std::uint8_t { standby = 0, can = 1, serial = 2, remote = 3 };
/// Somebody else commands it: what the bus asks for changes nothing.
constexpr bool is_taken(Mode mode) {
  return mode == Mode::serial || mode == Mode::remote;
}

struct SystemState {
  Vehicle vehicle = Vehicle::well;
  Mode mode = Mode::standby;
  double battery_V = 0;
  std::uint16_t error = 0;
  bool brake_locked = false;  ///< a Hunter's, of its driven wheels
};

/// Absent: too short, or a state or a mode that this chassis does not have.
std::optional<SystemState> read_system_state(const CanFrame& frame, Model model = Model::scout);
CanFrame system_state_frame(const SystemState& state, std::uint8_t count,
                            Model model = Model::scout);

/// What the wheels do. Absent: too short.
std::optional<Twist> read_motion(const CanFrame& frame);
CanFrame motion_frame(const Twist& twist);

/// Rounded towards rest to whole mm/s and thousandths of rad/s.
CanFrame motion_command(const Twist& twist);
/// Absent: another length, or a sideways speed or a steering angle in it, which a Scout has not.
std::optional<Twist> read_motion_command(const CanFrame& frame);

/// What a Hunter is told, and tells: its speed, and the angle of its inner wheel, left positive.
struct Steered {
  double speed_mps = 0;
  double inner_rad = 0;
};
/// Rounded towards rest, and towards straight on.
CanFrame steered_command(const Steered& wanted);
/// Absent: another length, or a turn or a sideways speed in it, which a Hunter has not.
std::optional<Steered> read_steered_command(const CanFrame& frame);
/// Absent: too short.
std::optional<Steered> read_steered_motion(const CanFrame& frame);
CanFrame steered_motion_frame(const Steered& steered);

/// Of a Hunter's driven wheels.
CanFrame brake_command(bool lock);
/// Absent: another length, or neither.
std::optional<bool> read_brake_command(const CanFrame& frame);

CanFrame mode_command(Mode mode);
/// Absent: another length, or neither standby nor CAN.
std::optional<Mode> read_mode_command(const CanFrame& frame);

/// An error word in words, and which of its bits have none.
struct ErrorWords {
  Reason text;
  unsigned unnamed = 0;
};
ErrorWords error_words(std::uint16_t error, Model model = Model::scout);

}  // namespace drover::agilex_v2
