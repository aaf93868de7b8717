// The chassis on its serial line: packets to its speed and state, a twist to packets.
#pragma once

#include "drivers/gt01/host.h"
#include "drivers/gt01/serial/framer.h"

namespace drover::gt01::serial {

std::span<const OptionSpec> option_table();

class Gt01SerialDriver final : public Device, public ByteFace, public Actuator {
 public:
  Gt01SerialDriver(const Settings& settings, AxisId axis);

  void on_link_up(Time now) override;
  void on_tick(Time now, DriverOut& out) override;
  SourceHealth health(Time now) const override { return host_.health(now); }
  Reason words(const Measurement& reported) const override { return host_.words(reported); }
  void on_bytes(std::span<const std::uint8_t> bytes, Time first_byte, DriverOut& out) override;
  std::span<const Channel> channels() const override { return kChannels; }
  void on_setpoints(std::span<const Setpoint> wanted, Time now, DriverOut& out) override;
  std::span<const FrameRule> rules() const override { return {}; }
  Effect effect(const Message& message, Time now) const override;
  Twist setpoint_twist(const Message& message, std::size_t channel) const override;
  std::size_t messages_per_cycle() const override { return 1; }
  StopRecipe stop_recipe() const override;
  SilenceBehaviour silence() const override { return silence_of(settings_, silence_text_.view()); }

 private:
  std::optional<Twist> asked(const Message& message) const;
  void on_upload(const Upload& upload, Time received, DriverOut& out);

  Settings settings_;
  Host host_;
  Framer framer_;
  Reason silence_text_;
  std::uint16_t sequence_ = 0;
};

}  // namespace drover::gt01::serial
