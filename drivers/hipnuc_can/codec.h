// Frames of HiPNUC's inertial sensors on CAN, in both of the dialects that they speak: after
// CANopen (11-bit ids) and after J1939 (29-bit ids). Lowest byte first.
#pragma once

#include <cstdint>
#include <optional>

#include "drover/can_frame.h"
#include "drover/driver.h"
#include "drover/measurement.h"

namespace drover::hipnuc_can {

inline constexpr double kGravity_mps2 = 9.80665;  ///< what the device calls 1 g

enum class Dialect : std::uint8_t { canopen, j1939 };

/// What a frame holds.
enum class Content : std::uint8_t { acceleration, rates, quaternion, temperature };

/// Where a sensor's frames are.
struct Address {
  Dialect dialect = Dialect::j1939;
  std::uint8_t node = 8;
};

/// Frames of this sensor that are read.
FixedVector<FrameFilter, 5> filters_of(const Address& address);
/// Absent: not this sensor's.
std::optional<Content> content_of(const Address& address, const CanFrame& frame);
/// Without what only a controller puts there: priority 3, as the maker's examples.
std::uint32_t id_of(const Address& address, Content content);

struct Triple {
  Vector3 value;
  bool saturated = false;  ///< at the end of the sensor's range, or of the numbers
};

/// m/s^2 in the sensor's axes, which measures up to `range_mps2`. Absent: too short.
std::optional<Triple> read_acceleration(Dialect dialect, const CanFrame& frame, double range_mps2);
/// rad/s, up to `range_radps`. Absent: too short.
std::optional<Triple> read_rates(Dialect dialect, const CanFrame& frame, double range_radps);
/// Of unit length. Absent: too short, or nothing like a rotation.
std::optional<Quaternion> read_quaternion(const CanFrame& frame);
/// Absent: too short.
std::optional<double> read_temperature_degC(const CanFrame& frame);

CanFrame acceleration_frame(const Address& address, const Vector3& acceleration_mps2);
CanFrame rates_frame(const Address& address, const Vector3& rates_radps);
CanFrame quaternion_frame(const Address& address, const Quaternion& orientation);

}  // namespace drover::hipnuc_can
