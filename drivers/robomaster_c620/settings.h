// What a set of RoboMaster motors is told at start-up.
#pragma once

#include <array>
#include <cstdint>
#include <numbers>
#include <span>

#include "drivers/robomaster_c620/codec.h"
#include "drover/options.h"
#include "drover/time.h"

namespace drover::robomaster {

inline constexpr double kTurn_rad = 2 * std::numbers::pi;
inline constexpr double kRadpsPerRpm = kTurn_rad / 60;

/// Speeds, torques and gains are at the joint, behind the gear.
struct Settings {
  int first_motor = 1;  ///< 1 or 5
  std::array<double, kMotors> sign{1, 1, 1, 1};
  double gear_ratio = 1;
  double counts_per_A = 1;
  double most_counts = 0;  ///< that the controller takes
  double Nm_per_A = 0;
  double limit_Nm = 0;
  double max_radps = 0;
  double velocity_gain_Nms_per_rad = 0;
  double integrator_gain_Nm_per_rad = 0;
  double friction_Nm = 0;
  double ramp_radps2 = 0;
  double hot_degC = 0;
  double too_hot_degC = 0;
  Duration blind_after{};
  Duration stale_after{};
  Duration silent_after{};

  std::uint32_t command_id() const { return first_motor == 1 ? kCommandFirst : kCommandSecond; }
  int motor(std::size_t channel) const { return first_motor + static_cast<int>(channel); }
  std::uint32_t feedback_id(std::size_t channel) const {
    return kFeedback + static_cast<std::uint32_t>(motor(channel));
  }
};

std::span<const OptionSpec> option_table();
/// Throws std::runtime_error naming the option.
Settings read_settings(const Options& options);

}  // namespace drover::robomaster
