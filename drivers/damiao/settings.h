// The options of a DAMIAO motor, checked once at start-up.
#pragma once

#include <span>

#include "drivers/damiao/codec.h"
#include "drivers/mit/joint.h"
#include "drover/options.h"
#include "drover/time.h"

namespace drover::damiao {

struct Settings {
  std::uint8_t id = 1;
  std::uint32_t master_id = 0x11;  ///< its answers come under it
  Ranges ranges;
  double sign = 1;                 ///< -1: the motor turns against the joint
  double zero_rad = 0;             ///< what the motor says where the joint is 0
  std::uint32_t timeout_ms = 100;  ///< 0: the motor has none
  double damping_Nmsprad = 1;      ///< of a stop
  double max_effort_Nm = 0;
  Duration stale_after{};
  Duration setpoint_period{};
  Duration settle{};  ///< from when it is heard to when it may be enabled
  Duration arming_timeout{};

  std::uint32_t timeout_raw() const { return timeout_ms * kTimeoutUnitsPerMs; }
  mit::Joint joint() const { return {id, ranges, sign, zero_rad, damping_Nmsprad, max_effort_Nm}; }
};

/// Throws std::runtime_error naming the option.
Settings read_settings(const Options& options);
std::span<const OptionSpec> option_table();

}  // namespace drover::damiao
