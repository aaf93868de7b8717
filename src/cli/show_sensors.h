// Several receivers, inertial sensors or batteries: a line for each. And the scanners.
#pragma once

#include <string>
#include <string_view>

#include "json/located_json.h"

namespace drover::cli {

/// Of one kind ("gnss", "imu", "battery"); empty where there is only one, whose values are shown
/// anyway.
std::string show_sensors(const json::Node& status, std::string_view kind);
/// Each with its health, its pace, and in how many of its points something was seen.
std::string show_scanners(const json::Node& status);

}  // namespace drover::cli
