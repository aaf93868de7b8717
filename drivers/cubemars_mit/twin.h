// A simulated CubeMars motor in MIT mode, as the open firmware behaves: the other end of the
// driver's frames, and the law on a shaft.
//
// It boots off, keeps the last MIT frame that it heard though it is off, answers each frame with
// its state before it, and never says whether it is on. When its time-out runs out it forgets what
// it was told, and stays on: it is limp until the next frame, which it follows.
#pragma once

#include "drivers/cubemars_mit/settings.h"
#include "drivers/mit/twin_motor.h"
#include "drover/twin.h"

namespace drover::cubemars_mit {

/// The simulated device's own numbers.
struct TwinSettings : mit::TwinSettings {
  double timeout_ms = 0;  ///< 0: none
  bool mute_while_off = false;
  bool short_answers = false;
};

TwinSettings read_twin_settings(const Options& options, const Settings& settings);
std::span<const OptionSpec> twin_option_table();

class CubemarsTwin final : public CanTwin {
 public:
  CubemarsTwin(const Settings& settings, const TwinSettings& twin);

  void on_frame(const CanFrame& frame, Time now, TwinFrames& out) override;
  void on_tick(Time now, std::span<Shaft> shafts, TwinFrames& out) override;
  void set_power(bool on, Time now) override;
  /// Known: "over_temperature", "over_current", "over_voltage", "under_voltage", "encoder",
  /// "phase_imbalance" (off until cleared), "stuck_encoder", "wrong_sign" (torque and encoder),
  /// "torque_reversed" (the torque alone), "silent" (sends nothing, still obeys),
  /// "leaves_closed_loop" (once; no answer tells it).
  bool set_fault(std::string_view name, Time now) override;

 private:
  void answer(TwinFrames& out) const;

  Settings settings_;
  TwinSettings twin_;

  bool powered_ = true;
  bool booted_ = false;
  Time boot_at_ = kNever;
  Time last_tick_ = kNever;
  Time last_fed_ = kNever;
  bool on_ = false;
  MotorError error_ = MotorError::none;
  mit::MitCommand command_;
  mit::TwinMotor motor_;
  bool silent_ = false;
};

}  // namespace drover::cubemars_mit
