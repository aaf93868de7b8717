#include "runtime/outlets.h"

#include <algorithm>

#include "publish/aimrt_outlet.h"
#include "publish/cli_outlet.h"
#include "publish/rtk_outlet.h"

namespace drover::runtime {

namespace {

HeadingConvention heading_convention(const config::ProtocolConfig& protocol) {
  if (protocol.heading == "counterclockwise_from_north")
    return HeadingConvention::counterclockwise_from_north;
  if (protocol.heading == "counterclockwise_from_east")
    return HeadingConvention::counterclockwise_from_east;
  return HeadingConvention::clockwise_from_north;
}

publish::RtkConfig rtk_config(const config::ProtocolConfig& protocol) {
  publish::RtkConfig rtk;
  rtk.heading = heading_convention(protocol);
  if (protocol.power == "volts") rtk.power = publish::PowerUnit::volts;
  if (protocol.vz == "steering_angle") rtk.vz = publish::TurnShown::steering_angle;
  return rtk;
}

publish::aimrt::Wording wording(const std::string& names, const std::string& content) {
  using publish::aimrt::Names;
  publish::aimrt::Wording it;
  if (names == "aimrt_1x") it.names = {Names::aimrt_1x};
  if (names == "both") it.names = {Names::document, Names::aimrt_1x};
  if (content == "json") it.content = publish::aimrt::Content::json;
  return it;
}

publish::aimrt::ChannelConfig channel_config(const config::DroverConfig& config) {
  const auto& aimrt = config.aimrt;
  publish::aimrt::ChannelConfig channel;
  channel.joint_state = aimrt.joint_state;
  channel.imu_state = aimrt.imu_state;
  channel.touch_state = aimrt.touch_state;
  channel.joint_command = aimrt.joint_command;
  channel.joint_state_wording = wording(aimrt.joint_state_names, aimrt.joint_state_content);
  channel.imu_state_wording = wording("document", aimrt.imu_state_content);
  channel.touch_state_wording = wording(aimrt.touch_state_names, aimrt.touch_state_content);
  return channel;
}

}  // namespace

publish::aimrt::JointCommandsConfig joint_commands_config(const config::DroverConfig& config) {
  publish::aimrt::JointCommandsConfig commands;
  commands.silence = from_s(config.engine.health.joint_command_timeout_s);
  commands.rules.max_age = from_s(1e-3 * config.aimrt.max_command_age_ms);
  for (const auto& joint : config.engine.joints)
    commands.rules.joints.emplace_back(std::string(joint.view()));
  const auto& groups = config.engine.groups;
  for (std::size_t i = 0; i < groups.size(); ++i)
    for (const auto& rules : groups[i].joints) {
      auto& joint = commands.rules.joints.at(rules.axis);
      joint.follows = rules.follows;
      joint.group = i + 1;
      joint.carries_weight = rules.carries_weight;
      joint.timeout = from_s(rules.timeout_s);
      commands.just_came = std::max(commands.just_came, joint.timeout);
    }
  commands.max_commands_Hz *= static_cast<double>(1 + groups.size());
  return commands;
}

publish::CommandServiceConfig service_config(const config::DroverConfig& config) {
  publish::CommandServiceConfig service;
  service.zero_based_ids = config.protocol.first_target_id == 0;
  service.start_needs_time = config.protocol.start_needs_time;
  service.automatic_origin = config.protocol.automatic_origin;
  service.antenna = {config.engine.estimate.antenna_x_m, config.engine.estimate.antenna_y_m,
                     heading_convention(config.protocol)};
  service.drive = config.engine.navigate.drive;
  return service;
}

std::vector<std::unique_ptr<publish::Outlet>> make_outlets(
    const config::DroverConfig& config, publish::CommandService& service,
    publish::aimrt::JointCommands& joint_commands, std::function<std::string(Time)> status) {
  std::vector<std::unique_ptr<publish::Outlet>> outlets;
  outlets.push_back(std::make_unique<publish::RtkOutlet>(rtk_config(config.protocol), service));
  if (config.mqtt.enabled && config.aimrt.enabled)
    outlets.push_back(std::make_unique<publish::AimrtOutlet>(
        channel_config(config), joint_commands, config.aimrt.rate_Hz, config.aimrt.commands));
  outlets.push_back(std::make_unique<publish::CliOutlet>(service, std::move(status)));
  return outlets;
}

}  // namespace drover::runtime
