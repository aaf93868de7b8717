// What of the robot follows from its configuration: names, frames, the scanners' limits.
#pragma once

#include "config/config.h"
#include "ros2/shown.h"

namespace drover::ros2 {

/// base_link to each receiver's antenna and to each scanner, by the devices' names, and to the
/// scene's frames. None of the inertial sensor: its samples are in base_link already.
Robot robot_of(const config::DroverConfig& config);

}  // namespace drover::ros2
