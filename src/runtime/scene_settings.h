// From the configuration to what the scene's keeper has to know of the robot.
#pragma once

#include "config/config.h"
#include "drover/scan.h"
#include "scene/keeper/keeper.h"
#include "scene/sensor/field.h"

namespace drover::runtime {

/// Of a configuration without problems that has the section `scene`. The robot's body, for who asks
/// whether it is in a view: its footprint from the ground clearance up to its top, whether heights
/// are looked at or not.
scene::KeeperSettings keeper_settings(const config::DroverConfig& config);

/// The field of a scanner that is mounted so: from the footprint's front edge on, and not behind
/// the scanner.
scene::sensor::SensorField sensor_field(const config::DroverConfig& config, const ScanMount& mount);

}  // namespace drover::runtime
