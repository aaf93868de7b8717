// Which outlets there are, made from the configuration: the one place that names them all.
#pragma once

#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "config/config.h"
#include "publish/aimrt/joint_commands.h"
#include "publish/command_service.h"
#include "publish/outlet.h"

namespace drover::runtime {

publish::CommandServiceConfig service_config(const config::DroverConfig& config);

publish::aimrt::JointCommandsConfig joint_commands_config(const config::DroverConfig& config);

/// `service` and `joint_commands` outlive them. `status`: what `drover status --json` prints.
std::vector<std::unique_ptr<publish::Outlet>> make_outlets(
    const config::DroverConfig& config, publish::CommandService& service,
    publish::aimrt::JointCommands& joint_commands, std::function<std::string(Time)> status);

}  // namespace drover::runtime
