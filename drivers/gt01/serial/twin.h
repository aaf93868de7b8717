// The simulated chassis on its serial line: uploads 50 times a second, from power-up on.
#pragma once

#include "drivers/gt01/chassis_twin.h"
#include "drivers/gt01/serial/framer.h"

namespace drover::gt01::serial {

class Gt01SerialTwin final : public ByteDriveTwin {
 public:
  Gt01SerialTwin(const Settings& settings, const ChassisSettings& chassis)
      : chassis_(settings, chassis) {}

  void on_bytes(std::span<const std::uint8_t> bytes, Time now) override;
  std::size_t on_tick(Time now, std::span<Shaft> shafts, std::span<char> out) override;
  void set_power(bool on, Time now) override;
  bool set_fault(std::string_view name, Time now) override;

 private:
  void on_packet(std::span<const std::uint8_t> packet, Time now);
  Packet upload();

  ChassisModel chassis_;
  Framer framer_;
  bool uploads_ = true;
  std::uint16_t sequence_ = 0;
  Time next_upload_ = kNever;
};

}  // namespace drover::gt01::serial
