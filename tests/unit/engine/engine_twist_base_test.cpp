// The engine with a base that takes a twist and tells one: no joints, and the same watches.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <string>

#include "engine_rig.h"

namespace drover::engine {
namespace {

using ::testing::HasSubstr;

EngineConfig twist_config() {
  EngineConfig config = rig_config();
  config.joints.clear();
  config.base.kind = BaseKind::twist;
  config.base.left.clear();
  config.base.right.clear();
  return config;
}

class ABaseThatTakesATwist : public ::testing::Test {
 protected:
  explicit ABaseThatTakesATwist(const EngineConfig& config = twist_config()) : rig(config) {}
  void drive() {
    rig.settle();
    rig.start(path, path_end, 0.5);
    rig.run_s(4);
    ASSERT_EQ(rig.snapshot().nav.status, NavStatus::run) << rig.why();
    ASSERT_GT(rig.out.base.twist.vx_mps, 0.4);
    ASSERT_TRUE(rig.out.motion_permitted);
  }
  bool has_power() const { return rig.out.outputs[static_cast<std::size_t>(Output::enable_relay)]; }
  bool at_rest() const {
    return rig.out.base.twist.vx_mps == 0 && rig.out.base.twist.wz_radps == 0;
  }

  std::string told() const {
    std::string all;
    for (const Reason& why : rig.snapshot().why) all += std::string(why.view()) + "; ";
    return all;
  }

  Path path = straight_path(6);
  std::uint32_t path_end = 12;
  EngineRig rig;
};

TEST_F(ABaseThatTakesATwist, DrivesATrackToItsEnd) {
  drive();
  for (int i = 0; i < 30 && rig.snapshot().nav.status == NavStatus::run; ++i) rig.run_s(1);
  EXPECT_EQ(rig.snapshot().nav.status, NavStatus::success) << rig.why();
  EXPECT_NEAR(rig.plant.truth().x_m, 6, 0.15);
  EXPECT_NEAR(rig.plant.truth().y_m, 0, 0.1);
}

TEST_F(ABaseThatTakesATwist, ShowsAndCommandsNoJoint) {
  drive();
  EXPECT_TRUE(rig.snapshot().axes.empty());
  EXPECT_NEAR(rig.snapshot().pose.vx_mps, 0.5, 0.1);
  for (const AxisCommand& axis : rig.out.axes) {
    EXPECT_EQ(axis.request, AxisRequest::rest);
    EXPECT_EQ(axis.velocity_radps, 0);
  }
}

TEST_F(ABaseThatTakesATwist, StandsAtOnceWhenItsDeviceIsSilent) {
  drive();
  rig.drives[0].silent = true;
  rig.tick();
  EXPECT_TRUE(at_rest());
  EXPECT_FALSE(rig.out.motion_permitted);
  EXPECT_THAT(rig.why(), HasSubstr("the base: no feedback"));
}

TEST_F(ABaseThatTakesATwist, StandsAtOnceWhenItsDeviceHasAFault) {
  drive();
  rig.drives[0].fault = true;
  rig.run_s(0.02);
  EXPECT_TRUE(at_rest());
  EXPECT_THAT(rig.why(), HasSubstr("over temperature"));
}

TEST_F(ABaseThatTakesATwist, IsFoundBlocked) {
  drive();
  rig.blocked = true;
  rig.run_s(4);
  EXPECT_TRUE(at_rest());
  EXPECT_EQ(rig.snapshot().nav.status, NavStatus::error);
  EXPECT_THAT(rig.why(), HasSubstr("blocked"));
}

TEST_F(ABaseThatTakesATwist, IsFoundRunningAway) {
  drive();
  rig.disobeys = WheelSpeeds{15, 15};
  rig.run_s(0.4);
  EXPECT_TRUE(at_rest());
  EXPECT_THAT(rig.why(), HasSubstr("the base runs away"));
  EXPECT_THAT(rig.why(), HasSubstr("m/s"));
}

TEST_F(ABaseThatTakesATwist, LosesItsPowerWhenItDoesNotStop) {
  drive();
  rig.command(CancelTask{});
  rig.disobeys = WheelSpeeds{2, 2};
  rig.run_s(3);
  EXPECT_EQ(rig.out.base.request, AxisRequest::idle);
  EXPECT_FALSE(has_power());
}

/// Its cable is torn, and it keeps its last twist: nobody reaches it, and it tells nothing.
TEST_F(ABaseThatTakesATwist, LosesItsPowerWhenItFallsSilentAndDrivesOn) {
  rig.environment.drives_on_in_silence = true;
  drive();
  rig.drives[0].silent = true;
  rig.disobeys = WheelSpeeds{2, 2};
  rig.run_s(4);
  EXPECT_FALSE(has_power());
}

/// No witness sees it, and a slow motion none would.
TEST_F(ABaseThatTakesATwist, LosesItsPowerWhenItFallsSilentWhileItMovesThoughNobodySeesIt) {
  rig.environment.drives_on_in_silence = true;
  drive();
  rig.drives[0].silent = true;
  rig.run_s(4);
  EXPECT_FALSE(has_power());
}

TEST_F(ABaseThatTakesATwist, KeepsItsPowerWhenItFallsSilentAtRestUntilAPersonStopsIt) {
  rig.environment.drives_on_in_silence = true;
  drive();
  rig.command(CancelTask{});
  rig.run_s(4);
  rig.drives[0].silent = true;
  rig.run_s(10);
  EXPECT_TRUE(has_power());
  rig.command(EngageStop{});
  rig.run_s(3);
  EXPECT_FALSE(has_power());
}

/// The witnesses say so before anybody presses the stop.
TEST_F(ABaseThatTakesATwist, LosesItsPowerWhenAPersonStopsItWhileItDrivesByItselfAndIsSilent) {
  rig.environment.drives_on_in_silence = rig.tells_speed = true;
  drive();
  rig.command(CancelTask{});
  rig.run_s(4);
  rig.drives[0].silent = true;
  rig.run_s(1);
  rig.disobeys = WheelSpeeds{2, 2};
  rig.run_s(3);
  ASSERT_THAT(told(), HasSubstr("pushed or carried"));
  ASSERT_TRUE(has_power());
  rig.command(EngageStop{});
  rig.run_s(3);
  EXPECT_FALSE(has_power());
}

TEST_F(ABaseThatTakesATwist, IsNotCutWhenItIsCarriedAfterAMomentOfSilence) {
  rig.environment.drives_on_in_silence = rig.tells_speed = true;
  drive();
  rig.command(CancelTask{});
  rig.run_s(4);
  rig.drives[0].silent = true;
  rig.run_s(0.2);
  rig.drives[0].silent = false;
  rig.run_s(2);
  rig.disobeys = WheelSpeeds{15, 15};  // 2.5 m/s
  rig.drives[0].stuck = true;
  rig.run_s(3);
  EXPECT_THAT(told(), HasSubstr("pushed or carried"));
  EXPECT_TRUE(has_power());
}

/// It hears no more, in the last centimetres before a goal.
TEST_F(ABaseThatTakesATwist, LosesItsPowerWhenItCreepsOnThoughItShouldStand) {
  drive();
  rig.command(CancelTask{});
  rig.disobeys = WheelSpeeds{0.25, 0.25};  // 0.04 m/s
  rig.run_s(8);
  EXPECT_THAT(rig.why(), HasSubstr("did not stop"));
  EXPECT_FALSE(has_power());
}

/// It was without power: its last command is forgotten, and it takes a while to begin.
TEST_F(ABaseThatTakesATwist, HasItsPowerAgainAfterAResetThoughItIsStillSilent) {
  rig.environment.drives_on_in_silence = true;
  drive();
  rig.drives[0].silent = true;
  rig.run_s(6);
  ASSERT_FALSE(has_power());
  rig.engine->on_command({{RequestId::Source::cli, 99}, rig.now, ResetStop{}}, rig.now);
  rig.run_s(5);
  EXPECT_TRUE(has_power()) << rig.why();
}

/// This program has just begun: nobody knows what the one before it asked for.
TEST_F(ABaseThatTakesATwist, LosesItsPowerWhenItIsFoundSilentAndMoving) {
  rig.environment.drives_on_in_silence = rig.environment.relay_found_closed = true;
  rig.imu = rig.tells_speed = true;
  rig.drives[0].silent = true;
  rig.disobeys = WheelSpeeds{2, 2};
  rig.run_s(5);
  EXPECT_THAT(told(), HasSubstr("the robot did not stop: the base is silent"));
  EXPECT_FALSE(has_power());
}

/// Slow, and no fix: nobody sees it move.
TEST_F(ABaseThatTakesATwist, LosesItsPowerWhenItIsFoundSilentWithARelayThatWasKeptClosed) {
  rig.environment.drives_on_in_silence = rig.environment.relay_found_closed = true;
  rig.environment.lines[static_cast<std::size_t>(Line::estop)] = {};  // not heard yet
  rig.drives[0].silent = true;
  rig.run_s(0.1);
  rig.environment.lines[static_cast<std::size_t>(Line::estop)].state = SourceState::fresh;
  rig.run_s(5);
  EXPECT_FALSE(has_power());
}

TEST_F(ABaseThatTakesATwist, LosesItsPowerWhenItDrivesOnThoughItsContactFlickers) {
  rig.environment.drives_on_in_silence = true;
  drive();
  rig.command(CancelTask{});
  rig.disobeys = WheelSpeeds{3, 3};
  for (int i = 0; i < 6; ++i) {
    rig.drives[0].silent = i % 2 == 0;
    rig.run_s(0.5);
  }
  EXPECT_FALSE(has_power());
}

TEST_F(ABaseThatTakesATwist, IsHeldAgainAfterADipOfItsSupply) {
  drive();
  rig.command(CancelTask{});
  rig.run_s(3);
  ASSERT_EQ(rig.snapshot().hold, HoldState::held);
  rig.drives[0].state = AxisState::idle;
  rig.run_s(0.02);
  EXPECT_EQ(rig.out.base.request, AxisRequest::hold);
  EXPECT_TRUE(at_rest());
  rig.run_s(1);
  EXPECT_EQ(rig.snapshot().hold, HoldState::held);
}

TEST_F(ABaseThatTakesATwist, IsLetGoWhenAPersonReleasesIt) {
  drive();
  rig.command(CancelTask{});
  rig.run_s(3);
  rig.command(ReleaseHold{.on_slope = true});
  rig.run_s(0.1);
  EXPECT_EQ(rig.out.base.request, AxisRequest::idle);
  // Some chassis only stand at zero then: it is not said that it can be pushed.
  EXPECT_THAT(std::string(rig.said<CommandAccepted>().back().note.view()),
              ::testing::AllOf(HasSubstr("nothing is commanded any more, and it can roll"),
                               ::testing::Not(HasSubstr("let go: "))));
}

/// Nothing but its device holds it.
class ABaseThatTakesATwistOnASlope : public ABaseThatTakesATwist {
 protected:
  ABaseThatTakesATwistOnASlope() : ABaseThatTakesATwist(held_by_its_device()) { rig.imu = true; }
  void tilt() { rig.gravity_mps2 = {9.81 * std::sin(to_rad(8)), 0, 9.81 * std::cos(to_rad(8))}; }

 private:
  static EngineConfig held_by_its_device() {
    EngineConfig config = twist_config();
    config.base.hold = HoldBy::level_ground_only;
    return config;
  }
};

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

TEST_F(ABaseThatTakesATwistOnASlope, KeepsItsPowerWhenItBrakesAndCreeps) {
  rig.environment.stop_creeps = true;
  drive();
  tilt();
  rig.run_s(0.8);
  rig.disobeys = WheelSpeeds{0.6, 0.6};  // 0.1 m/s
  rig.run_s(20);
  EXPECT_TRUE(has_power()) << rig.why();
  EXPECT_THAT(told(), HasSubstr("moves without a command"));
}

TEST_F(ABaseThatTakesATwistOnASlope, LosesItsPowerWhenItDoesNotBrake) {
  rig.environment.stop_creeps = true;
  drive();
  tilt();
  rig.run_s(0.3);
  rig.disobeys = WheelSpeeds{2, 2};
  rig.run_s(4);
  EXPECT_FALSE(has_power()) << rig.why();
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
  tilt();
  rig.run_s(0.2);
  rig.drives[0].silent = true;
  rig.disobeys = WheelSpeeds{7, 7};  // 1.2 m/s
  rig.run_s(7);
  EXPECT_TRUE(has_power()) << rig.why();
  rig.run_s(6);
  EXPECT_FALSE(has_power()) << "nobody will catch it any more";
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

}  // namespace
}  // namespace drover::engine
