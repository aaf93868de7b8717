// Several receivers, inertial sensors or batteries: a line for each.
#pragma once

#include <string>
#include <string_view>

#include "json/located_json.h"

namespace drover::cli {

/// Of one kind ("gnss", "imu", "battery"); empty where there is only one, whose values are shown
/// anyway.
std::string show_sensors(const json::Node& status, std::string_view kind);

}  // namespace drover::cli
