// The simulated robot without its wires: plant, drives, receiver and contacts, stepped by the tick.
#pragma once

#include <GeographicLib/LocalCartesian.hpp>

#include <array>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "drover/twin.h"
#include "sim/plant/plant.h"
#include "sim/robot/can_imu.h"
#include "sim/robot/drives.h"
#include "sim/robot/more_devices.h"
#include "sim/robot/object_record.h"
#include "sim/robot/scanner.h"
#include "sim/robot/scenario.h"

namespace drover::sim {

inline constexpr Duration kTick = std::chrono::milliseconds(5);

struct Twins {
  std::vector<AnyDriveTwin> drives;       ///< in the scenario's order
  std::unique_ptr<GnssTwin> gnss;         ///< nullptr: none
  std::unique_ptr<ImuTwin> imu;           ///< nullptr: none
  std::unique_ptr<CanImuTwin> can_imu;    ///< in place of `imu`; nullptr: none
  std::unique_ptr<RegisterTwin> battery;  ///< nullptr: none
  std::unique_ptr<ScannerTwin> lidar;     ///< nullptr: none
  std::uint64_t seed = 1;                 ///< of the further devices, which the robot makes
};
/// From the registry. Throws std::runtime_error naming the device and its option.
Twins make_twins(const Scenario& scenario, std::uint64_t seed);

/// The ground gives way under the wheels for a time.
struct Slip {
  Time begin = kNever;
  double share = 0;
  double lasts_s = 0;
  bool left = true;
  bool right = true;

  double level(Time now) const;
  bool over(Time now) const;
};

/// No descriptors, no clock: equal calls give equal frames, bytes and levels, to the bit.
class Robot {
 public:
  /// Throws std::runtime_error (world, joints). `twins` belong to the scenario's drives and
  /// receiver.
  Robot(const Scenario& scenario, Twins twins);

  /// A frame on a bus (index into the scenario's), heard by all that hangs on it.
  void on_frame(std::size_t bus, const CanFrame& frame, Time now);
  /// What was written to a drive's serial line (index into the scenario's drives).
  void on_drive_bytes(std::size_t drive, std::span<const std::uint8_t> bytes, Time now);
  /// The gateway's output enable_relay, as its wire shows it: it counts from the next step on where
  /// it feeds the drives.
  void set_relay(bool closed) { relay_closed_ = closed; }
  /// One tick: contacts and outputs as of `now`, then the mechanics from `now` to the next tick.
  void step(Time now);

  /// What the devices on a bus send at this tick. Cleared by the next step.
  const std::vector<CanFrame>& frames(std::size_t bus) const { return drives_.frames(bus); }
  /// What a drive on a serial line said at this tick, not yet paced.
  std::string_view drive_bytes(std::size_t drive) const { return drives_.bytes(drive); }
  /// What the receiver said at this tick, not yet paced.
  std::string_view gnss_bytes() const { return {gnss_bytes_.data(), gnss_size_}; }
  /// The same of the inertial sensor, at its own speed; and what was written to it.
  std::string_view imu_bytes() const { return {imu_bytes_.data(), imu_size_}; }
  int imu_baud() const { return imu_ ? static_cast<int>(imu_->baud()) : 0; }
  void on_imu_bytes(std::span<const std::uint8_t> bytes, Time now);
  /// The battery's registers; nullptr: none.
  const RegisterTwin* battery_registers() const { return battery_twin_.get(); }
  /// What the scanner said at this tick, not yet paced.
  std::string_view lidar_bytes() const { return lidar_ ? lidar_->bytes() : std::string_view(); }
  /// Further devices, in the scenario's order.
  MoreDevices& more() { return more_; }
  /// Electrical level.
  bool line_high(LineName line) const;

  struct Truth {
    Time time = kNever;
    BasePose pose;
    BaseVelocity velocity;
    std::vector<Shaft> wheels;  ///< in the order of `drives` and their joints
    std::vector<Shaft> arm;     ///< the same of what is no wheel
    double free_ahead_m = 0;
    bool supply = true;  ///< of the drives: relay, e-stop and dips; not the drives' own switches
    ImuTruth imu;        ///< at the inertial sensor's place; base_link where there is none
  };
  /// As of the last step's `now`.
  const Truth& truth() const { return truth_; }
  const Scenario& scenario() const { return scenario_; }
  /// Names for `Truth::arm`.
  std::vector<std::string> arm_joints() const { return drives_.arm_joints(); }
  /// What stands in its way and what it touches, since the last call: see object_record.h.
  std::string take_object_lines() { return object_record_.take(); }
  bool has_objects() const { return plant_.object_slots() > 0; }

  /// One line of text, see command.h. Returns "ok", "error: ...", or the answer.
  std::string command(std::string_view text);

 private:
  struct Carry {
    Time begin = kNever;
    double lasts_s = 0;
    double ahead_m = 0;
    double left_m = 0;
    double turn_rad = 0;
  };
  /// What a scenario forces a contact to; nothing: the mechanics decide.
  using Override = std::optional<bool>;

  void sense(Time now);
  void sense_motion();
  void tell_gnss(Time now);
  bool supplied() const;
  void supply_drives();
  void move_from_outside(Time now);
  std::string command_supply(std::string_view verb, std::string_view seconds);
  std::string command_push(std::span<const std::string_view> numbers);
  std::string command_push_tip(std::span<const std::string_view> numbers);
  std::string command_carry(std::span<const std::string_view> numbers);
  std::string command_shove(std::span<const std::string_view> words);
  std::string command_slip(std::span<const std::string_view> words);
  std::string command_sideslip(std::span<const std::string_view> words);
  std::string command_slope(std::string_view word);
  void make_slip(Time now);
  std::string command_gnss(std::string_view state);
  std::string command_imu(std::string_view state);
  std::string command_lidar(std::string_view state);
  std::string command_obstacle(std::string_view name, std::string_view x, std::string_view y);
  void use_battery();
  double battery_power_W() const;
  std::string command_battery(std::string_view what, std::string_view value);
  std::string truth_text() const;
  std::string arm_text() const;
  bool active(LineName line) const;

  Scenario scenario_;
  Plant plant_;
  GeographicLib::LocalCartesian earth_;
  Drives drives_;
  std::unique_ptr<GnssTwin> gnss_;
  std::unique_ptr<ImuTwin> imu_;
  std::optional<CanImu> can_imu_;
  std::unique_ptr<RegisterTwin> battery_twin_;
  std::optional<Battery> battery_;
  std::optional<Scanner> lidar_;
  MoreDevices more_;
  Time next_battery_ = kNever;
  std::array<char, 8192> gnss_bytes_{};
  std::size_t gnss_size_ = 0;
  std::array<char, 1024> imu_bytes_{};
  std::size_t imu_size_ = 0;
  std::optional<Plant::Vector> sensor_velocity_mps_;  // a tick ago
  std::array<bool, kLineNames> sensed_{};
  std::array<Override, kLineNames> forced_{};
  Truth truth_;
  ObjectRecord object_record_;
  bool relay_closed_ = false;
  Time dip_until_ = kNever;
  Time push_until_ = kNever;
  Time push_tip_until_ = kNever;
  std::optional<Carry> carry_;
  std::optional<Slip> slip_;
  Time now_{};
  int steps_per_tick_ = 0;
};

}  // namespace drover::sim
