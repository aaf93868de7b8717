// What a stop cannot promise: drives that droverd does not hear.
#pragma once

#include <string>

#include "json/located_json.h"

namespace drover::cli {

/// The drives that should be heard and are not, as words ("front_left, the base"); empty: none.
/// Drives without power are silent and drive nothing: with the e-stop pressed or the enable relay
/// open nothing is said. `status` is the object that status_json writes.
std::string unheard_drives(const json::Node& status);

}  // namespace drover::cli
