// The robot with two of each while it drives: what takes over when one dies.
#include <gmock/gmock.h>

#include "whole_robot.h"

namespace drover::test {
namespace {

TEST(TheRobotWithTwoOfEach, HasASpareTakeOverInATaskWithoutAnAllocation) {
  WholeRobot robot("field_two_of_each");
  robot.start_task();
  ASSERT_EQ(robot.seen().nav.status, NavStatus::run) << robot.why();
  robot.run_s(1);
  const auto in_use = [&](SensorKind kind, const char* name) {
    for (const SensorSnapshot& sensor : robot.seen().sensors)
      if (sensor.kind == kind && sensor.name == name) return sensor.in_use;
    ADD_FAILURE() << "no sensor " << name;
    return false;
  };
  EXPECT_TRUE(in_use(SensorKind::receiver, "gnss"));
  EXPECT_EQ(robot.robot.command("gnss silent"), "ok");
  EXPECT_EQ(robot.robot.command("imu silent"), "ok");
  robot.drive_s(60);
  EXPECT_TRUE(in_use(SensorKind::receiver, "gnss_rear"));
  EXPECT_TRUE(in_use(SensorKind::imu, "imu_rear"));
  EXPECT_EQ(robot.seen().nav.status, NavStatus::success) << robot.why();
  EXPECT_NEAR(robot.robot.truth().pose.x_m, robot.path.points.back().x_m, 0.2);
  EXPECT_EQ(robot.allocations, 0U);
}

}  // namespace
}  // namespace drover::test
