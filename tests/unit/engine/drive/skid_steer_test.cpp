// Base twist to wheel speeds and back.
#include "engine/drive/skid_steer.h"

#include <gtest/gtest.h>

#include <cmath>

namespace drover::engine {
namespace {

BaseConfig base() {
  BaseConfig base;
  base.wheel_radius_m = 0.2;
  base.track_m = 0.6;
  return base;
}
void expect_stop(const WheelSpeeds& wheels) {
  EXPECT_EQ(wheels.left_radps, 0);
  EXPECT_EQ(wheels.right_radps, 0);
}

TEST(SkidSteer, StopsWhenATwistIsNotANumber) {
  expect_stop(wheels_from_twist(base(), 1, {NAN, 0.1}, 1));
  expect_stop(wheels_from_twist(base(), 1, {0.1, NAN}, 1));
  expect_stop(wheels_from_twist(base(), 1, {INFINITY, 0}, 1));
  expect_stop(wheels_from_twist(base(), NAN, {0.5, 0.1}, 1));
}

TEST(SkidSteer, StopsWhenTheLimitPermitsNothing) {
  expect_stop(wheels_from_twist(base(), 1, {0.5, 0.1}, 0));
  expect_stop(wheels_from_twist(base(), 1, {0.5, 0.1}, -1));
  expect_stop(wheels_from_twist(base(), 1, {0.5, 0.1}, NAN));
}

TEST(SkidSteer, StopsWhenTheWheelHasNoRadius) {
  BaseConfig none = base();
  none.wheel_radius_m = 0;
  expect_stop(wheels_from_twist(none, 1, {0.5, 0.1}, 1));
}

TEST(SkidSteer, TurnsAllWheelsAlikeStraightAhead) {
  const WheelSpeeds wheels = wheels_from_twist(base(), 1.3, {0.5, 0}, 1);
  EXPECT_DOUBLE_EQ(wheels.left_radps, 2.5);
  EXPECT_DOUBLE_EQ(wheels.right_radps, 2.5);
}

TEST(SkidSteer, TurnsCounterClockwiseByFasterRightWheels) {
  const WheelSpeeds wheels = wheels_from_twist(base(), 1, {0, 1}, 1);
  EXPECT_DOUBLE_EQ(wheels.right_radps, 1.5);
  EXPECT_DOUBLE_EQ(wheels.left_radps, -1.5);
}

TEST(SkidSteer, AsksMoreOfTheWheelsWhenTheySkid) {
  EXPECT_DOUBLE_EQ(wheels_from_twist(base(), 1.5, {0, 1}, 1).right_radps, 2.25);
}

TEST(SkidSteer, KeepsTheCurvatureWhenAWheelWouldBeTooFast) {
  const Twist wanted{1.0, 1.0};
  const WheelSpeeds wheels = wheels_from_twist(base(), 1.2, wanted, 0.68);
  EXPECT_NEAR(wheels.right_radps * 0.2, 0.68, 1e-12);
  const Twist got = twist_from_wheels(base(), 1.2, wheels.left_radps * 0.2, 0.68);
  EXPECT_NEAR(got.wz_radps / got.vx_mps, 1.0, 1e-12);
}

TEST(SkidSteer, LimitsTheSlowerSideInReverseToo) {
  const WheelSpeeds wheels = wheels_from_twist(base(), 1, {-1.0, 1.0}, 0.65);
  EXPECT_NEAR(wheels.left_radps * 0.2, -0.65, 1e-12);
}

TEST(SkidSteer, FindsTheTwistOfItsOwnWheelSpeeds) {
  const WheelSpeeds wheels = wheels_from_twist(base(), 1.4, {0.3, -0.7}, 2);
  const Twist twist =
      twist_from_wheels(base(), 1.4, wheels.left_radps * 0.2, wheels.right_radps * 0.2);
  EXPECT_NEAR(twist.vx_mps, 0.3, 1e-12);
  EXPECT_NEAR(twist.wz_radps, -0.7, 1e-12);
}

}  // namespace
}  // namespace drover::engine
