// Base twist to wheel speeds and back, and what wheels say that may be silent or contradict.
#include "engine/base/two_sides.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>

namespace drover::engine {
namespace {

TwoSides base() {
  TwoSides base;
  base.wheel_radius_m = 0.2;
  base.track_m = 0.6;
  return base;
}
void expect_stop(const WheelSpeeds& wheels) {
  EXPECT_EQ(wheels.left_radps, 0);
  EXPECT_EQ(wheels.right_radps, 0);
}

TEST(TwoSides, StopsWhenATwistIsNotANumber) {
  expect_stop(wheels_from_twist(base(), 1, {NAN, 0.1}, 1));
  expect_stop(wheels_from_twist(base(), 1, {0.1, NAN}, 1));
  expect_stop(wheels_from_twist(base(), 1, {INFINITY, 0}, 1));
  expect_stop(wheels_from_twist(base(), NAN, {0.5, 0.1}, 1));
}

TEST(TwoSides, StopsWhenTheLimitPermitsNothing) {
  expect_stop(wheels_from_twist(base(), 1, {0.5, 0.1}, 0));
  expect_stop(wheels_from_twist(base(), 1, {0.5, 0.1}, -1));
  expect_stop(wheels_from_twist(base(), 1, {0.5, 0.1}, NAN));
}

TEST(TwoSides, StopsWhenTheWheelHasNoRadius) {
  TwoSides none = base();
  none.wheel_radius_m = 0;
  expect_stop(wheels_from_twist(none, 1, {0.5, 0.1}, 1));
}

TEST(TwoSides, TurnsAllWheelsAlikeStraightAhead) {
  const WheelSpeeds wheels = wheels_from_twist(base(), 1.3, {0.5, 0}, 1);
  EXPECT_DOUBLE_EQ(wheels.left_radps, 2.5);
  EXPECT_DOUBLE_EQ(wheels.right_radps, 2.5);
}

TEST(TwoSides, TurnsCounterClockwiseByFasterRightWheels) {
  const WheelSpeeds wheels = wheels_from_twist(base(), 1, {0, 1}, 1);
  EXPECT_DOUBLE_EQ(wheels.right_radps, 1.5);
  EXPECT_DOUBLE_EQ(wheels.left_radps, -1.5);
}

TEST(TwoSides, AsksMoreOfTheWheelsWhenTheySkid) {
  EXPECT_DOUBLE_EQ(wheels_from_twist(base(), 1.5, {0, 1}, 1).right_radps, 2.25);
}

TEST(TwoSides, KeepsTheCurvatureWhenAWheelWouldBeTooFast) {
  const Twist wanted{1.0, 1.0};
  const WheelSpeeds wheels = wheels_from_twist(base(), 1.2, wanted, 0.68);
  EXPECT_NEAR(wheels.right_radps * 0.2, 0.68, 1e-12);
  const Twist got = twist_from_wheels(base(), 1.2, wheels.left_radps * 0.2, 0.68);
  EXPECT_NEAR(got.wz_radps / got.vx_mps, 1.0, 1e-12);
}

TEST(TwoSides, LimitsTheSlowerSideInReverseToo) {
  const WheelSpeeds wheels = wheels_from_twist(base(), 1, {-1.0, 1.0}, 0.65);
  EXPECT_NEAR(wheels.left_radps * 0.2, -0.65, 1e-12);
}

TEST(TwoSides, FindsTheTwistOfItsOwnWheelSpeeds) {
  const WheelSpeeds wheels = wheels_from_twist(base(), 1.4, {0.3, -0.7}, 2);
  const Twist twist =
      twist_from_wheels(base(), 1.4, wheels.left_radps * 0.2, wheels.right_radps * 0.2);
  EXPECT_NEAR(twist.vx_mps, 0.3, 1e-12);
  EXPECT_NEAR(twist.wz_radps, -0.7, 1e-12);
}

using std::chrono::milliseconds;
constexpr Time kStart{std::chrono::seconds(50)};
constexpr Duration kStale = milliseconds(100);

/// Wheels 0 and 1 on the left, 2 and 3 on the right.
class WheelsOfTwoSides : public ::testing::Test {
 protected:
  WheelsOfTwoSides() {
    for (const AxisId id : {AxisId{0}, AxisId{1}}) (void)sides.left.push_back(id);
    for (const AxisId id : {AxisId{2}, AxisId{3}}) (void)sides.right.push_back(id);
  }
  void tell(AxisId id, double rim_mps, Time at = kStart) {
    joints.resize(4);
    joints[id] = {rim_mps / sides.wheel_radius_m, at};
  }
  BodyMotion motion(Time at = kStart) const { return body_motion(sides, joints, at, kStale); }

  TwoSides sides = base();
  JointMotions joints;
};

TEST_F(WheelsOfTwoSides, KnowNothingWhenASideIsSilent) {
  tell(0, 0.5);
  EXPECT_FALSE(motion().known);
  tell(2, 0.5);
  EXPECT_TRUE(motion(kStart + kStale).known);
  EXPECT_FALSE(motion(kStart + kStale + milliseconds(1)).known);
}

TEST_F(WheelsOfTwoSides, TakeDitherForRest) {
  tell(0, 0.001);
  tell(2, -0.002);
  EXPECT_TRUE(motion().standing);
  EXPECT_EQ(motion().twist.vx_mps, 0);
  tell(2, -0.02);
  EXPECT_FALSE(motion().standing);
}

TEST_F(WheelsOfTwoSides, AverageASideAndSayHowFarItIsApart) {
  tell(0, 0.4);
  tell(1, 0.6);
  for (const AxisId id : {AxisId{2}, AxisId{3}}) tell(id, 0.5);
  EXPECT_NEAR(motion().twist.vx_mps, 0.5, 1e-12);
  EXPECT_NEAR(motion().twist.wz_radps, 0, 1e-12);
  EXPECT_NEAR(motion().vx_var, 0.1 * 0.1, 1e-12);
  EXPECT_NEAR(motion().wz_var, 0.1 * 0.1 / (0.6 * 0.6), 1e-12);
}

TEST_F(WheelsOfTwoSides, KnowLessWhenOneOfASideIsSilent) {
  for (const AxisId id : {AxisId{0}, AxisId{1}, AxisId{2}}) tell(id, 0.5);
  EXPECT_TRUE(motion().known);
  EXPECT_NEAR(motion().twist.vx_mps, 0.5, 1e-12);
  EXPECT_GT(motion().vx_var, 0);
  EXPECT_GT(motion().wz_var, 0);
  tell(3, 0.5);
  EXPECT_NEAR(motion().vx_var, 0, 1e-12);
}

TEST_F(WheelsOfTwoSides, TurnByTheirDifference) {
  for (const AxisId id : {AxisId{0}, AxisId{1}}) tell(id, 0.2);
  for (const AxisId id : {AxisId{2}, AxisId{3}}) tell(id, 0.5);
  EXPECT_NEAR(motion().twist.wz_radps, 0.5, 1e-12);
}

TEST_F(WheelsOfTwoSides, HideNothingWhenOneSideWorksAgainstItself) {
  const Twist twist = largest_twist(sides, 1.0, std::array{1.0, -1.0, 1.0, 1.0});
  EXPECT_NEAR(twist.vx_mps, 0.2, 1e-12);
  EXPECT_NEAR(twist.wz_radps, 0.4 / 0.6, 1e-12);
}

}  // namespace
}  // namespace drover::engine
