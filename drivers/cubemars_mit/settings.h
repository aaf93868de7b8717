// The options of a CubeMars motor in MIT mode, checked once at start-up.
#pragma once

#include <span>

#include "drivers/cubemars_mit/codec.h"
#include "drivers/mit/joint.h"
#include "drover/options.h"
#include "drover/time.h"

namespace drover::cubemars_mit {

struct Settings {
  mit::Joint joint;
  std::uint32_t master_id = 1;   ///< its answers come under it; its own: its commands' too
  std::uint32_t timeout_ms = 0;  ///< as it was set in the motor; 0: nobody knows
  Duration stale_after{};
  Duration setpoint_period{};
  Duration settle{};  ///< from when it is heard to when it may be enabled

  bool answers_under_its_own() const { return master_id == joint.id; }
  /// Left alone for longer it may have let go of what it was told.
  Duration unfed_after() const;
};

/// Throws std::runtime_error naming the option.
Settings read_settings(const Options& options);
std::span<const OptionSpec> option_table();

}  // namespace drover::cubemars_mit
