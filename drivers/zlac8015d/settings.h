// What a ZLAC8015D is told at start-up.
#pragma once

#include <array>
#include <cstdint>
#include <span>

#include "drivers/zlac8015d/codec.h"
#include "drover/options.h"
#include "drover/time.h"

namespace drover::zlac8015d {

struct Settings {
  std::uint8_t node = 1;
  std::array<double, kWheels> sign{1, -1};  ///< of the motor against the joint
  double gear_ratio = 1;
  double counts_per_turn = 4096;  ///< of the motor
  double max_rpm = 300;           ///< of the motor
  int steps_per_rpm = 10;         ///< of a target
  std::uint16_t silence_ms = 200;
  bool silence_holds = false;  ///< after that; not written, a drive has no object for it
  std::uint16_t heartbeat_ms = 100;
  std::uint16_t acceleration_ms = 100;
  std::uint16_t deceleration_ms = 100;
  Duration stale_after{};
  Duration heartbeat_timeout{};
  Duration setpoint_period{};
  Duration arming_timeout{};
};

std::span<const OptionSpec> option_table();
/// Throws std::runtime_error naming the option.
Settings read_settings(const Options& options);

}  // namespace drover::zlac8015d
