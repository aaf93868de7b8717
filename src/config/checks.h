// Checks that span several keys: names that refer to each other, addresses, limits, whole drivers.
#pragma once

#include "config/fields.h"
#include "config/load.h"
#include "json/located_json.h"

namespace drover::config {

/// Adds what it finds to the problems, and fills in what follows from several keys: wires, numbers
/// of links and axes, the battery's register map, and the engine's copies. `loaded` was read from
/// `root`, which stands in `folder`.
void check_and_resolve(const json::Node& root, const GroupNames& groups, const std::string& folder,
                       Loaded& loaded);

}  // namespace drover::config
