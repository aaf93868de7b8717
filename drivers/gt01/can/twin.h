// The simulated chassis on CAN: its reports, from power-up on.
#pragma once

#include "drivers/gt01/can/codec.h"
#include "drivers/gt01/chassis_twin.h"

namespace drover::gt01::can {

class Gt01CanTwin final : public CanTwin {
 public:
  Gt01CanTwin(const Settings& settings, TwistLayout layout, const ChassisSettings& chassis)
      : layout_(layout), chassis_(settings, chassis) {}

  void on_frame(const CanFrame& frame, Time now, TwinFrames& out) override;
  void on_tick(Time now, std::span<Shaft> shafts, TwinFrames& out) override;
  void set_power(bool on, Time now) override { chassis_.set_power(on, now); }
  bool set_fault(std::string_view name, Time) override { return chassis_.set_fault(name); }

 private:
  CanFrame state() const;
  void tell(std::uint32_t id, std::int16_t first, std::int16_t second, TwinFrames& out) const;

  TwistLayout layout_;
  ChassisModel chassis_;
  Time next_speeds_ = kNever;  ///< 50 times a second
  Time next_state_ = kNever;   ///< 100 times a second
};

}  // namespace drover::gt01::can
