// A driver's options from texts of the command line, checked against its table.
#pragma once

#include <span>
#include <stdexcept>
#include <string>
#include <vector>

#include "drover/options.h"

namespace drover::cli {

/// The command line cannot be meant like that: exit code 2.
struct WrongUsage : std::runtime_error {
  using std::runtime_error::runtime_error;
};

/// `texts` are "name=value". Throws WrongUsage naming the option.
Options options_from(std::span<const OptionSpec> specs, const std::vector<std::string>& texts);

}  // namespace drover::cli
