// A simulated ZLAC8015D: a CANopen node with its dictionary, and two motors on their shafts.
//
// It starts pre-operational, off and with the maker's defaults, maps its process data as it is
// told, and refuses objects that it does not have. Its time-out lets go of the wheels: one drive
// was seen to stop and stay enabled, but no maker says so (`silence_holds`). Only targets feed it,
// the least that may be.
#pragma once

#include "drivers/canopen/nmt.h"
#include "drivers/zlac8015d/settings.h"
#include "drover/twin.h"

namespace drover::zlac8015d {

/// The simulated device's own numbers, at the joint. The maker tells none of them: they are of the
/// size that hub motors of 6.5 to 10 inches need.
struct TwinSettings {
  double torque_limit_Nm = 30;
  double velocity_gain_Nms_per_rad = 8;
  double integrator_gain_Nm_per_rad = 60;
  Duration boot_time{};
};

/// In the ids of objects 1400 and 1800: the PDO is off (CiA 301).
inline constexpr std::uint32_t kInvalidPdo = 0x80000000;

TwinSettings read_twin_settings(const Options& options);
std::span<const OptionSpec> twin_option_table();

class Zlac8015dTwin final : public CanTwin {
 public:
  Zlac8015dTwin(const Settings& settings, const TwinSettings& twin);

  void on_frame(const CanFrame& frame, Time now, TwinFrames& out) override;
  void on_tick(Time now, std::span<Shaft> shafts, TwinFrames& out) override;
  void set_power(bool on, Time now) override;
  /// Known: "over_temperature" (of the left motor), "over_current" (of the right one), "silent"
  /// (sends nothing, still obeys), "leaves_enabled" (the right wheel alone, once, without an
  /// error), "error:<hex>" (object 603F: the low half is the left wheel's). The other wheel goes
  /// on.
  bool set_fault(std::string_view name, Time now) override;

 private:
  struct Entry {
    canopen::Object object;
    canopen::SdoNumber value;
  };
  struct Wheel {
    canopen::DriveState drive = canopen::DriveState::switch_on_disabled;
    std::uint16_t error = 0;  ///< bits of 603F
    std::int32_t target = 0;  ///< as it was sent
    double ramped_rpm = 0;
    double measured_radps = 0;  ///< of the joint, as the motor turns
    double position_rad = 0;
    double power_on_rad = 0;
    double integral_Nm = 0;
    bool torn = false;  ///< a line of its motor: no torque, and the drive says nothing of it
  };
  void boot(Time now, TwinFrames& out);
  void on_nmt(std::uint8_t command);
  void on_sdo(const CanFrame& frame, Time now, TwinFrames& out);
  void on_pdo(std::uint16_t number, const CanFrame& frame, Time now);
  void send_pdo(std::uint16_t number, TwinFrames& out) const;
  void send(const CanFrame& frame, TwinFrames& out) const;
  void write(canopen::Object object, std::uint32_t bits, Time now);
  std::uint32_t read(canopen::Object object) const;
  const Entry* find(canopen::Object object) const;
  std::uint32_t stored(std::uint16_t index, std::uint8_t sub) const;
  std::uint8_t mapped_count(std::uint16_t mapping) const;
  void on_controlword(std::uint16_t word);
  void time_out();
  void fail(std::size_t wheel, std::uint16_t error);
  void send_cyclic(Time now, TwinFrames& out);
  void move(double dt_s, std::span<Shaft> shafts);
  double torque_of(std::size_t wheel, double dt_s);

  Settings settings_;
  TwinSettings twin_;
  bool powered_ = true;
  bool booted_ = false;
  bool silent_ = false;
  Time boot_at_ = kNever;
  Time last_tick_ = kNever;
  Time next_heartbeat_ = kNever;
  std::array<Time, 4> next_pdo_{};
  Time last_fed_ = kNever;
  canopen::NodeState state_ = canopen::NodeState::boot_up;
  std::uint16_t controlword_ = 0;
  FixedVector<Entry, 96> dictionary_;
  std::array<Wheel, kWheels> wheels_;
};

}  // namespace drover::zlac8015d
