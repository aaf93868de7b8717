// The twin seam: a simulated device that speaks a driver's protocol from the other side.
#pragma once

#include <cstdint>
#include <functional>
#include <span>
#include <string_view>

#include "drover/can_frame.h"
#include "drover/fixed_vector.h"
#include "drover/measurement.h"
#include "drover/time.h"

namespace drover {

/// The mechanical side of a simulated drive, at the joint. The plant fills in position and
/// velocity, the twin answers with a torque and says whether its power stage is on: without it the
/// shaft turns freely, or a holding brake or a worm gear holds it.
struct Shaft {
  double position_rad = 0;
  double velocity_radps = 0;
  double torque_Nm = 0;
  bool energized = false;
};

using TwinFrames = FixedVector<CanFrame, 64>;

/// What every simulated drive has beside its wire.
class DriveTwin {
 public:
  virtual ~DriveTwin() = default;
  /// Supply on or off; off forgets everything that is not in the device's flash.
  virtual void set_power(bool on, Time now) = 0;
  /// Injects a named fault ("over_temperature", "stuck_encoder", "silent", ...) or clears all ("").
  /// Returns false when the twin does not know it.
  virtual bool set_fault(std::string_view name, Time now) = 0;
};

class CanTwin : public DriveTwin {
 public:
  virtual void on_frame(const CanFrame& frame, Time now, TwinFrames& out) = 0;
  /// Advances to `now` (monotonic, called at the plant's step): updates the torques, sends what is
  /// due. `shafts` by the driver's channels, or as its entry's `twin_shafts` says.
  virtual void on_tick(Time now, std::span<Shaft> shafts, TwinFrames& out) = 0;
};

/// The same on a byte stream.
class ByteDriveTwin : public DriveTwin {
 public:
  /// What was written to it, as fast as its line carries it, cut anywhere.
  virtual void on_bytes(std::span<const std::uint8_t> bytes, Time now) = 0;
  /// As CanTwin::on_tick. Writes the bytes that are due into `out`, which the caller paces, and
  /// returns their number.
  virtual std::size_t on_tick(Time now, std::span<Shaft> shafts, std::span<char> out) = 0;
};

/// What a simulated receiver knows of the world.
struct GnssTruth {
  double latitude_deg = 0;  ///< of the antenna
  double longitude_deg = 0;
  double altitude_m = 0;   ///< above the ellipsoid
  double heading_deg = 0;  ///< of the antenna baseline, clockwise from true north
  double speed_mps = 0;
  double course_deg = 0;
  double ahead_deg = 0;  ///< where the robot points: base_link's x, clockwise from true north
};

class GnssTwin {
 public:
  virtual ~GnssTwin() = default;
  /// Call at each plant step; appends the bytes of epochs whose output is due to `out` (a queue
  /// that the caller paces at the line's baud rate). Returns the number appended.
  virtual std::size_t on_tick(Time now, const GnssTruth& truth, std::span<char> out) = 0;
  /// Scenario event: "fix", "float", "dgps", "single", "none" (no position), "silent",
  /// "heading_lost", "jump:<metres east>", ... Returns false when unknown.
  virtual bool set_state(std::string_view name, Time now) = 0;
};

/// What a simulated inertial sensor knows of the world, in the axes of base_link.
struct ImuTruth {
  Vector3 specific_force_mps2;  ///< at the sensor's place
  Vector3 angular_velocity_radps;
  Quaternion orientation;  ///< of base_link in the world (ENU)
};

class ImuTwin {
 public:
  virtual ~ImuTwin() = default;
  /// Call at each plant step; appends the bytes that are due to `out`, which the caller paces.
  virtual std::size_t on_tick(Time now, const ImuTruth& truth, std::span<char> out) = 0;
  /// What the gateway wrote: settings.
  virtual void on_bytes(std::span<const std::uint8_t> bytes, Time now) = 0;
  /// Speed of its line now; bytes at another speed are noise to it and from it.
  virtual std::uint32_t baud() const = 0;
  /// Scenario event: "silent", "frozen", "saturated", "bias:<degrees a second about z>", "restart"
  /// (its supply was away), "" (well). Returns false when unknown.
  virtual bool set_state(std::string_view name, Time now) = 0;
};

/// The same on a CAN bus.
class CanImuTwin {
 public:
  virtual ~CanImuTwin() = default;
  /// Whatever is sent on its bus; what it answers goes into `out`.
  virtual void on_frame(const CanFrame& frame, Time now, TwinFrames& out) = 0;
  /// Call at each tick of the plant; sends what is due.
  virtual void on_tick(Time now, const ImuTruth& truth, TwinFrames& out) = 0;
  /// As ImuTwin's, as far as its README names them.
  virtual bool set_state(std::string_view name, Time now) = 0;
};

/// What a simulated scanner knows of the world: the range to what is in a direction, seen from
/// above, counter-clockwise from the sensor's x (rad), in metres. 0, infinite or not a number:
/// nothing.
using RangeOf = std::function<double(double bearing_rad)>;

class ScannerTwin {
 public:
  virtual ~ScannerTwin() = default;
  /// Call at each plant step; appends the bytes that are due to `out`, which the caller paces.
  /// Beams are measured with the world of this call. Returns the number appended.
  virtual std::size_t on_tick(Time now, const RangeOf& range_of, std::span<char> out) = 0;
  /// Scenario event: "covered" (its lens), "sun" (most beams do not come back), "frozen", "dirty",
  /// "silent", "" (well), and what else its README names. Returns false when unknown.
  virtual bool set_state(std::string_view name, Time now) = 0;
};

/// What a simulated battery knows of itself.
struct BatteryTruth {
  double voltage_V = 0;
  double current_A = 0;  ///< into the pack positive
  double soc_percent = 0;
  double capacity_Ah = 0;
  double temperature_degC = 0;
  bool charger_connected = false;
  std::uint64_t alarm_bits = 0;  ///< as the map numbers them
};

/// The registers of a simulated device; its wire is the simulator's.
class RegisterTwin {
 public:
  virtual ~RegisterTwin() = default;
  virtual void set_truth(const BatteryTruth& truth) = 0;
  /// False: no such registers, answered with exception 2.
  virtual bool read(std::uint8_t function, std::uint16_t address,
                    std::span<std::uint16_t> words) const = 0;
};

}  // namespace drover
