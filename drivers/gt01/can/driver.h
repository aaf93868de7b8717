// The chassis on CAN: frames to its speed and state, a twist to frames.
#pragma once

#include "drivers/gt01/can/codec.h"
#include "drivers/gt01/host.h"

namespace drover::gt01::can {

std::span<const OptionSpec> option_table();
/// Throws std::runtime_error naming the option.
TwistLayout read_layout(const Options& options);

class Gt01CanDriver final : public Device, public FrameFace, public Actuator {
 public:
  Gt01CanDriver(const Settings& settings, TwistLayout layout, AxisId axis);

  void on_link_up(Time now) override;
  void on_tick(Time now, DriverOut& out) override;
  SourceHealth health(Time now) const override { return host_.health(now); }
  Reason words(const Measurement& reported) const override { return host_.words(reported); }
  void on_frame(const CanFrame& frame, Time received, DriverOut& out) override;
  std::span<const FrameFilter> listens() const override;
  std::span<const Channel> channels() const override { return kChannels; }
  void on_setpoints(std::span<const Setpoint> wanted, Time now, DriverOut& out) override;
  std::span<const FrameRule> rules() const override;
  Effect effect(const Message& message, Time now) const override;
  Twist setpoint_twist(const Message& message, std::size_t channel) const override;
  std::size_t messages_per_cycle() const override { return 1; }
  StopRecipe stop_recipe() const override { return recipe_; }
  SilenceBehaviour silence() const override { return silence_of(settings_, silence_text_.view()); }

 private:
  std::optional<Twist> asked(const Message& message) const;
  void tell_condition(Time received, DriverOut& out);

  Settings settings_;
  TwistLayout layout_;
  Host host_;
  StopRecipe recipe_;
  Reason silence_text_;
  std::optional<State> state_;  ///< since the link came up
  Time state_at_ = kNever;
  MotorFaults motor_faults_;
};

}  // namespace drover::gt01::can
