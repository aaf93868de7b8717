// A device as droverd sees it now: once, or again and again.
#pragma once

#include <string>

#include "cli/show_devices.h"

namespace drover::cli {

struct LiveSettings {
  std::string socket;
  bool json = false;
  bool watch = false;
};

/// Prints and returns the exit code. Throws NoAnswer.
int show_live(const DeviceView& view, const LiveSettings& settings);

}  // namespace drover::cli
