// What the engine asks of a base, of every kind.
#include "engine/base/kinematics.h"

#include <gtest/gtest.h>

#include <cmath>

namespace drover::engine {
namespace {

using std::chrono::milliseconds;
constexpr Time kStart{std::chrono::seconds(50)};
constexpr Duration kStale = milliseconds(100);

/// A base whose joints are not the first ones.
BaseConfig config_of(BaseKind kind) {
  BaseConfig config;
  config.kind = kind;
  config.wheel_radius_m = 0.2;
  config.track_m = 0.6;
  (void)config.left.push_back(3);
  (void)config.right.push_back(7);
  return config;
}

class ABaseOnWheels : public ::testing::TestWithParam<BaseKind> {
 protected:
  BaseConfig config = config_of(GetParam());
  Kinematics base = kinematics_of(config);
};

TEST_P(ABaseOnWheels, KnowsItsJoints) {
  EXPECT_EQ(joints_needed(config), 8U);
  const JointSet joints = joints_of(base);
  EXPECT_EQ(joints.count(), 2U);
  EXPECT_TRUE(joints[3] && joints[7]);
}

TEST_P(ABaseOnWheels, CommandsItsOwnJointsOnly) {
  const JointVelocities radps = setpoints(base, {0.5, 1.0}, {1.0}, 2.0);
  EXPECT_NEAR(radps[3], 1.0, 1e-12);
  EXPECT_NEAR(radps[7], 4.0, 1e-12);
  for (std::size_t i = 0; i < radps.size(); ++i) {
    EXPECT_EQ(radps[i] != 0, i == 3 || i == 7) << i;
  }
}

TEST_P(ABaseOnWheels, DoesWhatItsSetPointsWereFor) {
  const Twist wanted{0.3, -0.7};
  const JointVelocities radps = setpoints(base, wanted, {1.4}, 2.0);
  Told told;
  told.joints.resize(radps.size());
  for (std::size_t i = 0; i < radps.size(); ++i) told.joints[i] = {radps[i], kStart};
  const BodyMotion got = body_motion(base, told, kStart, kStale);
  EXPECT_NEAR(got.twist.vx_mps, wanted.vx_mps, 1e-12);
  EXPECT_NEAR(got.twist.wz_radps, 1.4 * wanted.wz_radps, 1e-12);  // nothing learned is in it
  EXPECT_NEAR(largest_twist(base, radps, {1.4}).wz_radps, 0.7, 1e-12);
}

TEST_P(ABaseOnWheels, TellsTheTwistThatItsJointsMakeAndThatOfNone) {
  const Twist asked{-0.4, 0.3};
  const JointVelocities radps = setpoints(base, asked, {1.4}, 10);
  const Twist made = twist_of(base, radps, {1.4});
  EXPECT_NEAR(made.vx_mps, asked.vx_mps, 1e-12);
  EXPECT_NEAR(made.wz_radps, asked.wz_radps, 1e-12);
  EXPECT_TRUE(is_zero(twist_of(base, JointVelocities{}, {1.4})));
}

TEST_P(ABaseOnWheels, NamesTheFastestWheel) {
  const Twist twist{0.3, -0.7};
  const JointVelocities radps = setpoints(base, twist, {1.0}, 2.0);
  EXPECT_NEAR(fastest_mps(base, twist), rim_mps(base, std::abs(radps[3])), 1e-12);
  EXPECT_NEAR(joint_radps(base, rim_mps(base, 2.5)), 2.5, 1e-12);
}

TEST_P(ABaseOnWheels, SaysWhenWhatItToldWillBeStale) {
  Told told;
  EXPECT_GT(next_stale(told, kStart, kStale), kStart + std::chrono::hours(1));
  told.joints.resize(8);
  told.joints[3] = {1, kStart - milliseconds(40)};
  told.joints[7] = {1, kStart - milliseconds(10)};
  const Time next = next_stale(told, kStart, kStale);
  EXPECT_TRUE(body_motion(base, told, next - Duration{1}, kStale).known);
  EXPECT_FALSE(body_motion(base, told, next, kStale).known);
}

TEST(Differential, KnowsItsTurnBetterThanABaseThatSkids) {
  const EstimateConfig config;
  const EstimateConfig skids = tuned(kinematics_of(config_of(BaseKind::skid_steer)), config);
  const EstimateConfig rolls = tuned(kinematics_of(config_of(BaseKind::differential)), config);
  EXPECT_EQ(skids.yaw_slip_sigma, 0.3);
  EXPECT_LE(rolls.yaw_slip_sigma, 0.05);
  EXPECT_LT(rolls.turning_yaw_rad, skids.turning_yaw_rad);
}

TEST(Differential, LeavesASmallerNumberOfTheConfigurationAlone) {
  EstimateConfig config;
  config.yaw_slip_sigma = 0.001;
  const Kinematics base = kinematics_of(config_of(BaseKind::differential));
  EXPECT_EQ(tuned(base, config).yaw_slip_sigma, 0.001);
}

INSTANTIATE_TEST_SUITE_P(OfEveryKind, ABaseOnWheels,
                         ::testing::Values(BaseKind::skid_steer, BaseKind::differential));

}  // namespace
}  // namespace drover::engine
