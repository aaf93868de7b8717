// Frames of the GT01 chassis on CAN (protocol 1.0, 500 kbit/s, 11-bit ids) as values: pure
// functions, little endian, total over any frame.
//
// Source: the maker's documents (ushisoft/searobot-docs, gt01/*.md). Table and examples disagree in
// three places; what is taken is the examples' reading, and said at the place.
#pragma once

#include <cstdint>
#include <optional>
#include <variant>

#include "drover/can_frame.h"
#include "drover/twist.h"

namespace drover::gt01::can {

/// Every command has this id; its first two bytes say which.
inline constexpr std::uint32_t kCommandId = 0x01;

/// Who drives.
enum class Mode : std::uint8_t { idle = 0, remote = 1, host = 2, docking = 3 };

/// Bits of State::status.
namespace status {
inline constexpr std::uint8_t kHardEstop = 1U << 0U;
inline constexpr std::uint8_t kRemoteEstop = 1U << 1U;
inline constexpr std::uint8_t kSoftEstop = 1U << 2U;
inline constexpr std::uint8_t kRemoteOffline = 1U << 3U;
inline constexpr std::uint8_t kFrontBumper = 1U << 4U;
inline constexpr std::uint8_t kRearBumper = 1U << 5U;
}  // namespace status

/// Bits of State::error.
namespace error {
inline constexpr std::uint8_t kDriveOffline = 1U << 0U;
inline constexpr std::uint8_t kDriveError = 1U << 1U;
}  // namespace error

/// 0x10, 50 times a second.
struct Motion {
  Twist twist;
};
/// 0x11, 50 times a second.
struct Wheels {
  double left_mps = 0;
  double right_mps = 0;
};
/// 0x12, 100 times a second.
struct Currents {
  double left_A = 0;
  double right_A = 0;
};
/// 0x20, 100 times a second. The percentage is computed from the voltage.
struct State {
  std::uint8_t mode = 0;  ///< a Mode, when it is one
  std::uint8_t battery_percent = 0;
  double voltage_V = 0;
  std::uint8_t status = 0;
  std::uint8_t error = 0;
};
/// 0x30, 100 times a second: bits of each motor.
struct MotorFaults {
  std::uint16_t left = 0;
  std::uint16_t right = 0;
};
/// 0x41
struct Version {
  std::uint8_t major = 0;
  std::uint8_t minor = 0;
  std::uint8_t patch = 0;
};

using Report = std::variant<Motion, Wheels, Currents, State, MotorFaults, Version>;

/// Absent for every frame that is not one of these, exactly as documented.
std::optional<Report> decode(const CanFrame& frame);
/// What a bit of MotorFaults means, for people; "" for bits that mean nothing.
const char* motor_fault(unsigned bit);

/// Where the twist stands in a command: the examples put "01 01" before it, the table does not. In
/// the table's layout a speed whose low byte is 01 reads as another command.
enum class TwistLayout : std::uint8_t { example, table };

/// Drive so: in whole thousandths, never more than asked. Beyond what a frame can say (32.767 m/s)
/// it says the most; what is no number is rest.
CanFrame motion(const Twist& twist, TwistLayout layout = TwistLayout::example);
/// The software's own emergency stop; `on` false ends it.
CanFrame estop(bool on);
CanFrame ask_version();

/// The twist that a command asks for; absent when it asks for none. A frame of wheel speeds cannot
/// be told from other commands (15 mm/s on the left reads as "end the emergency stop"), so nothing
/// here writes one.
std::optional<Twist> asked_twist(const CanFrame& frame, TwistLayout layout = TwistLayout::example);

}  // namespace drover::gt01::can
