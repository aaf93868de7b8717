// A simulated DAMIAO motor: the other end of the driver's frames, and the law of MIT mode on a
// shaft.
//
// It boots off, keeps the last MIT frame that it heard though it is off, lets go when its time-out
// runs out, and then wants its error cleared before it can be enabled.
#pragma once

#include "drivers/damiao/settings.h"
#include "drivers/mit/twin_motor.h"
#include "drover/twin.h"

namespace drover::damiao {

/// The simulated device's own numbers.
struct TwinSettings : mit::TwinSettings {
  std::uint32_t saved_mode = kMitMode;
  std::uint32_t saved_timeout_ms = 0;
};

TwinSettings read_twin_settings(const Options& options, const Settings& settings);
std::span<const OptionSpec> twin_option_table();

class DamiaoTwin final : public CanTwin {
 public:
  DamiaoTwin(const Settings& settings, const TwinSettings& twin);

  void on_frame(const CanFrame& frame, Time now, TwinFrames& out) override;
  void on_tick(Time now, std::span<Shaft> shafts, TwinFrames& out) override;
  void set_power(bool on, Time now) override;
  /// Known: "over_temperature" (stays hot until cleared), "over_current", "over_voltage",
  /// "under_voltage", "overload", "lost_comm" (once each), "stuck_encoder", "wrong_sign" (torque
  /// and encoder), "torque_reversed" (the torque alone), "silent" (sends nothing, still obeys),
  /// "leaves_closed_loop" (once, without an error).
  bool set_fault(std::string_view name, Time now) override;

 private:
  void boot(Time now);
  void fail(MotorStatus status);
  void on_special(Special special, Time now);
  void on_request(const CanFrame& frame, TwinFrames& out);
  void on_register(const CanFrame& frame, TwinFrames& out);
  std::uint32_t read(std::uint8_t rid) const;
  void send_feedback(TwinFrames& out) const;
  void send(const CanFrame& frame, TwinFrames& out) const;

  Settings settings_;
  TwinSettings twin_;

  bool powered_ = true;
  bool booted_ = false;
  Time boot_at_ = kNever;
  Time last_tick_ = kNever;
  Time last_fed_ = kNever;
  MotorStatus status_ = MotorStatus::disabled;
  std::uint32_t mode_ = kMitMode;
  std::uint32_t timeout_raw_ = 0;
  MitCommand command_;

  mit::TwinMotor motor_;
  bool hot_ = false;
  bool silent_ = false;
};

}  // namespace drover::damiao
