// What a drive of CiA 402 is told at start-up.
#pragma once

#include <cstdint>
#include <span>

#include "drivers/canopen/setup.h"
#include "drover/options.h"
#include "drover/time.h"

namespace drover::cia402 {

struct Settings {
  std::uint8_t node = 1;
  std::uint8_t gateway_node = 127;
  std::uint8_t mode = 3;          ///< of 6060
  double units_per_rps = 600;     ///< of 60FF and 606C, for one turn of the motor a second
  double counts_per_turn = 4096;  ///< of 6064, for one turn of the motor
  double gear_ratio = 1;
  double sign = 1;                 ///< of the motor against the joint
  double max_rpm = 3000;           ///< of the motor
  double rated_torque_Nm = 0;      ///< of the motor; 0: 6077 is not mapped
  std::uint32_t acceleration = 0;  ///< 6083; 0: left alone, as those below
  std::uint32_t deceleration = 0;
  std::uint32_t quick_deceleration = 0;
  std::uint16_t quick_stop_option = 6;
  std::uint16_t silence_ms = 200;
  std::uint16_t heartbeat_ms = 100;
  bool has_consumer = true;      ///< 1016
  bool has_abort_option = true;  ///< 6007
  Duration stale_after{};
  Duration heartbeat_timeout{};
  Duration setpoint_period{};
  Duration arming_timeout{};

  bool torque() const { return rated_torque_Nm > 0; }
  /// The drive watches the gateway's heartbeat.
  bool watches() const { return has_consumer && silence_ms > 0; }
  /// And is told to stop when it ceases.
  bool stops_by_itself() const { return watches() && has_abort_option; }
};

std::span<const OptionSpec> option_table();
/// Throws std::runtime_error naming the option.
Settings read_settings(const Options& options);

using StepList = FixedVector<canopen::SdoStep, 64>;

/// What is written each time it starts, or is found started. A target of zero first: one that a
/// dead gateway left is still in the drive.
StepList steps_of(const Settings& settings);

}  // namespace drover::cia402
