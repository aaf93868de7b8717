#include "engine/gate/joint_gate.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "engine/base/kinematics.h"

namespace drover::engine {
namespace {

using namespace std::chrono_literals;

constexpr double kNoCap_mps = 1e9;
constexpr Duration kCycle = 5ms;

BaseConfig base_of_four() {
  BaseConfig base;
  for (const AxisId id : {AxisId{0}, AxisId{2}}) (void)base.left.push_back(id);
  for (const AxisId id : {AxisId{1}, AxisId{3}}) (void)base.right.push_back(id);
  return base;
}

class AJointGate : public ::testing::Test {
 protected:
  using Wanted = std::array<double, 4>;

  void step(const Wanted& wanted, double cap_mps = kNoCap_mps, Stop stop = Stop::none) {
    gate.step(kCycle, wanted, 1.0, cap_mps, stop);
  }
  void run(const Wanted& wanted, double cap_mps = kNoCap_mps) {
    for (int i = 0; i < 1000; ++i) step(wanted, cap_mps);
  }
  double radps(std::size_t joint) const { return gate.velocities_radps()[joint]; }
  Twist twist(std::size_t left, std::size_t right) const {
    return twist_from_wheels(sides_of(base), 1.0, radps(left) * base.wheel_radius_m,
                             radps(right) * base.wheel_radius_m);
  }

  BaseConfig base = base_of_four();
  LimitsConfig limits;
  JointGate gate{base, limits};
};

TEST_F(AJointGate, FollowsWhatIsWithinTheLimits) {
  run({2, 3, 2.5, 3});
  for (const auto& [joint, wanted] : {std::pair{0, 2.0}, {1, 3.0}, {2, 2.5}, {3, 3.0}})
    EXPECT_DOUBLE_EQ(radps(static_cast<std::size_t>(joint)), wanted);
}
TEST_F(AJointGate, ScalesAllJointsAlikeToTheHighestSpeed) {
  run({20, 20, 20, 20});
  EXPECT_NEAR(twist(0, 1).vx_mps, limits.max_speed_mps, 1e-9);
  run({8, 4, 8, 4});
  EXPECT_NEAR(radps(0), 2 * radps(1), 1e-9) << "the curve stays";
}
TEST_F(AJointGate, ScalesAllJointsAlikeToTheHighestTurnRate) {
  run({-20, 20, -20, 20});
  EXPECT_NEAR(twist(0, 1).wz_radps, limits.max_yaw_rate_radps, 1e-9);
}
TEST_F(AJointGate, JudgesEachWheelOfASideByItself) {
  run({20, 0, -20, 0});
  EXPECT_LE(std::abs(twist(0, 1).wz_radps), limits.max_yaw_rate_radps + 1e-9);
  EXPECT_GT(radps(0), 1);
}
TEST_F(AJointGate, LetsNoRimBeFasterThanTheCap) {
  run({20, 20, 20, 20});
  run({20, 10, 20, 10}, 0.25);
  EXPECT_NEAR(radps(0) * base.wheel_radius_m, 0.25, 1e-9);
  EXPECT_NEAR(radps(1) * base.wheel_radius_m, 0.125, 1e-9);
  run({20, 20, 20, 20}, 0);
  EXPECT_TRUE(gate.at_rest());
}
TEST_F(AJointGate, TakesWhatIsNoNumberForRest) {
  run({1, 1, 1, 1});
  run({std::nan(""), INFINITY, std::nan(""), -INFINITY});
  EXPECT_TRUE(gate.at_rest());
  for (int i = 0; i < 100; ++i)
    gate.step(kCycle, Wanted{1, 1, 1, 1}, std::nan(""), kNoCap_mps, Stop::none);
  EXPECT_TRUE(gate.at_rest()) << "how it turns is not known";
}
TEST_F(AJointGate, RampsDownForAStopAndIsAtRestAtOnceForAnImmediateOne) {
  run({20, 20, 20, 20});
  const double cycles = limits.max_speed_mps / limits.deceleration_mps2 / to_s(kCycle);
  for (int i = 0; i < static_cast<int>(cycles) - 1; ++i) step({}, kNoCap_mps, Stop::controlled);
  EXPECT_FALSE(gate.at_rest());
  for (int i = 0; i < 2; ++i) step({}, kNoCap_mps, Stop::controlled);
  EXPECT_TRUE(gate.at_rest());
  run({20, 20, 20, 20});
  step({20, 20, 20, 20}, kNoCap_mps, Stop::immediate);
  EXPECT_TRUE(gate.at_rest());
}
TEST_F(AJointGate, KeepsWithinItsLimitsOnTheWayFromAnyVelocitiesToAnyOthers) {
  std::mt19937 random(7);
  std::uniform_real_distribution<double> any(-10, 10);
  const double step_radps = limits.deceleration_mps2 * to_s(kCycle) / base.wheel_radius_m;
  const double step_up_radps = limits.acceleration_mps2 * to_s(kCycle) / base.wheel_radius_m;
  for (int change = 0; change < 200; ++change) {
    const Wanted wanted{any(random), any(random), any(random), any(random)};
    for (int i = 0; i < 150; ++i) {
      const auto before = gate.velocities_radps();
      step(wanted);
      for (std::size_t joint = 0; joint < 4; ++joint) {
        ASSERT_LE(std::abs(radps(joint) - before[joint]), step_radps + 1e-9);
        ASSERT_LE(std::abs(radps(joint)) - std::abs(before[joint]), step_up_radps + 1e-9);
      }
      for (const std::size_t left : {0U, 2U}) {
        for (const std::size_t right : {1U, 3U}) {
          ASSERT_LE(std::abs(twist(left, right).vx_mps), limits.max_speed_mps + 1e-9);
          ASSERT_LE(std::abs(twist(left, right).wz_radps), limits.max_yaw_rate_radps + 1e-9);
        }
      }
    }
  }
}

}  // namespace
}  // namespace drover::engine
