// A simulated ODrive axis: the other end of the driver's frames and a motor on a shaft.
//
// It boots idle and in position mode, refuses closed loop while an error stands, lets go of the
// shaft when its watchdog expires, and speaks either firmware's layouts.
#pragma once

#include <optional>

#include "drivers/odrive/settings.h"
#include "drover/twin.h"

namespace drover::odrive {

/// The simulated device's own numbers. Torques, gains and speeds are at the joint.
struct TwinSettings {
  double torque_limit_Nm = 40;
  double velocity_gain_Nms_per_rad = 8;
  double integrator_gain_Nm_per_rad = 60;
  double encoder_counts_per_turn = 16384;  ///< of the motor
  double motor_time_constant_s = 0.002;
  double estimator_time_constant_s = 0.002;
  double phase_resistance_ohm = 0.1;
  double thermal_resistance_KpW = 1.5;
  double thermal_capacity_JpK = 300;
  double ambient_degC = 25;
  double motor_limit_degC = 100;
  bool has_thermistor = true;
  double bus_V = 48;
  Duration boot_time{};
  /// The watchdog in the drive's flash; nullopt: as the driver's options state it.
  std::optional<double> saved_watchdog_s;
};

TwinSettings read_twin_settings(const Options& options);
std::span<const OptionSpec> twin_option_table();

class OdriveTwin final : public CanTwin {
 public:
  OdriveTwin(const Settings& settings, const TwinSettings& twin);

  void on_frame(const CanFrame& frame, Time now, TwinFrames& out) override;
  void on_tick(Time now, std::span<Shaft> shafts, TwinFrames& out) override;
  void set_power(bool on, Time now) override;
  /// Known: "over_temperature" (stays hot until cleared), "stuck_encoder", "wrong_sign" (motor and
  /// encoder mounted the other way round), "silent" (sends nothing, still obeys),
  /// "leaves_closed_loop" (once, without an error, as when a plug comes loose),
  /// "error:<hex>" (those bits of the firmware's error word).
  bool set_fault(std::string_view name, Time now) override;

 private:
  bool v0_6() const { return settings_.firmware == Firmware::v0_6; }
  double motor_sign() const { return wrong_sign_ ? -settings_.sign : settings_.sign; }
  void boot(Time now);
  void feed(Time now) { last_fed_ = now; }
  void disarm(std::uint32_t error);
  void on_data(const CanFrame& frame, Time now, TwinFrames& out);
  void on_sdo(const CanFrame& frame, TwinFrames& out);
  void answer(std::uint8_t command, TwinFrames& out) const;
  void send(const CanFrame& frame, TwinFrames& out) const;
  void send_cyclic(Time now, TwinFrames& out);
  void move(double dt_s, Shaft& shaft);
  void heat(double dt_s, const Shaft& shaft);
  Heartbeat heartbeat() const;

  Settings settings_;
  TwinSettings twin_;

  // Power and protocol.
  bool powered_ = true;
  bool booted_ = false;
  Time boot_at_ = kNever;
  Time next_heartbeat_ = kNever;
  Time next_estimates_ = kNever;
  std::uint8_t state_ = kStateIdle;
  std::uint8_t procedure_result_ = 0;
  std::uint32_t error_ = 0;
  std::uint32_t disarm_reason_ = 0;
  std::uint32_t control_mode_ = 3;  ///< position, as a drive that nobody configured
  std::uint32_t input_mode_ = 1;
  double input_turnps_ = 0;
  bool watchdog_on_ = false;
  double watchdog_s_ = 0;
  Time last_fed_ = kNever;

  // Motor. Position and velocity as the encoder tells, at the joint, in the motor's direction.
  Time last_tick_ = kNever;
  double measured_rad_ = 0;
  double measured_radps_ = 0;
  double power_on_rad_ = 0;  ///< an encoder starts counting at zero
  bool position_known_ = false;
  double integral_Nm_ = 0;
  double torque_Nm_ = 0;
  double motor_degC_ = 25;
  double electrical_W_ = 0;

  // Faults.
  bool over_temperature_ = false;
  bool stuck_ = false;
  bool wrong_sign_ = false;
  bool silent_ = false;
};

}  // namespace drover::odrive
