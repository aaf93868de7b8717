// What drivers report: one typed value with the instant at which it was true. Its words stay in the
// device (Device::words).
#pragma once

#include <cstdint>
#include <limits>
#include <variant>

#include "drover/time.h"
#include "drover/twist.h"

namespace drover {

inline constexpr double kAbsent = std::numeric_limits<double>::quiet_NaN();
inline constexpr std::size_t kMaxAxes = 64;

/// Index of a driven axis (joint), in the order of the configuration's `drives`.
using AxisId = std::uint8_t;
/// The device of a base that takes a twist: it moves no joint, and so has none of their numbers.
inline constexpr AxisId kBaseAxis = 255;

/// Motion of one axis at the joint, after gear ratio and sign (positive: the base drives forward).
struct AxisMotion {
  AxisId axis = 0;
  double position_rad = kAbsent;
  double velocity_radps = kAbsent;
  double effort_Nm = kAbsent;
};

enum class AxisState : std::uint8_t {
  unknown,  ///< nothing heard yet
  idle,     ///< power stage off: the axis may coast
  arming,   ///< on its way to `running`
  running,  ///< closed loop: obeys set points, holds at zero
  fault,    ///< the drive reports an error; its device says in words which
};

struct AxisStatus {
  AxisId axis = 0;
  AxisState state = AxisState::unknown;
  /// As the drive sent it, or its driver found. Motors of one device that stop for one of them have
  /// its fault, and none of this.
  std::uint64_t error_code = 0;
  /// A fault that says only that nobody fed the drive, or that its supply dipped: it is sound.
  bool lapsed = false;
  /// Of a fault: the power stage is still on. The motor drives or brakes, and gives energy back.
  bool powered = false;
  /// Of a fault: a person stopped the base at the base, by its own emergency stop or bumper. That
  /// is meant for all of the robot.
  bool stops_all = false;
};

struct AxisTemperature {
  AxisId axis = 0;
  double inverter_degC = kAbsent;
  double motor_degC = kAbsent;
};

struct AxisSupply {
  AxisId axis = 0;
  double bus_V = kAbsent;
  double bus_A = kAbsent;
};

/// Numbers as in NMEA 0183 GGA field 6.
enum class FixQuality : std::uint8_t {
  none = 0,
  single = 1,
  dgps = 2,
  pps = 3,
  rtk_fixed = 4,
  rtk_float = 5,
  estimated = 6,
  manual = 7,
  simulator = 8,
};

/// Position of the antenna. Degrees are kept as the receiver sent them (no wrapping).
struct GnssPosition {
  double latitude_deg = kAbsent;
  double longitude_deg = kAbsent;
  double altitude_msl_m = kAbsent;
  double undulation_m = kAbsent;
  FixQuality quality = FixQuality::none;
  int satellites = 0;
  double hdop = kAbsent;
  double correction_age_s = kAbsent;
  double sigma_east_m = kAbsent;  ///< of this epoch's GST, absent when there is none
  double sigma_north_m = kAbsent;
  double sigma_up_m = kAbsent;
};

struct GnssVelocity {
  double speed_mps = kAbsent;
  double course_deg = kAbsent;  ///< clockwise from true north; absent at low speed
};

/// Direction of the antenna baseline, degrees clockwise from true north, [0, 360).
struct GnssHeading {
  double heading_deg = kAbsent;
};

enum class Line : std::uint8_t { estop, bumper, zone_far, zone_near };
inline constexpr std::size_t kLineCount = 4;

/// Digital outputs of the gateway; the hardware watchdog's line is the guard's.
enum class Output : std::uint8_t { enable_relay, lamp, buzzer };
inline constexpr std::size_t kOutputCount = 3;

/// Debounced meaning of a digital input: `active` is "stop", "touched" or "somebody is in the
/// zone".
struct LineState {
  Line line = Line::estop;
  bool active = true;
};

struct Vector3 {
  double x = 0;
  double y = 0;
  double z = 0;
};
/// Rotation from the named frame to its parent; unit length.
struct Quaternion {
  double w = 1;
  double x = 0;
  double y = 0;
  double z = 0;
};

/// One sample of an inertial sensor in the axes of base_link (REP 103: x ahead, y left, z up),
/// after the mounting rotation. As measured: biases are not removed.
struct ImuSample {
  Vector3 acceleration_mps2;       ///< specific force: z is +9.81 at rest on level ground
  Vector3 angular_velocity_radps;  ///< right-handed: z positive turning left
  bool has_orientation = false;
  /// Of base_link; roll and pitch from gravity, yaw from an arbitrary start unless the driver was
  /// told to trust the magnetometer.
  Quaternion orientation;
  bool has_magnetic_field = false;
  Vector3 magnetic_field;  ///< in the device's own unit: a direction only
  double temperature_degC = kAbsent;
  bool saturated = false;  ///< a channel is at the end of its range: the truth is larger
};

enum class BatteryFlow : std::uint8_t { unknown, idle, charging, discharging };
enum class BatteryAlarm : std::uint8_t {
  none,
  warning,   ///< the pack complains, and goes on
  critical,  ///< the pack will switch off, or has
};

/// What a battery's management system says. Absent numbers were not told.
struct BatterySample {
  double voltage_V = kAbsent;
  double current_A = kAbsent;  ///< into the pack positive
  double soc_percent = kAbsent;
  double remaining_Ah = kAbsent;
  double temperature_degC = kAbsent;  ///< hottest cell probe
  double mosfet_degC = kAbsent;       ///< of the switch
  double min_cell_V = kAbsent;
  double max_cell_V = kAbsent;
  BatteryFlow flow = BatteryFlow::unknown;
  bool charger_connected = false;
  bool charges = false;  ///< as a charger does, for however short a time: braking does, too
  BatteryAlarm alarm = BatteryAlarm::none;
  std::uint64_t alarm_bits = 0;  ///< as the map numbers them; 0: none
};

struct Measurement {
  Time time = kNever;      ///< when it was true
  Time received = kNever;  ///< when the bytes came in
  std::variant<std::monostate, AxisMotion, AxisStatus, AxisTemperature, AxisSupply, GnssPosition,
               GnssVelocity, GnssHeading, LineState, ImuSample, BatterySample, BodyMotion>
      value;
  /// Which receiver, inertial sensor or battery says so: its number among its kind, in the order of
  /// the configuration. The gateway's to set.
  std::uint8_t source = 0;
};
// One is made and read for each frame, most of them a few numbers. A text among its values would
// double what each of them takes of the cache.
static_assert(sizeof(Measurement) <= 32 + sizeof(ImuSample), "texts stay in the device");

/// Whether there may be words for it.
inline bool has_words(const Measurement& measurement) {
  return std::holds_alternative<AxisStatus>(measurement.value) ||
         std::holds_alternative<BatterySample>(measurement.value);
}

}  // namespace drover
