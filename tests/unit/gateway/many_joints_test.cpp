// A robot of as many joints as there may be: 64 on 8 buses.
#include <gtest/gtest.h>

#include <algorithm>

#include "gateway/recording/encoder.h"
#include "gateway/recording/format.h"
#include "gateway/recording/replay.h"
#include "recorded_run.h"
#include "support/allocation_counter.h"
#include "tests/bench/bench_robot.h"

namespace drover::gateway {
namespace {

TEST(SixWheels, AreAllHeard) {
  Robot robot(6);
  for (const AxisSnapshot& axis : robot.gateway().snapshot().axes)
    EXPECT_GT(axis.source.samples, 0U) << axis.joint.view();
}

TEST(SixtyFourJoints, AreAllHeardAndToldSomethingOnEightBuses) {
  Robot robot(64);
  const Gateway& gateway = robot.gateway();
  ASSERT_EQ(gateway.bus_count(), 8U);
  const auto& axes = gateway.snapshot().axes;
  ASSERT_EQ(axes.size(), kMaxAxes);
  for (const AxisSnapshot& axis : axes) {
    EXPECT_EQ(axis.health, SourceState::fresh) << axis.joint.view();
    EXPECT_EQ(axis.state, AxisState::running) << axis.joint.view();
  }
  for (std::size_t bus = 0; bus < gateway.bus_count(); ++bus) {
    EXPECT_GE(gateway.output().frames[bus].size(), 8U) << bus;
    EXPECT_EQ(gateway.no_room(bus), 0U) << bus;
    EXPECT_EQ(gateway.refused(bus), 0U) << bus;
  }
}

TEST(SixtyFourJoints, AreCommandedWithoutAnAllocationAndRecorded) {
  Robot robot(64);
  RecordEncoder encoder;
  ASSERT_LE(field_names(robot.gateway()).size(), kMaxFields);
  const test::AllocationCounter counter;
  std::size_t largest = 0;
  for (int i = 0; i < 200; ++i) {
    JointTargets targets;
    for (std::size_t axis = 0; axis < kMaxAxes; ++axis)
      (void)targets.joints.push_back({static_cast<AxisId>(axis), i < 100 ? 0.0 : 0.5});
    const Command command{{RequestId::Source::aimrt, 1}, robot.now(), targets};
    robot.gateway().apply({robot.now(), CommandGiven{command}});
    robot.cycle();
    largest = std::max(largest, encoder.output(robot.gateway()).size());
  }
  EXPECT_EQ(counter.count(), 0U);
  EXPECT_GT(largest, 0U);
  EXPECT_LT(largest, kMaxRecord);
  EXPECT_EQ(robot.gateway().snapshot().joint_command.refused, 0U)
      << robot.gateway().snapshot().joint_command.reason.view();
}

TEST(SixtyFourJoints, AreOneTooManyWithAnother) {
  EXPECT_THROW(robot(65), std::runtime_error);
}

}  // namespace
}  // namespace drover::gateway
