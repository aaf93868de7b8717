// Four wheels with rollers: what a twist asks of them, and what they say.
#include "engine/base/mecanum.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <limits>

#include "engine/base/kinematics.h"

namespace drover::engine {
namespace {

using std::chrono::milliseconds;
constexpr Time kStart{std::chrono::seconds(50)};
constexpr Duration kStale = milliseconds(100);
// By their axes: no order that the base counts on.
constexpr AxisId kFrontLeft = 2;
constexpr AxisId kRearLeft = 0;
constexpr AxisId kFrontRight = 1;
constexpr AxisId kRearRight = 4;

BaseConfig mecanum_config() {
  BaseConfig config;
  config.kind = BaseKind::mecanum;
  config.wheel_radius_m = 0.1;
  config.track_m = 0.44;
  config.wheelbase_m = 0.36;
  for (const AxisId id : {kFrontLeft, kRearLeft}) (void)config.left.push_back(id);
  for (const AxisId id : {kFrontRight, kRearRight}) (void)config.right.push_back(id);
  return config;
}

class ABaseOnRollers : public ::testing::Test {
 protected:
  BodyMotion told(const JointVelocities& radps, Duration age = {}) const {
    Told told;
    told.joints.resize(radps.size());
    for (std::size_t i = 0; i < radps.size(); ++i) told.joints[i] = {radps[i], kStart};
    return body_motion(base, told, kStart + age, kStale);
  }
  Kinematics base = kinematics_of(mecanum_config());
};

TEST_F(ABaseOnRollers, GoesSidewaysAndPivots) {
  EXPECT_TRUE(limits(base).sideways);
  EXPECT_TRUE(limits(base).pivots);
  EXPECT_FALSE(limits(kinematics_of(BaseConfig{})).sideways);
  EXPECT_FALSE(takes_twist(base));
  EXPECT_EQ(joints_needed(mecanum_config()), 5U);
  EXPECT_EQ(joints_of(base).count(), 4U);
}

TEST_F(ABaseOnRollers, TurnsItsWheelsAgainstEachOtherToTheSide) {
  const JointVelocities left = setpoints(base, {0, 0, 0.3}, {}, 2);
  EXPECT_NEAR(left[kFrontLeft], -3, 1e-12);
  EXPECT_NEAR(left[kFrontRight], 3, 1e-12);
  EXPECT_NEAR(left[kRearLeft], 3, 1e-12);
  EXPECT_NEAR(left[kRearRight], -3, 1e-12);
  EXPECT_EQ(left[3], 0) << "that of somebody else";
}

TEST_F(ABaseOnRollers, TurnsAsAWiderOneWithoutRollers) {
  const JointVelocities turn = setpoints(base, {0, 1, 0}, {1.1}, 2);
  EXPECT_NEAR(turn[kFrontLeft], -(0.44 + 0.36) / 2 * 1.1 / 0.1, 1e-12);
  EXPECT_NEAR(turn[kRearRight], (0.44 + 0.36) / 2 * 1.1 / 0.1, 1e-12);
}

TEST_F(ABaseOnRollers, DoesWhatItsSetPointsWereFor) {
  for (const Twist& wanted : {Twist{0.3, -0.7, 0.2}, Twist{-0.4, 0, -0.1}, Twist{0, 0, 0.5},
                              Twist{0.2, 0.5, 0}, Twist{0.1, 0.1, -0.5}}) {
    const JointVelocities radps = setpoints(base, wanted, {}, 5);
    const BodyMotion got = told(radps);
    EXPECT_TRUE(got.known);
    EXPECT_FALSE(got.standing);
    EXPECT_NEAR(got.twist.vx_mps, wanted.vx_mps, 1e-12);
    EXPECT_NEAR(got.twist.vy_mps, wanted.vy_mps, 1e-12);
    EXPECT_NEAR(got.twist.wz_radps, wanted.wz_radps, 1e-12);
    EXPECT_NEAR(got.vx_var, 0, 1e-12) << "all of one mind";
    EXPECT_NEAR(got.vy_var, 0.01 * wanted.vy_mps * wanted.vy_mps, 1e-12) << "rollers slip";
    const Twist again = twist_of(base, radps, {});
    EXPECT_NEAR(again.vy_mps, wanted.vy_mps, 1e-12);
    double fastest = 0;
    for (const double each : radps) fastest = std::max(fastest, std::abs(rim_mps(base, each)));
    EXPECT_NEAR(fastest_mps(base, wanted), fastest, 1e-12);
  }
}

TEST_F(ABaseOnRollers, KeepsItsDirectionWhereAWheelWouldBeTooFast) {
  const Twist wanted{0.6, 0.5, -0.4};
  const BodyMotion got = told(setpoints(base, wanted, {}, 0.6));
  EXPECT_NEAR(got.twist.vx_mps / wanted.vx_mps, 0.5, 1e-12);
  EXPECT_NEAR(got.twist.vy_mps / wanted.vy_mps, 0.5, 1e-12);
  EXPECT_NEAR(got.twist.wz_radps / wanted.wz_radps, 0.5, 1e-12);
}

TEST_F(ABaseOnRollers, IsAtRestWhereNothingPermitsMotion) {
  constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
  for (const Twist& bad : {Twist{kNan, 0, 0}, Twist{0, kNan, 0}, Twist{0, 0, kNan}})
    for (const double each : setpoints(base, bad, {}, 1)) EXPECT_EQ(each, 0);
  for (const double each : setpoints(base, {0.3, 0, 0.3}, {}, 0)) EXPECT_EQ(each, 0);
}

TEST_F(ABaseOnRollers, MayDriveAtFullSpeedInAnyDirection) {
  LimitsConfig limits;
  limits.max_speed_mps = 0.8;
  limits.max_yaw_rate_radps = 0;
  const double aslant_mps = 0.8 / std::sqrt(2);
  EXPECT_NEAR(max_rim_mps(base, limits, {}), fastest_mps(base, {aslant_mps, 0, aslant_mps}), 1e-12);
}

TEST_F(ABaseOnRollers, IsUnknownWithoutOneOfItsWheels) {
  for (const AxisId silent : {kFrontLeft, kFrontRight, kRearLeft, kRearRight}) {
    const JointVelocities radps = setpoints(base, {0.3, 0, 0}, {}, 5);
    Told all;
    all.joints.resize(radps.size());
    for (std::size_t i = 0; i < radps.size(); ++i) all.joints[i] = {radps[i], kStart};
    all.joints[silent].at = kStart - milliseconds(200);
    EXPECT_FALSE(body_motion(base, all, kStart, kStale).known) << int(silent);
  }
  EXPECT_FALSE(told(setpoints(base, {0.3, 0, 0}, {}, 5), milliseconds(101)).known);
}

TEST_F(ABaseOnRollers, StandsWhereAllOfItsWheelsDo) {
  EXPECT_TRUE(told(setpoints(base, {}, {}, 5)).standing);
  JointVelocities one = setpoints(base, {}, {}, 5);
  one[kRearLeft] = 1;
  EXPECT_FALSE(told(one).standing);
}

TEST_F(ABaseOnRollers, IsUncertainWhereItsWheelsWorkAgainstEachOther) {
  JointVelocities radps = setpoints(base, {0.3, 0, 0}, {}, 5);
  radps[kRearLeft] -= 1;  // 0.1 m/s
  const BodyMotion got = told(radps);
  EXPECT_NEAR(std::sqrt(got.vx_var), 0.025, 1e-9);
  EXPECT_GE(std::sqrt(got.vx_var) + 1e-9, std::abs(got.twist.vx_mps - 0.3));
  EXPECT_GE(std::sqrt(got.vy_var) + 1e-9, std::abs(got.twist.vy_mps));
  EXPECT_GE(std::sqrt(got.wz_var) + 1e-9, std::abs(got.twist.wz_radps));
}

}  // namespace
}  // namespace drover::engine
