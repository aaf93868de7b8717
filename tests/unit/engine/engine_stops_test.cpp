// What stops the robot, what lets it wait, and that nothing goes on by itself that should not.
#include <cmath>
#include <cstdio>

#include "engine_fixture.h"

namespace drover::engine {
namespace {

using ::testing::HasSubstr;

// --- stops ------------------------------------------------------------------------------------

TEST_F(AnEngine, IsAtZeroInTheCycleOfAnEstopAndStaysThereWhenItIsReleased) {
  drive();
  rig.lines[0] = true;
  expect_stopped_at_once("e-stop pressed");
  EXPECT_EQ(rig.snapshot().nav.owner, Owner::estop);
  rig.lines[0] = false;
  expect_no_motion_for_s(5);
  EXPECT_THAT(rig.why(), HasSubstr("stopped: e-stop pressed"));
  rig.start(path, 40, 0.5);
  rig.run_s(3);
  EXPECT_EQ(rig.said<NavigationStarted>().size(), 2U) << "only a new start moves it";
}
TEST_F(AnEngine, TakesAStartForNoneThatAStopCameAfter) {
  rig.settle();
  rig.command(StartTask{&path, 40, 0.5, true});
  rig.run_s(1);
  EXPECT_EQ(refusal(), "a stop came after it");
  EXPECT_EQ(rig.said<PathReleased>().size(), 1U);
  EXPECT_EQ(rig.fastest_command_radps(), 0);
}
/// A broker may hold a message back for so long unnoticed.
TEST_F(AnEngine, TakesAStartThatMayBeOlderThanTheEndOfAStopForNone) {
  rig.settle();
  rig.lines[1] = true;
  rig.run_s(0.1);
  rig.lines[1] = false;
  rig.run_s(0.4);
  rig.start(path, 40, 0.5);
  rig.run_s(1);
  EXPECT_THAT(refusal(), HasSubstr("this may be older; press again"));
  EXPECT_EQ(rig.fastest_command_radps(), 0);
  rig.start(path, 40, 0.5);
  rig.run_s(1);
  EXPECT_EQ(rig.said<NavigationStarted>().size(), 1U);
}
/// It waited until its track was looked along.
TEST_F(AnEngine, TakesAStartThatTheRobotWasStoppedAfterForNone) {
  rig.settle();
  const Time asked = rig.now;
  rig.lines[1] = true;
  rig.run_s(0.1);
  rig.lines[1] = false;
  rig.run_s(2);
  rig.engine->on_command({{RequestId::Source::cli, 77}, asked, StartTask{&path, 40, 0.5}}, rig.now);
  rig.run_s(1);
  EXPECT_EQ(refusal(), "the robot was stopped after this was asked for; press again");
  EXPECT_EQ(rig.fastest_command_radps(), 0);
}
/// A chassis tells of its own e-stop as of a fault.
TEST_F(AnEngine, TakesAStartThatMayBeOlderThanTheEndOfAFaultForNone) {
  rig.settle();
  for (auto& drive : rig.drives) drive.fault = true;
  rig.run_s(0.1);
  for (auto& drive : rig.drives) drive.fault = false;
  rig.run_s(0.2);
  rig.start(path, 40, 0.5);
  rig.run_s(1);
  EXPECT_THAT(refusal(), HasSubstr("this may be older; press again"));
  EXPECT_EQ(rig.fastest_command_radps(), 0);
}
TEST_F(AnEngine, SaysAfterAResetThatItWaitsForANewStart) {
  drive();
  rig.command(EngageStop{});
  rig.run_s(1);
  EXPECT_EQ(rig.why(), "stopped: emergency stop of an operator");
  rig.command(ResetStop{});
  rig.tick();
  ASSERT_EQ(rig.snapshot().nav.status, NavStatus::error);
  EXPECT_FALSE(rig.snapshot().stop_latched);
  EXPECT_EQ(rig.why(), "waits for a new start; the task ended: emergency stop of an operator");
  rig.start(path, 40, 0.5);
  rig.run_s(1);
  EXPECT_EQ(rig.why(), "");
  rig.command(CancelTask{});
  rig.run_s(1);
  EXPECT_EQ(rig.why(), "") << "cancelled, it waits for nothing";
}
TEST_F(AnEngine, DoesNotMissAnEstopThatWasPressedForAnInstant) {
  drive();
  Measurement edge;
  edge.time = edge.received = rig.now;
  edge.value = LineState{Line::estop, true};
  rig.engine->on_measurement(edge);
  expect_stopped_at_once("e-stop pressed");
}
TEST_F(AnEngine, StopsAtOnceWhenASafetyLineIsLost) {
  drive();
  rig.line_lost[0] = true;
  expect_stopped_at_once("line e-stop");
}
TEST_F(AnEngine, StopsWithARampAndTakesNoStartWhileAPartOfTheDaemonHangs) {
  drive();
  rig.environment.program = "droverd's publish thread stands still";
  rig.tick();
  EXPECT_GT(rig.fastest_command_radps(), 0) << "a ramp, no jolt";
  rig.run_s(2);
  EXPECT_EQ(rig.fastest_command_radps(), 0);
  EXPECT_EQ(rig.snapshot().nav.status, NavStatus::error);
  EXPECT_THAT(rig.why(), HasSubstr("droverd's publish thread stands still"));
  rig.start(path, 40, 0.5);
  rig.tick();
  EXPECT_EQ(refusal(), "droverd's publish thread stands still");
  rig.environment.program.clear();
  expect_no_motion_for_s(2);
}
TEST_F(AnEngine, StopsATaskWhenTheComputerSlept) {
  drive();
  rig.environment.slept = "the computer slept for 12 s";
  rig.tick();
  rig.environment.slept.clear();
  rig.run_s(2);
  EXPECT_EQ(rig.fastest_command_radps(), 0);
  EXPECT_EQ(rig.snapshot().nav.status, NavStatus::error);
  expect_no_motion_for_s(2);
}
TEST_F(AnEngine, TakesNoStartWhileSomebodyElseCommandsTheDrives) {
  rig.settle();
  rig.environment.foreign = "somebody else commands front_left on can0";
  rig.run_s(0.1);
  rig.start(path, 40, 0.5);
  rig.tick();
  EXPECT_EQ(refusal(), "somebody else commands front_left on can0");
  expect_no_motion_for_s(2);
  rig.environment.foreign.clear();
  rig.run_s(0.1);
  drive();
}
TEST_F(AnEngine, StopsAtOnceForTheBumper) {
  drive();
  rig.lines[1] = true;
  expect_stopped_at_once("bumper touched");
  rig.lines[1] = false;
  expect_no_motion_for_s(5);
}
TEST_F(AnEngine, StopsAtOnceWhenItIsHitAndAPersonStartsItAgain) {
  rig.imu = true;
  drive();
  const Vector3 level = rig.gravity_mps2;
  rig.gravity_mps2.y = -24;
  rig.run_s(0.02);
  rig.gravity_mps2 = level;
  expect_stopped_at_once("the robot was hit: 24 m/s2 across the ground");
  expect_no_motion_for_s(5);
  rig.start(path, 40, 0.5);
  rig.run_s(3);
  EXPECT_GT(rig.fastest_command_radps(), 1) << rig.why() << refusal();
}
TEST_F(AnEngine, IsNotHitByASlopeABrakingOrAShake) {
  rig.imu = true;
  drive();
  const Vector3 level = rig.gravity_mps2;
  for (int i = 0; i < 100; ++i) {
    rig.gravity_mps2 = {3.0 + 9 * (i % 2), i % 2 == 0 ? 8.0 : -8.0, 20};
    rig.run_s(0.05);
  }
  rig.gravity_mps2 = level;
  EXPECT_TRUE(rig.said<TaskEnded>().empty()) << rig.why();
}
TEST_F(AnEngine, StopsAllWheelsAtOnceWhenOneDriveFallsSilent) {
  drive();
  rig.drives[2].silent = true;
  expect_stopped_at_once("wheel rear_left");
  rig.drives[2].silent = false;
  expect_no_motion_for_s(5);
}
TEST_F(AnEngine, StopsAtOnceForADrivesFault) {
  drive();
  rig.drives[0].fault = true;
  expect_stopped_at_once("wheel front_left: over temperature");
}
TEST_F(AnEngine, StopsWhenADriveRestartedMeanwhile) {
  drive();
  rig.drives[0].state = AxisState::idle;
  rig.drives[0].refuses = true;
  expect_stopped_at_once("wheel front_left: the drive is not in closed loop");
}
TEST_F(AnEngine, StopsWithinHalfASecondWhenFeedbackIsStuck) {
  drive();
  rig.drives[3].stuck = true;
  for (int i = 0; i < 100 && rig.said<TaskEnded>().empty(); ++i) rig.tick();
  expect_stopped_now("wheel rear_right does not follow");
}
TEST_F(AnEngine, StopsAtOnceWhenTheGuardIsGone) {
  drive();
  rig.guard_alive = false;
  expect_stopped_at_once("the guard does not answer");
}
TEST_F(AnEngine, StopsAtOnceWhenTheGuardTakesTheBus) {
  drive();
  rig.guard_has_bus = true;
  expect_stopped_at_once("the guard stopped the drives");
  rig.guard_has_bus = false;
  expect_no_motion_for_s(3);
}
/// Asked first, it tells whether what it knows of is over; the guard's stop is reset at the guard.
TEST_F(AnEngine, TakesAResetWhileTheGuardHoldsAndStaysHeld) {
  drive();
  rig.command(EngageStop{});
  rig.guard_has_bus = true;
  rig.run_s(3);
  rig.command(ResetStop{});
  rig.tick();
  EXPECT_EQ(refusal(), "");
  EXPECT_FALSE(rig.snapshot().stop_latched);
  rig.start(path, 40, 0.5);
  rig.tick();
  EXPECT_EQ(refusal(), "the guard stopped the drives");
  expect_no_motion_for_s(1);
}
TEST_F(AnEngine, TakesAResetWhileTheGuardKeepsAnotherConfigurationsStopSet) {
  rig.command(EngageStop{});
  rig.guard_has_bus = rig.guard_refuses_set = true;
  rig.run_s(3);
  rig.command(ResetStop{});
  rig.tick();
  EXPECT_EQ(refusal(), "") << "there is no other way out";
  rig.start(path, 40, 0.5);
  rig.tick();
  EXPECT_EQ(refusal(),
            "drover-guard keeps the stop set of another configuration, until drover reset");
  expect_no_motion_for_s(1);
}
TEST_F(AnEngine, RefusesAResetWhileTheGuardHoldsAndAButtonIsPressed) {
  drive();
  rig.command(EngageStop{});
  rig.guard_has_bus = true;
  rig.lines[static_cast<std::size_t>(Line::bumper)] = true;
  rig.run_s(3);
  rig.command(ResetStop{});
  rig.tick();
  EXPECT_EQ(refusal(), "bumper touched");
  EXPECT_TRUE(rig.snapshot().stop_latched);
}
TEST_F(AnEngine, FailsWhenItPushesAgainstAWall) {
  drive();
  rig.blocked = true;
  rig.run_s(1.9);
  EXPECT_EQ(rig.snapshot().nav.status, NavStatus::run);
  for (int i = 0; i < 300 && rig.said<TaskEnded>().empty(); ++i) rig.tick();
  expect_stopped_now("blocked");
}
TEST_F(AnEngine, StopsWithin200MillisecondsWhenAWheelRunsAwayAndWaitsForAReset) {
  drive();
  rig.drives[1].by_itself_radps = 2.5;
  for (int i = 0; i < 40 && rig.said<TaskEnded>().empty(); ++i) rig.tick();
  expect_stopped_now("wheel front_right turns by itself");
  rig.drives[1].by_itself_radps = 0;
  expect_no_motion_for_s(2);
  rig.start(path, 40, 0.5);
  rig.tick();
  EXPECT_THAT(refusal(), HasSubstr("reset the stop first: wheel front_right turns by itself"));
}
TEST_F(AnEngine, ThatNobodyDrivesTellsAWheelThatTurnsByItself) {
  drive();
  rig.command(CancelTask{});
  rig.run_s(4);  // the drives hold in closed loop
  ASSERT_EQ(rig.drives[2].state, AxisState::running);
  ASSERT_FALSE(rig.snapshot().stop_latched) << rig.why();
  rig.drives[2].by_itself_radps = 3;
  rig.run_s(0.3);
  EXPECT_TRUE(rig.snapshot().stop_latched);
  EXPECT_THAT(rig.why(), HasSubstr("wheel rear_left turns by itself: 3.0 rad/s, commanded 0.0"));
  rig.command(ResetStop{});
  rig.tick();
  EXPECT_EQ(refusal(), "wheel rear_left turns by itself: 3.0 rad/s, commanded 0.0");
  EXPECT_TRUE(rig.snapshot().stop_latched) << "it turns still";
  rig.drives[2].by_itself_radps = 0;
  rig.tick();
  rig.command(ResetStop{});
  rig.run_s(1);
  EXPECT_FALSE(rig.snapshot().stop_latched);
}

// --- pauses -----------------------------------------------------------------------------------

TEST_F(AnEngine, WaitsForAnObstacleAndGoesOnToTheGoal) {
  drive();
  rig.lines[3] = true;
  rig.run_s(2);
  EXPECT_EQ(rig.fastest_command_radps(), 0);
  EXPECT_TRUE(rig.snapshot().nav.obstacle);
  EXPECT_TRUE(rig.snapshot().nav.paused);
  EXPECT_EQ(rig.snapshot().nav.status, NavStatus::run);
  EXPECT_THAT(rig.why(), HasSubstr("near zone"));
  rig.lines[3] = false;
  rig.run_s(60);
  EXPECT_EQ(rig.snapshot().nav.status, NavStatus::success) << rig.why();
  EXPECT_LT(std::hypot(rig.plant.truth().x_m - 20, rig.plant.truth().y_m), 0.10);
}
TEST_F(AnEngine, SlowsDownForTheFarZone) {
  drive();
  rig.lines[2] = true;
  rig.run_s(2);
  EXPECT_NEAR(rig.plant.truth().vx_mps, 0.25, 0.02);
  rig.lines[2] = false;
  rig.run_s(3);
  EXPECT_NEAR(rig.plant.truth().vx_mps, 0.5, 0.03);
}
TEST_F(AnEngine, DrivesOnWithoutAReceiverUntilTheBudgetIsSpentAndGoesOnWithIt) {
  path = straight_path(200);
  rig.settle();
  rig.start(path, 400, 0.5);
  rig.run_s(4);
  rig.receiver_silent = true;
  rig.run_s(2);
  EXPECT_GT(rig.fastest_command_radps(), 0);
  EXPECT_THAT(rig.why(), HasSubstr("receiver"));
  int ticks = 0;
  while (rig.fastest_command_radps() > 0 && ticks++ < 100 * 200) rig.tick();
  EXPECT_TRUE(rig.snapshot().nav.paused) << rig.why();
  EXPECT_EQ(rig.snapshot().nav.locate, LocateState::lost);
  std::printf("without a receiver it drove %.1f s\n", 2 + ticks * 0.005);
  rig.receiver_silent = false;
  rig.run_s(6);
  EXPECT_EQ(rig.snapshot().nav.status, NavStatus::run);
  EXPECT_GT(rig.fastest_command_radps(), 0) << rig.why();
}
TEST_F(AnEngine, NeverFollowsAPositionThatJumps) {
  drive();
  rig.jump_m = 5;
  for (int i = 0; i < 600 && rig.said<TaskEnded>().empty(); ++i) {
    rig.tick();
    EXPECT_LT(std::abs(rig.plant.truth().y_m), 0.1);
  }
  rig.run_s(1);
  EXPECT_EQ(rig.fastest_command_radps(), 0);
  EXPECT_TRUE(rig.snapshot().nav.status == NavStatus::error || rig.snapshot().nav.paused);
}

}  // namespace
}  // namespace drover::engine
