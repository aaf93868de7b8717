// The options of a CubeMars motor in MIT mode, checked once at start-up.
#pragma once

#include <span>

#include "drivers/cubemars_mit/codec.h"
#include "drivers/mit/settings.h"

namespace drover::cubemars_mit {

/// The time-out is the one that was set in the motor, as its owner states it.
struct Settings : mit::Settings {
  /// Its master id is that of its commands.
  bool answers_under_its_own() const { return master_id == joint.id; }
  /// Left alone for longer it may have let go of what it was told.
  Duration unfed_after() const;
};

/// Throws std::runtime_error naming the option.
Settings read_settings(const Options& options);
std::span<const OptionSpec> option_table();

}  // namespace drover::cubemars_mit
