// How a drive is taken back that let go: at its own speed, and only from a fault that passes.
#include <gtest/gtest.h>

#include "driver_bench.h"

namespace drover::odrive {
namespace {

TEST(OdriveDriver, CatchesARollingWheelAtItsOwnSpeed) {
  Bench bench;
  bench.hear(kIdleBeat);
  bench.run(2, AxisRequest::rest);
  bench.sent.clear();
  const double one_turnps = 2 * 3.14159265358979;
  bench.run(10, AxisRequest::hold, one_turnps);
  constexpr auto kOneTurn = "06D#0000803F00000000";
  const auto caught = std::find(bench.sent.begin(), bench.sent.end(), kOneTurn);
  const auto armed = std::find(bench.sent.begin(), bench.sent.end(), kClosedLoop);
  ASSERT_NE(armed, bench.sent.end());
  EXPECT_LT(caught, armed);
  EXPECT_EQ(bench.count(kZero), 0);
  EXPECT_EQ(bench.status.state, AxisState::arming);
  bench.hear(kRunningBeat);
  bench.run(2, AxisRequest::hold, 0);
  EXPECT_EQ(bench.sent.back(), kZero);
  EXPECT_EQ(bench.status.state, AxisState::running);
}
TEST(OdriveDriver, SaysWhatVelocityAFrameAsksOfTheJoint) {
  Bench bench;
  const double one_turnps = 2 * 3.14159265358979;
  const auto asked = [&](const char* frame) {
    return bench.driver.setpoint_radps(parse_frame(frame), 0);
  };
  EXPECT_NEAR(asked("06D#0000803F00000000"), one_turnps, 1e-6);
  EXPECT_EQ(asked(kZero), 0);
  EXPECT_TRUE(std::isnan(asked("06D#0000803F0000803F")));  // a torque on top
  EXPECT_TRUE(std::isnan(asked("04D#0000803F00000000")));  // another node
  EXPECT_TRUE(std::isnan(asked(kClosedLoop)));
}

TEST(OdriveDriver, SaysWhetherAFaultIsOnlyAWantOfSupply) {
  Bench bench;
  bench.hear("061#0002000001000000");
  EXPECT_EQ(bench.status.state, AxisState::fault);
  EXPECT_TRUE(bench.status.lapsed);
  bench.hear("061#0022000001000000");  // and the motor is too hot
  EXPECT_FALSE(bench.status.lapsed);
}

}  // namespace
}  // namespace drover::odrive
