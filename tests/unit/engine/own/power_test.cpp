#include "engine/own/power.h"

#include <gtest/gtest.h>

#include <array>

namespace drover::engine {
namespace {

using std::chrono::milliseconds;

/// Two drives that run, and the switch of their power.
struct Powered {
  Powered() {
    for (AxisSnapshot& axis : axes) {
      axis.health = SourceState::fresh;
      axis.state = AxisState::running;
    }
  }
  bool after_ms(int ms) {
    for (int i = 0; i < ms; i += 5) power.step(now += milliseconds(5), input, axes);
    return power.closed();
  }
  PowerSwitch power;
  std::array<AxisSnapshot, 2> axes{};
  PowerInput input;
  Time now{std::chrono::seconds(1)};
};

TEST(ThePowerSwitch, OpensAtOnceForAnEstopAndClosesAfterIt) {
  Powered it;
  EXPECT_TRUE(it.after_ms(5));
  it.input.estop = true;
  EXPECT_FALSE(it.after_ms(5));
  it.input.estop = false;
  EXPECT_TRUE(it.after_ms(5));
}
TEST(ThePowerSwitch, StaysAsItWasFoundWhileTheEmergencyStopsLineIsAwaited) {
  for (const bool found : {true, false}) {
    Powered it;
    it.input = {.estop = true, .waits = true, .closed = found};
    EXPECT_EQ(it.after_ms(100), found);
    it.input = {.estop = false, .waits = false, .closed = found};
    EXPECT_TRUE(it.after_ms(5));
  }
}
TEST(ThePowerSwitch, OpensOnlyWhenTheDrivesHaveGoneIdle) {
  Powered it;
  it.input.cut = true;
  EXPECT_TRUE(it.after_ms(500));
  it.axes[0].state = AxisState::idle;
  EXPECT_TRUE(it.after_ms(100));
  it.axes[1].state = AxisState::idle;
  EXPECT_FALSE(it.after_ms(5));
}
TEST(ThePowerSwitch, WaitsForADriveInFaultOnlyWhileItsPowerStageIsOn) {
  Powered it;
  it.axes[0].state = AxisState::idle;
  it.axes[1].state = AxisState::fault;
  it.axes[1].powered = true;
  it.input.cut = true;
  EXPECT_TRUE(it.after_ms(500)) << "it brakes: its energy needs the battery";
  it.axes[1].powered = false;
  EXPECT_FALSE(it.after_ms(5));
}
TEST(ThePowerSwitch, OpensInTheEndWhenADriveDoesNotGoIdle) {
  Powered it;
  it.input.cut = true;
  EXPECT_TRUE(it.after_ms(1400));
  EXPECT_FALSE(it.after_ms(200));
}
TEST(ThePowerSwitch, StaysOpenOverARestartUntilItIsReset) {
  Powered it;
  it.power.recall(true);
  it.input.cut = true;
  for (AxisSnapshot& axis : it.axes) axis.health = SourceState::never_heard;
  EXPECT_FALSE(it.after_ms(5000));
  it.input.cut = false;
  EXPECT_TRUE(it.after_ms(5));
}

}  // namespace
}  // namespace drover::engine
