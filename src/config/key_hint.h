// What a person most likely meant who wrote a key that does not exist.
#pragma once

#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "drover/options.h"

namespace drover::config {

/// For the key at `path`, beside those that are `known` there. `options` are those of the device
/// whose keys these are. Empty: nobody knows.
std::string key_hint(std::string_view path, const std::string& key,
                     const std::vector<std::string>& known, std::span<const OptionSpec> options);

}  // namespace drover::config
