// The options of a DAMIAO motor, checked once at start-up.
#pragma once

#include <span>

#include "drivers/damiao/codec.h"
#include "drivers/mit/settings.h"

namespace drover::damiao {

struct Settings : mit::Settings {
  Duration arming_timeout{};

  std::uint32_t timeout_raw() const { return timeout_ms * kTimeoutUnitsPerMs; }
};

/// Throws std::runtime_error naming the option.
Settings read_settings(const Options& options);
std::span<const OptionSpec> option_table();

}  // namespace drover::damiao
