// WitMotion frames and commands: bytes to values and back. Total functions, no state.
//
// Source: WIT Standard Communication Protocol (wit-motion.gitbook.io), HWT905 protocol
// (docs.wit-motion.com), register list of WITMOTION/WitStandardProtocol_JY901.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <variant>

#include "drover/measurement.h"

namespace drover::witmotion {

inline constexpr std::uint8_t kHeader = 0x55;
inline constexpr std::size_t kFrameSize = 11;          ///< header, type, 8 data bytes, sum
inline constexpr std::size_t kCombinedFrameSize = 20;  ///< of units with BLE: no sum
inline constexpr double kGravity_mps2 = 9.80665;       ///< what the device calls 1 g

enum class FrameType : std::uint8_t {
  clock = 0x50,
  acceleration = 0x51,
  angular_rate = 0x52,
  angles = 0x53,
  magnetic_field = 0x54,
  ports = 0x55,
  pressure = 0x56,
  gps_position = 0x57,
  gps_motion = 0x58,
  quaternion = 0x59,
  gps_accuracy = 0x5A,
  registers = 0x5F,           ///< answer to a read
  combined = 0x61,            ///< 20 bytes: acceleration, rate and angles
  combined_registers = 0x71,  ///< 20 bytes: answer to a read
};

/// Types of 11-byte frames.
bool is_standard_type(std::uint8_t type);
/// Types of 20-byte frames.
bool is_combined_type(std::uint8_t type);
/// Low byte of the sum of everything before the last byte. (The maker's text prints wrong
/// constants for some frames: the real bytes count.)
std::uint8_t checksum(std::span<const std::uint8_t> before);

using Words = std::array<std::int16_t, 3>;

struct Clock {
  int year = 0;
  int month = 0;  ///< 1-based, as the day
  int day = 0;
  int hour = 0;
  int minute = 0;
  int second = 0;
  int millisecond = 0;
};
/// In the sensor's axes, as all below. Specific force: +1 g on the axis that points up.
struct Acceleration {
  Vector3 mps2;
  Words raw{};
  double temperature_degC = kAbsent;
};
/// The fourth word is a temperature or a voltage, by model: not read.
struct AngularRate {
  Vector3 radps;
  Words raw{};
};
/// Order Z, Y, X; yaw counter-clockwise about z up.
struct Angles {
  double roll_rad = 0;
  double pitch_rad = 0;
  double yaw_rad = 0;
  Words raw{};
  std::uint16_t version = 0;
};
/// In counts of the chip, whose unit differs by model.
struct MagneticField {
  Words raw{};
  double temperature_degC = kAbsent;
};
struct Ports {
  std::array<std::uint16_t, 4> raw{};
};
struct Pressure {
  double pressure_Pa = 0;
  double height_m = 0;
};
struct GpsPosition {
  double longitude_deg = 0;
  double latitude_deg = 0;
};
struct GpsMotion {
  double height_m = 0;
  std::int16_t yaw_raw = 0;  ///< 0.01 or 0.1 degrees, by model
  double speed_mps = 0;
};
struct Attitude {
  Quaternion orientation;  ///< as sent: w first, not normalised
  std::array<std::int16_t, 4> raw{};
};
struct GpsAccuracy {
  int satellites = 0;
  double pdop = 0;
  double hdop = 0;
  double vdop = 0;
};
struct Registers {
  std::array<std::uint16_t, 4> value{};  ///< of the address that was asked for, and the next three
};
/// The 20-byte frame of units with BLE.
struct Combined {
  Acceleration acceleration;  ///< without a temperature
  AngularRate rate;
  Angles angles;  ///< without a version
};

using Report =
    std::variant<Clock, Acceleration, AngularRate, Angles, MagneticField, Ports, Pressure,
                 GpsPosition, GpsMotion, Attitude, GpsAccuracy, Registers, Combined>;

/// A whole frame as the framer found it; nothing for a wrong length, header, type or sum, and for a
/// 20-byte answer to a read.
std::optional<Report> decode(std::span<const std::uint8_t> frame);

/// The word is at the end of its range: the truth is larger.
bool is_saturated(const Words& words);

enum class Register : std::uint8_t {
  save = 0x00,
  content = 0x02,
  rate = 0x03,
  baud = 0x04,
  bandwidth = 0x1F,
  algorithm = 0x24,
  read = 0x27,
  unlock = 0x69,
};
inline constexpr std::uint16_t kUnlock = 0xB588;
inline constexpr std::uint16_t kSave = 0;

/// Bits of Register::content.
enum Content : std::uint16_t {
  kClock = 1U << 0U,
  kAcceleration = 1U << 1U,
  kAngularRate = 1U << 2U,
  kAngles = 1U << 3U,
  kMagneticField = 1U << 4U,
  kQuaternion = 1U << 9U,
};

enum class Algorithm : std::uint16_t { nine_axis = 0, six_axis = 1 };

using Command = std::array<std::uint8_t, 5>;
Command write_register(Register address, std::uint16_t value);
/// Asks for four registers; they come as a frame of type 5F.
Command read_registers(Register first);

/// Codes of the registers; nothing for a value that they cannot say.
std::optional<std::uint16_t> rate_code(double rate_Hz);
std::optional<double> rate_Hz(std::uint16_t code);
std::optional<std::uint16_t> baud_code(std::uint32_t baud);
std::optional<std::uint32_t> baud_of(std::uint16_t code);
/// Of the smallest bandwidth that is not below this one, or of the largest.
std::uint16_t bandwidth_code(double bandwidth_Hz);

}  // namespace drover::witmotion
