// What the driver of either wire is told at start-up.
#pragma once

#include <array>
#include <span>

#include "drover/options.h"
#include "drover/time.h"

namespace drover::gt01 {

struct Settings {
  Duration silence{};  ///< after it the chassis stops by itself; 0: it does not
  bool zero_holds = false;
  double speed_scale = 1;  ///< true over told, of v
  double turn_scale = 1;   ///< true over told, of w
  double max_speed_mps = 1;
  double max_turn_radps = 1.5;
  Duration command_period{};
  Duration stale_after{};
  Duration gone_after{};
  Duration obeys_within{};
};

/// The options of both wires; how long a chassis goes on in silence differs.
using CommonOptions = std::array<OptionSpec, 10>;
CommonOptions common_options(double silence_s);
/// Throws std::runtime_error naming the option.
Settings read_settings(const Options& options, std::span<const OptionSpec> specs);

}  // namespace drover::gt01
