// The engine with a base that takes a twist and tells one: no joints, and the same watches.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>

#include "engine_twist_fixture.h"

namespace drover::engine {
namespace {

using ::testing::HasSubstr;

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

/// Nobody fed it while the computer was paused, and it came to rest by itself.
TEST_F(ABaseThatTakesATwist, WhichStoppedWhileDroverdStoodStillIsNotMovedByTheRampToRest) {
  drive();
  rig.blocked = true;
  rig.run_s(0.6);
  rig.blocked = false;
  ASSERT_LT(std::abs(rig.snapshot().pose.vx_mps), 0.01);
  ASSERT_GT(rig.out.base.twist.vx_mps, 0.4) << "a ramp from there would move it";
  rig.environment.slept = "droverd stood still for 1.00 s, and nobody steered meanwhile";
  for (int i = 0; i < 200; ++i) {
    rig.tick();
    EXPECT_LT(std::abs(rig.out.base.twist.vx_mps), 0.02) << i;
  }
  rig.environment.slept.clear();
  rig.run_s(1);
  EXPECT_TRUE(at_rest());
  EXPECT_EQ(rig.snapshot().nav.status, NavStatus::error);
}

/// And what rolls on comes to rest by a ramp.
TEST_F(ABaseThatTakesATwist, WhichRollsOnWhileDroverdStoodStillIsBroughtToRestByARamp) {
  drive();
  rig.environment.slept = "droverd stood still for 0.31 s, and nobody steered meanwhile";
  rig.tick();
  rig.tick();
  EXPECT_GT(rig.out.base.twist.vx_mps, 0.4);
  rig.run_s(1);
  EXPECT_TRUE(at_rest());
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
  ASSERT_THAT(told(), HasSubstr("moves without a command: the base is silent"));
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

/// Who presses again and again must not keep it going.
TEST_F(ABaseThatTakesATwist, LosesItsPowerWhenItCreepsOnHoweverOftenAPersonStopsIt) {
  drive();
  rig.command(CancelTask{});
  rig.disobeys = WheelSpeeds{0.17, 0.17};  // 0.028 m/s
  for (int i = 0; i < 8; ++i) {
    rig.command(EngageStop{});
    rig.run_s(1);
  }
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

/// It no longer hears, and the program that drove it was killed.
TEST_F(ABaseThatTakesATwist, LosesItsPowerWhenItIsFoundDrivingOn) {
  rig.environment.relay_found_closed = true;
  rig.drives[0].state = AxisState::running;
  rig.disobeys = WheelSpeeds{1.5, 1.5};
  rig.run_s(0.5);
  ASSERT_TRUE(has_power()) << rig.why();
  rig.run_s(3.5);
  EXPECT_THAT(rig.why(), HasSubstr("did not stop"));
  EXPECT_FALSE(has_power()) << rig.why();
}

/// It did not hear its last zero, and that was too slow for anything else that watches.
TEST_F(ABaseThatTakesATwist, LosesItsPowerWhenItIsFoundCreepingOn) {
  rig.imu = rig.environment.relay_found_closed = true;
  rig.drives[0].state = AxisState::running;
  rig.disobeys = WheelSpeeds{0.25, 0.25};  // 0.04 m/s
  rig.run_s(1);
  ASSERT_TRUE(has_power()) << rig.why();
  rig.run_s(4);
  EXPECT_THAT(rig.why(), HasSubstr("did not stop"));
  EXPECT_FALSE(has_power()) << rig.why();
}

/// It may have wheels, but nobody here knows of them.
TEST_F(ABaseThatTakesATwist, IsSaidToBeComparedItselfOnItsFirstWay) {
  rig.config.navigate.first_way_m = 0.3;
  rig.engine = std::make_unique<Engine>(rig.config);
  rig.settle();
  rig.start(path, path_end, 0.5);
  rig.run_s(3);
  EXPECT_THAT(rig.why(), HasSubstr("slowly: the base, gyro and receiver are compared"));
}

/// A stop that it did not hear is no stop yet, whoever wants to end it.
TEST_F(ABaseThatTakesATwist, IsNotResetWhileItDrivesOnThoughAPersonStoppedIt) {
  drive();
  rig.disobeys = WheelSpeeds{1.5, 1.5};
  rig.command(EngageStop{});
  rig.run_s(0.2);
  ASSERT_TRUE(has_power());
  rig.engine->on_command({{RequestId::Source::cli, 99}, rig.now, ResetStop{}}, rig.now);
  rig.tick();
  EXPECT_TRUE(rig.snapshot().stop_latched);
  ASSERT_FALSE(rig.said<CommandRefused>().empty());
  EXPECT_EQ(rig.said<CommandRefused>().back().reason, "the robot still moves");
  rig.run_s(3);
  EXPECT_FALSE(has_power()) << "and it is cut as ever";
}

/// A person pushes it meanwhile.
TEST_F(ABaseThatTakesATwist, KeepsItsPowerWhenItIsFoundMovingAndWasKnownToRest) {
  rig.environment.relay_found_closed = rig.environment.drives_on_in_silence = true;
  Remembered held;
  held.holding = held.at_rest = true;
  rig.engine->recall(held, rig.now);
  rig.drives[0].state = AxisState::running;
  rig.drives[0].silent = true;  // not heard yet
  rig.disobeys = WheelSpeeds{1.5, 1.5};
  rig.run_s(0.3);
  rig.drives[0].silent = false;
  rig.run_s(4);
  EXPECT_TRUE(has_power()) << rig.why();
}

/// The program that begins while somebody pushes must not take him for the one before it.
TEST_F(ABaseThatTakesATwist, IsRememberedAtRestWhileAPersonPushesItButNotWhileItDrives) {
  drive();
  EXPECT_FALSE(rig.out.remembered.at_rest);
  rig.command(CancelTask{});
  rig.run_s(4);
  ASSERT_TRUE(rig.out.remembered.at_rest);
  rig.disobeys = WheelSpeeds{1.5, 1.5};
  rig.run_s(2);
  EXPECT_THAT(told(), HasSubstr("without a command"));
  EXPECT_TRUE(rig.out.remembered.at_rest);
}

/// A guard slows it down meanwhile.
TEST_F(ABaseThatTakesATwist, KeepsItsPowerWhenItIsFoundSlowingDown) {
  rig.environment.relay_found_closed = true;
  rig.drives[0].state = AxisState::running;
  rig.guard_has_bus = rig.drives[0].silent = true;
  rig.disobeys = WheelSpeeds{4, 4};
  rig.run_s(1);  // it has that speed when it is heard
  rig.drives[0].silent = false;
  for (int i = 0; i < 26; ++i) {  // for longer than what gets no slower is given
    rig.disobeys = WheelSpeeds{4 - 0.15 * i, 4 - 0.15 * i};
    rig.run_s(0.05);
  }
  rig.guard_has_bus = false;
  rig.disobeys.reset();
  rig.run_s(5);
  EXPECT_TRUE(has_power()) << rig.why();
}

TEST_F(ABaseThatTakesATwist, IsNotReleasedWhileItCreepsOn) {
  drive();
  rig.command(CancelTask{});
  rig.run_s(2);
  rig.disobeys = WheelSpeeds{0.27, 0.27};  // 0.045 m/s
  rig.run_s(0.2);
  rig.command(ReleaseHold{});
  rig.tick();
  EXPECT_NE(rig.snapshot().hold, HoldState::released);
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

}  // namespace
}  // namespace drover::engine
