// The options of an ODrive axis, checked once at start-up.
#pragma once

#include <span>

#include "drivers/odrive/codec.h"
#include "drover/options.h"
#include "drover/time.h"

namespace drover::odrive {

struct Settings {
  std::uint8_t node = 0;
  Firmware firmware = Firmware::v0_6;
  double gear_ratio = 1;                ///< motor turns per joint turn
  double sign = 1;                      ///< -1: the motor turns against the joint
  double torque_constant_Nm_per_A = 0;  ///< of the motor; 0: unknown
  double velocity_limit_turnps = 0;     ///< of the motor
  double watchdog_timeout_s = 0;        ///< 0: the drive has none
  std::uint16_t watchdog_enable_endpoint = 0;
  std::uint16_t watchdog_timeout_endpoint = 0;
  Duration stale_after{};
  Duration heartbeat_timeout{};
  Duration setpoint_period{};
  Duration poll_period{};  ///< of each polled value; zero: none but errors after a fault
  Duration arming_timeout{};

  /// Whether the driver itself writes and reads back the watchdog at each arming.
  bool sets_watchdog() const {
    return firmware == Firmware::v0_6 && watchdog_timeout_s > 0 && watchdog_enable_endpoint != 0 &&
           watchdog_timeout_endpoint != 0;
  }
};

/// Throws std::runtime_error naming the option.
Settings read_settings(const Options& options);
std::span<const OptionSpec> option_table();

}  // namespace drover::odrive
