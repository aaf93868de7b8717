// What holds of every robot of the simulator, while it drives.
#include <gmock/gmock.h>

#include <set>

#include "drover/registry.h"
#include "whole_robot.h"

namespace drover::test {
namespace {

class AnyRobot : public testing::TestWithParam<std::string> {};

TEST_P(AnyRobot, DrivesATaskWithoutAnAllocation) {
  WholeRobot robot(GetParam());
  robot.start_task();
  ASSERT_EQ(robot.seen().nav.status, NavStatus::run) << robot.why();
  robot.drive_s(60);
  EXPECT_EQ(robot.seen().nav.status, NavStatus::success) << robot.why();
  EXPECT_NEAR(robot.robot.truth().pose.x_m, robot.path.points.back().x_m, 0.2);
  EXPECT_EQ(robot.allocations, 0U);
  for (std::size_t link = 0; link < robot.gateway.wiring().links.size(); ++link)
    EXPECT_EQ(robot.gateway.refused(link), 0U) << robot.gateway.wiring().links[link].name.view();
}

/// So that what is shown of any robot is shown of each driver.
TEST(TheRobotsOfTheSimulator, HaveADeviceOfEachDriver) {
  std::set<std::string_view> missing;
  for (const DriverEntry& entry : driver_registry()) missing.insert(entry.name);
  for (const std::string& robot : simulated_robots()) {
    const auto loaded = config::load_file(robot_file(robot, ".drover.json"));
    ASSERT_TRUE(loaded.problems.empty()) << loaded.problems.front().text(robot);
    for (const auto& device : loaded.config.devices) missing.erase(device.driver);
  }
  EXPECT_THAT(missing, testing::IsEmpty());
}

INSTANTIATE_TEST_SUITE_P(OfTheSimulator, AnyRobot, testing::ValuesIn(simulated_robots()),
                         [](const auto& robot) { return robot.param; });

}  // namespace
}  // namespace drover::test
