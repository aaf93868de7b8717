// What was learned is beside a part of the configuration, and holds as long as that is the same.
#include "runtime/learned_subject.h"

#include <gtest/gtest.h>

#include <functional>
#include <utility>
#include <vector>

#include "config/load.h"

namespace drover::runtime {
namespace {

config::DroverConfig field_robot() {
  return config::load_file(DROVER_SOURCE_DIR "/config/drover.json").config;
}

config::DeviceConfig& device_of(config::DroverConfig& config, SlotKind kind) {
  for (config::DeviceConfig& device : config.devices)
    if (device.kind == kind) return device;
  ADD_FAILURE() << "there is none";
  return config.devices.front();
}

using Change = std::function<void(config::DroverConfig&)>;

TEST(WhatWasLearned, HoldsWhereNothingThatItIsBesideChanged) {
  const auto before = learned_subject(field_robot());
  const std::vector<Change> changes{
      [](config::DroverConfig& c) { c.mqtt.host = "10.0.0.5"; },
      [](config::DroverConfig& c) { c.engine.limits.max_speed_mps = 0.4; },
      [](config::DroverConfig& c) { c.engine.navigate.corridor_m = 0.3; },
      [](config::DroverConfig& c) { device_of(c, SlotKind::battery).period_s = 3; },
      [](config::DroverConfig& c) { c.robot_name = "another"; }};
  for (std::size_t i = 0; i < changes.size(); ++i) {
    auto config = field_robot();
    changes[i](config);
    EXPECT_EQ(learned_subject(config), before) << i;
  }
}

TEST(WhatWasLearned, IsNoneOfAnotherBaseDriveAntennaOrSensor) {
  const auto before = learned_subject(field_robot());
  const std::vector<Change> changes{
      [](config::DroverConfig& c) { c.engine.base.wheel_radius_m += 0.001; },
      [](config::DroverConfig& c) { c.engine.base.track_m += 0.01; },
      [](config::DroverConfig& c) { c.engine.base.yaw_slip_factor += 0.1; },
      [](config::DroverConfig& c) { std::swap(c.engine.base.left, c.engine.base.right); },
      [](config::DroverConfig& c) { device_of(c, SlotKind::gnss).antenna_x_m += 0.01; },
      [](config::DroverConfig& c) {
        device_of(c, SlotKind::gnss).heading_baseline_offset_deg += 1;
      },
      [](config::DroverConfig& c) { device_of(c, SlotKind::gnss).driver = "another"; },
      [](config::DroverConfig& c) { c.links[device_of(c, SlotKind::gnss).link_index].baud = 9600; },
      [](config::DroverConfig& c) { device_of(c, SlotKind::imu).name = "another"; },
      [](config::DroverConfig& c) {
        device_of(c, SlotKind::drive).options.set("gear_ratio", 3.0);
      }};
  for (std::size_t i = 0; i < changes.size(); ++i) {
    auto config = field_robot();
    changes[i](config);
    EXPECT_NE(learned_subject(config), before) << i;
  }
}

TEST(WhatWasLearned, IsBesideTheSensorsThatSteer) {
  auto config = config::load_file(DROVER_SOURCE_DIR "/config/examples/two_of_each.json").config;
  std::swap(config.engine.receivers[0].role, config.engine.receivers[1].role);
  const auto beside = learned_beside(config);
  EXPECT_EQ(beside.receiver, 1);
  EXPECT_EQ(beside.imu, 0);
  config.engine.base.kind = engine::BaseKind::twist;
  EXPECT_TRUE(std::isnan(learned_beside(config).wheel_radius_m));
}

}  // namespace
}  // namespace drover::runtime
