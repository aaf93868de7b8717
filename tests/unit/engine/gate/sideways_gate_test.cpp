// The first gate of a base that goes sideways, too: one speed, one acceleration, whatever
// direction.
#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "engine/gate/target_gate.h"

namespace drover::engine {
namespace {

class AGateToAllSides : public ::testing::Test {
 protected:
  static constexpr Duration kTick = std::chrono::milliseconds(5);
  static constexpr double kTick_s = 0.005;

  const Twist& offer(const Twist& twist, Stop stop = Stop::none) {
    now += kTick;
    const Offer one{Owner::cmd_vel, twist, now};
    const Twist before = gate.twist();
    const Twist& after = gate.step(now, kTick, {&one, 1}, stop);
    fastest_mps2 =
        std::max(fastest_mps2,
                 std::hypot(after.vx_mps - before.vx_mps, after.vy_mps - before.vy_mps) / kTick_s);
    return after;
  }
  void run(const Twist& twist, int ticks = 1000) {
    for (int i = 0; i < ticks; ++i) offer(twist);
  }

  LimitsConfig limits;
  TargetGate gate{limits, std::chrono::milliseconds(100), {.sideways = true}};
  Time now{std::chrono::seconds(100)};
  double fastest_mps2 = 0;
};

TEST_F(AGateToAllSides, ReachesWhatIsWantedAtNoMoreThanOneAcceleration) {
  run({0.3, 0, -0.4});
  EXPECT_DOUBLE_EQ(gate.twist().vx_mps, 0.3);
  EXPECT_DOUBLE_EQ(gate.twist().vy_mps, -0.4);
  EXPECT_LE(fastest_mps2, limits.acceleration_mps2 * 1.001);
  EXPECT_GT(fastest_mps2, limits.acceleration_mps2 * 0.9);
}

TEST_F(AGateToAllSides, BoundsTheSpeedAndKeepsTheDirection) {
  run({3, 0, 4});
  EXPECT_NEAR(gate.twist().vx_mps, 0.6 * limits.max_speed_mps, 1e-9);
  EXPECT_NEAR(gate.twist().vy_mps, 0.8 * limits.max_speed_mps, 1e-9);
}

TEST_F(AGateToAllSides, StopsAlongItsWay) {
  run({0.3, 0, 0.3});
  for (int i = 0; i < 1000 && !gate.at_rest(); ++i) {
    const Twist& twist = offer({}, Stop::controlled);
    ASSERT_NEAR(twist.vx_mps, twist.vy_mps, 1e-9);
  }
  EXPECT_TRUE(gate.at_rest());
  EXPECT_LE(fastest_mps2, limits.deceleration_mps2 * 1.001);
}

TEST_F(AGateToAllSides, IsAtRestAtOnceOnAnImmediateStop) {
  run({0, 0, 0.3});
  EXPECT_FALSE(gate.at_rest());
  EXPECT_TRUE(is_zero(offer({0, 0, 0.3}, Stop::immediate)));
}

TEST_F(AGateToAllSides, RefusesWhatIsNoNumber) {
  run({0, 0, 0.3});
  offer({0, 0, std::numeric_limits<double>::quiet_NaN()});
  EXPECT_EQ(gate.refusal(), TargetRefusal::not_finite);
  EXPECT_LT(gate.twist().vy_mps, 0.3);
}

TEST(AGateOfABaseThatCannot, GoesNowhereAside) {
  TargetGate gate{LimitsConfig{}, std::chrono::milliseconds(100)};
  Time now{std::chrono::seconds(100)};
  for (int i = 0; i < 100; ++i) {
    now += std::chrono::milliseconds(5);
    const Offer one{Owner::cmd_vel, {0.2, 0, 0.3}, now};
    EXPECT_EQ(gate.step(now, std::chrono::milliseconds(5), {&one, 1}, Stop::none).vy_mps, 0);
  }
}

}  // namespace
}  // namespace drover::engine
