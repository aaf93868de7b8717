// A simulated Scout: two shafts, left and right, each what the wheels of its side turn together.
#pragma once

#include <array>

#include "drivers/agilex_v2/codec.h"
#include "drivers/agilex_v2/servo.h"
#include "drivers/checked_options.h"
#include "drover/options.h"
#include "drover/twin.h"

namespace drover::agilex_v2 {

/// Of the driver: the simulated one has them, too.
std::span<const OptionSpec> option_table();
std::span<const OptionSpec> twin_option_table();

class AgilexV2Twin final : public CanTwin {
 public:
  explicit AgilexV2Twin(const Options& options);

  void set_power(bool on, Time now) override;
  /// "silent", "estop", "exception", "remote" (a person takes it over), "serial" (somebody commands
  /// it on its other line), "low_battery".
  bool set_fault(std::string_view name, Time now) override;
  void on_frame(const CanFrame& frame, Time now, TwinFrames& out) override;
  void on_tick(Time now, std::span<Shaft> shafts, TwinFrames& out) override;

 private:
  AgilexV2Twin(const CheckedOptions& own, const CheckedOptions& of_driver);
  bool awake(Time now) const;
  Twist obeyed(Time now) const;
  void turn(std::span<Shaft> shafts, const Twist& twist, double dt_s);
  void tell(std::span<const Shaft> shafts, Time now, TwinFrames& out);

  double wheel_radius_m_;
  double track_m_;
  double max_torque_Nm_;
  bool zero_holds_;

  bool powered_ = true;
  bool silent_ = false;
  Time booted_ = kNever;
  Time last_tick_ = kNever;
  SystemState state_;
  Twist asked_;
  Time last_asked_ = kNever;
  std::array<Servo, 2> servos_;
  Time next_state_ = kNever;
  Time next_motion_ = kNever;
  std::uint8_t count_ = 0;
};

}  // namespace drover::agilex_v2
