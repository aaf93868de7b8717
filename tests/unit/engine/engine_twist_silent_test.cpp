// The same as in engine_twist_slope_test.cpp, of a base of which nothing is heard, or was not.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "engine_twist_fixture.h"

namespace drover::engine {
namespace {

using ::testing::HasSubstr;

/// Its supply is away for longer than a witness needs, and it rolls: it is heard again, and brakes.
TEST_F(ABaseThatTakesATwistOnASlope, KeepsItsPowerWhenItIsSilentUntilItHasItsSupplyAgain) {
  rig.environment.drives_on_in_silence = true;
  rig.tells_speed = true;
  drive();
  tilt();
  rig.run_s(0.5);
  rig.drives[0].silent = true;
  rig.disobeys = WheelSpeeds{4, 4};  // 0.66 m/s
  rig.run_s(1.6);
  rig.drives[0].silent = false;
  rig.drives[0].state = AxisState::idle;
  rig.run_s(0.5);
  rig.disobeys.reset();
  rig.run_s(5);
  EXPECT_TRUE(has_power()) << rig.why();
}

/// Only its own brake holds it there: a stop must not set in motion what stands.
TEST_F(ABaseThatTakesATwistOnASlope, KeepsItsPowerWhenItFallsSilentAtRestAndAPersonStopsIt) {
  rig.environment.drives_on_in_silence = rig.tells_speed = true;
  drive();
  tilt();
  rig.run_s(5);
  rig.drives[0].silent = true;
  rig.run_s(3);
  rig.command(EngageStop{});
  rig.run_s(10);
  EXPECT_TRUE(has_power()) << rig.why();
  rig.disobeys = WheelSpeeds{3, 3};
  rig.run_s(6);
  EXPECT_FALSE(has_power()) << "it stood, and drives now";
}

/// It hears and brakes, and only its answers are lost: the receiver sees that it stands.
TEST_F(ABaseThatTakesATwistOnASlope, KeepsItsPowerWhenItFallsSilentAndIsSeenToStand) {
  rig.environment.drives_on_in_silence = rig.tells_speed = true;
  drive();
  tilt();
  rig.run_s(0.2);
  rig.drives[0].silent = true;
  rig.run_s(20);
  EXPECT_TRUE(has_power()) << rig.why();
}

TEST_F(ABaseThatTakesATwistOnASlope, LosesItsPowerWhenItFallsSilentAndDrivesOn) {
  rig.environment.drives_on_in_silence = rig.tells_speed = true;
  drive();
  tilt();
  rig.run_s(0.2);
  rig.drives[0].silent = true;
  rig.disobeys = WheelSpeeds{0.6, 0.6};  // 0.1 m/s
  rig.run_s(5);
  EXPECT_FALSE(has_power()) << rig.why();
}

/// Its computer begins again, which may take longer than a second or two: it rolls meanwhile.
TEST_F(ABaseThatTakesATwistOnASlope, KeepsItsPowerForTenSecondsWhileItIsSilentAndRolls) {
  rig.environment.drives_on_in_silence = rig.tells_speed = true;
  drive();
  tilt_down();
  rig.run_s(0.2);
  rig.drives[0].silent = true;
  rig.disobeys = WheelSpeeds{7, 7};  // 1.2 m/s
  rig.run_s(7);
  EXPECT_TRUE(has_power()) << rig.why();
  rig.run_s(6);
  EXPECT_FALSE(has_power()) << "nobody will catch it any more";
}

/// Both programs were away, and the relay with them: what is silent has yet to begin.
TEST_F(ABaseThatTakesATwistOnASlope, KeepsItsPowerWhileItBeginsAfterARestart) {
  rig.environment.drives_on_in_silence = true;
  rig.tells_speed = true;
  tilt();
  rig.drives[0].silent = true;
  rig.disobeys = WheelSpeeds{-4, -4};
  rig.run_s(4);
  EXPECT_TRUE(has_power()) << rig.why();
}

/// The receiver sees it stand, and then an everyday thing happens to the receiver.
TEST_F(ABaseThatTakesATwistOnASlope, KeepsItsPowerWhenItStoodInSilenceAndNobodySeesItAnyMore) {
  rig.environment.drives_on_in_silence = rig.tells_speed = true;
  drive();
  tilt_down();
  rig.run_s(0.2);
  rig.drives[0].silent = true;
  rig.run_s(8);
  ASSERT_TRUE(has_power()) << rig.why();
  rig.quality = FixQuality::rtk_float;
  rig.run_s(20);
  EXPECT_TRUE(has_power()) << rig.why();
  rig.command(EngageStop{});
  rig.run_s(10);
  EXPECT_TRUE(has_power()) << rig.why();
}

/// As it is driven on its first way: five centimetres in a second pass for standing, at first.
TEST_F(ABaseThatTakesATwistOnASlope, LosesItsPowerWhenItIsSilentAndGoesAsSlowlyAsItMay) {
  rig.environment.drives_on_in_silence = rig.tells_speed = true;
  rig.settle();
  rig.start(path, path_end, 0.1);
  rig.run_s(6);
  tilt();
  rig.run_s(0.2);
  rig.drives[0].silent = true;
  rig.disobeys = WheelSpeeds{0.29, 0.29};  // 0.048 m/s
  rig.run_s(12);
  EXPECT_FALSE(has_power()) << rig.why();
}

/// A daemon was killed, and its guard kept the relay: nobody knows how fast it was driven.
TEST_F(ABaseThatTakesATwistOnASlope, LosesItsPowerWhenItIsFoundSilentAndGoesUp) {
  rig.environment.drives_on_in_silence = rig.environment.relay_found_closed = true;
  rig.tells_speed = true;
  tilt();
  rig.drives[0].silent = true;
  rig.disobeys = WheelSpeeds{3, 3};
  rig.run_s(1);
  ASSERT_TRUE(has_power()) << rig.why();
  rig.run_s(3);
  EXPECT_THAT(told(), HasSubstr("cannot be stopped"));
  EXPECT_FALSE(has_power()) << rig.why();
}

TEST_F(ABaseThatTakesATwistOnASlope, KeepsItsPowerAfterARestartWhenItWasKnownToRest) {
  rig.environment.drives_on_in_silence = rig.environment.relay_found_closed = true;
  rig.quality = FixQuality::rtk_float;
  Remembered held;
  held.holding = held.at_rest = true;
  rig.engine->recall(held, rig.now);
  tilt();
  rig.drives[0].silent = true;
  rig.run_s(10);
  EXPECT_TRUE(has_power()) << rig.why();
}

TEST_F(ABaseThatTakesATwistOnASlope, LosesItsPowerWhenItStoodInSilenceForSomebodyInItsWay) {
  rig.environment.drives_on_in_silence = rig.tells_speed = true;
  drive();
  tilt();
  rig.run_s(0.1);
  rig.drives[0].silent = true;
  rig.disobeys = WheelSpeeds{0, 0};
  rig.run_s(8);
  ASSERT_TRUE(has_power()) << rig.why();
  rig.disobeys = WheelSpeeds{3, 3};
  rig.run_s(5);
  EXPECT_FALSE(has_power()) << rig.why();
}

TEST_F(ABaseThatTakesATwistOnASlope, LosesItsPowerWhenItIsSilentAndGoesDownAsItWasDriven) {
  rig.environment.drives_on_in_silence = rig.environment.stop_creeps = rig.tells_speed = true;
  rig.settle();
  rig.start(path, path_end, 0.15);
  rig.run_s(6);
  tilt_down();
  rig.run_s(0.1);
  rig.drives[0].silent = true;
  rig.disobeys = WheelSpeeds{0.9, 0.9};  // 0.15 m/s
  rig.run_s(6);
  EXPECT_FALSE(has_power()) << rig.why();
}

TEST_F(ABaseThatTakesATwistOnASlope, KeepsItsPowerWhenItIsSilentAndCreepsDown) {
  rig.environment.drives_on_in_silence = rig.environment.stop_creeps = rig.tells_speed = true;
  drive();
  tilt_down();
  rig.run_s(0.5);
  rig.drives[0].silent = true;
  rig.disobeys = WheelSpeeds{0.5, 0.5};  // 0.08 m/s
  rig.speed_noise_mps = 0.15;
  rig.run_s(20);
  EXPECT_TRUE(has_power()) << rig.why();
}

/// Each later task of the same program, too.
TEST_F(ABaseThatTakesATwistOnASlope, KeepsItsPowerForTenSecondsThoughItsRelayWasFoundClosed) {
  rig.environment.relay_found_closed = true;
  rig.environment.drives_on_in_silence = true;
  rig.tells_speed = true;
  drive();
  tilt_down();
  rig.run_s(0.2);
  rig.drives[0].silent = true;
  rig.disobeys = WheelSpeeds{7, 7};  // 1.2 m/s
  rig.run_s(7);
  EXPECT_TRUE(has_power()) << rig.why();
}

TEST_F(ABaseThatTakesATwistOnASlope, RemembersThatItRestsButNotThatItIsHeldUp) {
  rig.environment.drives_on_in_silence = rig.tells_speed = true;
  drive();
  EXPECT_FALSE(rig.out.remembered.at_rest);
  tilt();
  rig.run_s(6);
  EXPECT_TRUE(rig.out.remembered.at_rest);
  rig.drives[0].silent = true;
  rig.run_s(8);
  EXPECT_TRUE(rig.out.remembered.at_rest) << "it rested when it fell silent";
}

TEST_F(ABaseThatTakesATwistOnASlope, IsNotRememberedAtRestWhenItFellSilentInMotion) {
  rig.environment.drives_on_in_silence = rig.tells_speed = true;
  drive();
  tilt();
  rig.run_s(0.1);
  rig.drives[0].silent = true;
  rig.disobeys = WheelSpeeds{0, 0};
  rig.run_s(8);
  ASSERT_TRUE(has_power()) << rig.why();
  EXPECT_FALSE(rig.out.remembered.at_rest);
}

}  // namespace
}  // namespace drover::engine
