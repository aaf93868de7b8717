// Where it could roll: what takes the power from a base that takes a twist, and what must not.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "engine_twist_fixture.h"

namespace drover::engine {
namespace {

using ::testing::HasSubstr;

TEST_F(ABaseThatTakesATwistOnASlope, LosesItsPowerWhenItDrivesOn) {
  drive();
  tilt();
  for (int i = 0; i < 2000 && rig.snapshot().nav.status != NavStatus::error; ++i) rig.tick();
  ASSERT_THAT(rig.why(), HasSubstr("the ground falls by"));
  rig.disobeys = WheelSpeeds{0.5, 0.5};
  for (int i = 0; i < 400 && rig.out.base.request != AxisRequest::idle; ++i) rig.tick();
  EXPECT_EQ(rig.out.base.request, AxisRequest::idle);
  EXPECT_THAT(rig.why(), HasSubstr("did not stop: the base says"));
}

TEST_F(ABaseThatTakesATwistOnASlope, KeepsItsPowerWhenItBrakesAndCreeps) {
  rig.environment.stop_creeps = true;
  drive();
  go_over_the_edge();
  rig.run_s(0.7);
  rig.disobeys = WheelSpeeds{0.6, 0.6};  // 0.1 m/s
  rig.run_s(20);
  EXPECT_TRUE(has_power()) << rig.why();
  EXPECT_THAT(told(), HasSubstr("moves without a command"));
}

TEST_F(ABaseThatTakesATwistOnASlope, LosesItsPowerWhenItDoesNotBrake) {
  rig.environment.stop_creeps = true;
  drive();
  go_over_the_edge();
  rig.run_s(0.2);
  rig.disobeys = WheelSpeeds{2, 2};  // 0.33 m/s
  rig.run_s(4);
  EXPECT_FALSE(has_power()) << rig.why();
}

TEST_F(ABaseThatTakesATwistOnASlope, KeepsItsPowerWhenItsSpeedIsFrozenAndItIsSeenToStand) {
  rig.tells_speed = true;
  drive();
  tilt();
  rig.run_s(0.1);
  rig.disobeys = WheelSpeeds{0, 0};
  rig.tells_mps = 0.5;
  rig.run_s(10);
  EXPECT_TRUE(has_power()) << rig.why();
}

/// Its own button let it roll, and was let go: it brakes from then on.
TEST_F(ABaseThatTakesATwistOnASlope, KeepsItsPowerWhenItRolledWithoutADriveAndBrakesNow) {
  rig.tells_speed = true;
  drive();
  tilt();
  rig.run_s(0.1);
  rig.drives[0].fault = true;
  rig.drives[0].state = AxisState::fault;
  rig.disobeys = WheelSpeeds{6, 6};
  rig.run_s(1.5);
  rig.drives[0].fault = false;
  rig.drives[0].state = AxisState::running;
  rig.run_s(0.3);
  rig.disobeys.reset();
  rig.run_s(5);
  EXPECT_TRUE(has_power()) << rig.why();
}

/// Slower than half of what it was driven with; but nothing creeps up.
TEST_F(ABaseThatTakesATwistOnASlope, LosesItsPowerWhenItGoesUpThoughItOnlyBrakes) {
  rig.environment.stop_creeps = true;
  drive();
  tilt();
  rig.run_s(0.3);
  rig.disobeys = WheelSpeeds{1.4, 1.4};  // 0.23 m/s
  rig.run_s(4);
  EXPECT_FALSE(has_power()) << rig.why();
}

/// It no longer hears, in the last centimetres.
TEST_F(ABaseThatTakesATwistOnASlope, LosesItsPowerWhenItCreepsUp) {
  rig.environment.stop_creeps = rig.tells_speed = true;
  drive();
  tilt();
  rig.run_s(0.6);
  rig.disobeys = WheelSpeeds{0.27, 0.27};  // 0.045 m/s
  rig.run_s(10);
  EXPECT_FALSE(has_power()) << rig.why();
}

TEST_F(ABaseThatTakesATwistOnASlope, KeepsItsPowerWhenItCreepsAsFastAsItWasDriven) {
  rig.environment.stop_creeps = rig.tells_speed = true;
  rig.settle();
  rig.start(path, path_end, 0.1);
  rig.run_s(6);
  tilt_down();
  rig.disobeys = WheelSpeeds{0.5, 0.5};  // 0.08 m/s
  rig.run_s(10);
  EXPECT_TRUE(has_power()) << rig.why();
}

/// It was cut once, for two statements of one device.
TEST_F(ABaseThatTakesATwistOnASlope, KeepsItsPowerWhenItsReceiverAloneGoesAstray) {
  rig.tells_speed = true;
  drive();
  tilt_down();
  rig.run_s(5);
  rig.jump_m = 3;
  rig.speed_noise_mps = 0.8;
  rig.run_s(3);
  rig.command(EngageStop{});
  for (int i = 0; i < 100; ++i) {
    rig.jump_m += 0.1;  // and drifts
    rig.run_s(0.1);
  }
  EXPECT_TRUE(has_power()) << rig.why();
}

TEST_F(ABaseThatTakesATwistOnASlope, KeepsItsPowerWhenItsReceiverGoesAstrayWhileItDrives) {
  rig.tells_speed = true;
  drive();
  tilt_down();
  rig.speed_noise_mps = 0.8;
  for (int i = 0; i < 100; ++i) {
    rig.jump_m += 0.08;
    rig.run_s(0.1);
  }
  EXPECT_TRUE(has_power()) << rig.why();
}

/// Its encoder is frozen, and the receiver tells of it with one voice.
TEST_F(ABaseThatTakesATwistOnASlope, LosesItsPowerWhenItIsSeenToDriveOn) {
  rig.tells_speed = true;
  drive();
  tilt_down();
  rig.run_s(0.1);
  rig.drives[0].stuck = true;
  rig.disobeys = WheelSpeeds{2.5, 2.5};
  rig.run_s(5);
  EXPECT_FALSE(has_power()) << rig.why();
}

/// Softer than others: told zero on its way up, it creeps back.
TEST_F(ABaseThatTakesATwistOnASlope, KeepsItsPowerWhenItCreepsBackDown) {
  rig.environment.stop_creeps = rig.tells_speed = true;
  drive();
  tilt();
  rig.run_s(0.7);
  rig.disobeys = WheelSpeeds{-0.2, -0.2};  // 0.033 m/s
  rig.run_s(15);
  EXPECT_TRUE(has_power()) << rig.why();
}

/// It no longer hears; the ground falls to its side.
TEST_F(ABaseThatTakesATwistOnASlope, LosesItsPowerWhenItCreepsAcross) {
  rig.environment.stop_creeps = rig.tells_speed = true;
  drive();
  rig.gravity_mps2 = {0, 9.81 * std::sin(to_rad(8)), 9.81 * std::cos(to_rad(8))};
  rig.run_s(0.7);
  rig.disobeys = WheelSpeeds{0.21, 0.21};  // 0.035 m/s
  rig.run_s(12);
  EXPECT_FALSE(has_power()) << rig.why();
}

/// As it tells: that is no jump, and the next start is taken.
TEST_F(ABaseThatTakesATwistOnASlope, IsStartedAgainAfterItCreptForAWhile) {
  rig.environment.stop_creeps = rig.tells_speed = true;
  drive();
  rig.command(CancelTask{});
  rises_by(2.5);
  rig.run_s(1);
  rig.disobeys = WheelSpeeds{-0.08, -0.08};  // 0.013 m/s
  rig.run_s(30);
  rig.disobeys.reset();
  rig.start(path, path_end, 0.5);
  rig.run_s(2);
  EXPECT_EQ(rig.snapshot().nav.status, NavStatus::run) << rig.why();
}

/// Just before it reached the edge.
TEST_F(ABaseThatTakesATwistOnASlope, KeepsItsPowerWhenItCreepsAndItsImuFellSilent) {
  rig.environment.stop_creeps = rig.tells_speed = true;
  drive();
  rig.imu = false;
  rig.environment.imu[0].state = SourceState::stale;
  rig.run_s(1.6);
  rig.disobeys = WheelSpeeds{0.5, 0.5};  // 0.08 m/s
  rig.run_s(10);
  EXPECT_TRUE(has_power()) << rig.why();
}

/// Nobody drove it: a person's stop must not let it go.
TEST_F(ABaseThatTakesATwistOnASlope, KeepsItsPowerWhenItSlipsDownAndAPersonStopsIt) {
  rig.settle();
  go_over_the_edge();
  rig.drives[0].state = AxisState::running;
  rig.disobeys = WheelSpeeds{1, 1};
  rig.run_s(1);
  rig.command(EngageStop{});
  rig.run_s(4);
  EXPECT_TRUE(has_power()) << told();
}

}  // namespace
}  // namespace drover::engine
