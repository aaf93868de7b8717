#include "runtime/hand_back.h"

#include <gtest/gtest.h>

namespace drover::runtime {
namespace {

Snapshot with_joint(std::uint8_t group, double velocity_radps, SourceState health) {
  Snapshot robot;
  AxisSnapshot axis;
  axis.group = group;
  axis.health = health;
  axis.motion.velocity_radps = velocity_radps;
  (void)robot.axes.push_back(axis);
  return robot;
}

TEST(HandBack, WaitsForARobotThatRests) {
  EXPECT_FALSE(cannot_wait(Snapshot{}, true));
  EXPECT_FALSE(cannot_wait(with_joint(1, 0.02, SourceState::fresh), true));
}

TEST(HandBack, CannotWaitForABaseThatRolls) {
  Snapshot robot;
  robot.hold = HoldState::catching;
  EXPECT_TRUE(cannot_wait(robot, false));
}

TEST(HandBack, CannotWaitForAJointThatSinks) {
  EXPECT_TRUE(cannot_wait(with_joint(1, -0.3, SourceState::fresh), true));
  EXPECT_TRUE(cannot_wait(with_joint(2, 0.06, SourceState::fresh), true));
}

/// Which the guard is bringing to rest.
TEST(HandBack, WaitsForABaseThatIsNotAtRest) {
  EXPECT_FALSE(cannot_wait(with_joint(1, -0.3, SourceState::fresh), false));
}

/// Wheels under the guard's zeros come to rest; what is not heard is no motion.
TEST(HandBack, WaitsForWheelsAndForWhatIsNotHeard) {
  EXPECT_FALSE(cannot_wait(with_joint(0, 3, SourceState::fresh), true));
  EXPECT_FALSE(cannot_wait(with_joint(1, -0.3, SourceState::stale), true));
  EXPECT_FALSE(cannot_wait(with_joint(1, kAbsent, SourceState::fresh), true));
}

}  // namespace
}  // namespace drover::runtime
