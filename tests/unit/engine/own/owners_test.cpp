// Who may move the base: joint commands, and their betters.
#include <cmath>

#include "owners_fixture.h"

namespace drover::engine {
namespace {

TEST_F(JointCommands, MoveNothingBeforeAMessageWithVelocityZero) {
  stream_s(2, 1);
  EXPECT_EQ(rig.fastest_command_radps(), 0);
  EXPECT_THAT(reason(), HasSubstr("begins with velocity 0"));
  EXPECT_EQ(rig.snapshot().joint_command.refused, 50U);
  EXPECT_EQ(rig.snapshot().nav.owner, Owner::nobody);
}
TEST_F(JointCommands, ThatComeTooFarApartForAStreamAreToldHowFar) {
  const auto send_at_8_Hz = [this](double radps, double seconds) {
    for (int i = 0; i < static_cast<int>(seconds * 8); ++i) {
      send(radps);
      for (int k = 0; k < 25; ++k) rig.tick();
    }
  };
  send_at_8_Hz(0, 2);
  send_at_8_Hz(2, 1);
  EXPECT_EQ(rig.fastest_command_radps(), 0);
  const std::string why = reason();
  EXPECT_THAT(why, HasSubstr("joint commands come 125 ms apart, 100 ms are allowed"));
  // Who writes again after a while has begun anew, and in time.
  rig.run_s(2);
  stream_s(2, 1);
  EXPECT_THAT(reason(), HasSubstr("a stream of joint commands begins with velocity 0"));
  drive_by_joints();
}
/// The silence before its first message was the one before it, whose stream was fast enough.
TEST_F(JointCommands, OfANewProgramAreNotToldHowLongTheLastOneWasSilent) {
  drive_by_joints();
  rig.run_s(0.25);
  stream_s(2, 0.3);
  EXPECT_THAT(reason(), HasSubstr("a stream of joint commands begins with velocity 0"));
  EXPECT_THAT(reason(), testing::Not(HasSubstr("apart")));
}
TEST_F(JointCommands, ReachTheDrivesThroughTheLimitsOfSpeedAndAcceleration) {
  stream_s(0, 0.5);
  double before = 0;
  for (int i = 0; i < 100; ++i) {
    send(1000);
    rig.tick();
    const double now = rig.out.axes[2].velocity_radps;
    EXPECT_LE(now - before,
              rig.config.limits.acceleration_mps2 / rig.config.base.wheel_radius_m / 200 + 1e-9);
    before = now;
  }
  EXPECT_GT(before, 0);
  stream_s(1000, 5);
  EXPECT_NEAR(commanded().vx_mps, rig.config.limits.max_speed_mps, 1e-6);
}
TEST_F(JointCommands, KeepTheBaseWithinItsTurnRate) {
  stream_s(0, 0.5);
  double fastest_radps = 0;
  for (int i = 0; i < 200; ++i) {
    send({-20, 20, -20, 20});
    rig.tick();
    fastest_radps = std::max(fastest_radps, std::abs(commanded().wz_radps));
  }
  // The estimate of how much the wheels skid has its share in it.
  EXPECT_NEAR(fastest_radps, rig.config.limits.max_yaw_rate_radps, 0.15);
}
TEST_F(JointCommands, SlowDownForSomebodyInTheFarZone) {
  stream_s(0, 0.5);
  stream_s(4, 3);
  ASSERT_GT(commanded().vx_mps, 0.6);
  rig.lines[static_cast<std::size_t>(Line::zone_far)] = true;
  stream_s(4, 2);
  EXPECT_NEAR(commanded().vx_mps, rig.config.navigate.far_zone_speed_mps, 1e-6);
  EXPECT_EQ(rig.snapshot().nav.owner, Owner::joint_command);
  rig.lines[static_cast<std::size_t>(Line::zone_far)] = false;
  stream_s(4, 2);
  EXPECT_GT(commanded().vx_mps, 0.6);
}
TEST_F(JointCommands, EndWhatIsToldOfATaskThatFailed) {
  drive();
  rig.guard_has_bus = true;
  rig.run_s(1);
  rig.guard_has_bus = false;
  rig.run_s(1);
  ASSERT_EQ(rig.snapshot().nav.status, NavStatus::error);
  ASSERT_TRUE(rig.snapshot().stop_latched);
  EXPECT_GT(rig.snapshot().nav.distance_left_m, 10);
  drive_by_joints();
  EXPECT_EQ(rig.snapshot().nav.status, NavStatus::free);
  EXPECT_FALSE(rig.snapshot().stop_latched);
  EXPECT_EQ(rig.why(), "");
}
TEST_F(JointCommands, EndInARampWhenTheStreamFallsSilent) {
  drive_by_joints();
  rig.run_s(0.11);
  EXPECT_LT(rig.fastest_command_radps(), 2) << "the ramp has begun";
  rig.run_s(1);
  EXPECT_EQ(rig.fastest_command_radps(), 0);
  EXPECT_THAT(reason(), HasSubstr("fell silent"));
  send(2);
  rig.run_s(0.5);
  EXPECT_EQ(rig.fastest_command_radps(), 0) << "it has to begin with zero again";
}

TEST_F(JointCommands, AreNotOpenedForAHungProgramByTheZerosOfAnother) {
  for (int i = 0; i < 100; ++i) {
    send(0);
    rig.tick();
    rig.tick();
    send(2);
    rig.tick();
    rig.tick();
    ASSERT_EQ(rig.fastest_command_radps(), 0);
  }
  EXPECT_THAT(reason(), HasSubstr("velocity 0, and nothing else for 0.3 s"));
  drive_by_joints();
}
TEST_F(JointCommands, OfZerosDoNotHideTheRampOfAnotherAndGoOnWithItLater) {
  drive();
  rig.run_s(3);
  const double driven_radps = rig.fastest_command_radps();
  ASSERT_GT(driven_radps, 1);
  rig.command(CancelTask{});
  const double step_radps =
      rig.config.limits.deceleration_mps2 / rig.config.base.wheel_radius_m / 200;
  double before = driven_radps;
  for (int i = 0; i < 600; ++i) {
    if (i % 4 == 0 && i < 120) send(0);
    rig.tick();
    const double now = rig.fastest_command_radps();
    ASSERT_LE(now, before + 1e-9) << "cycle " << i;
    ASSERT_GE(now, before - 2 * step_radps) << "cycle " << i;
    before = now;
  }
  EXPECT_EQ(before, 0);
}
TEST_F(JointCommands, MoveNothingAfterZerosThatPaused) {
  for (int i = 0; i < 3; ++i) {
    stream_s(0, 0.2);
    rig.run_s(0.2);
  }
  stream_s(0, 0.2);
  send(2);
  rig.run_s(0.05);
  EXPECT_EQ(rig.fastest_command_radps(), 0);
}
TEST_F(JointCommands, TellThatAnOperatorsEmergencyStopEndedThem) {
  drive_by_joints();
  rig.command(EngageStop{});
  rig.tick();
  EXPECT_EQ(rig.fastest_command_radps(), 0);
  EXPECT_EQ(reason(), "emergency stop of an operator");
  rig.run_s(0.5);
  EXPECT_EQ(told("joint commands ended: emergency stop of an operator"), 1);
}
TEST_F(JointCommands, AreRefusedWhileATaskDrives) {
  drive();
  stream_s(0, 0.2);
  stream_s(2, 0.2);
  EXPECT_EQ(rig.snapshot().nav.owner, Owner::task);
  EXPECT_THAT(reason(), HasSubstr("a task owns the drives"));
  EXPECT_EQ(rig.snapshot().nav.status, NavStatus::run);
}
TEST_F(JointCommands, ThatAreRefusedInARowAreToldOnceInTheJournal) {
  drive();
  stream_s(2, 3);
  EXPECT_EQ(told("joint command refused: a task owns the drives"), 1);
  rig.run_s(2);
  stream_s(2, 1);
  EXPECT_EQ(told("joint command refused: a task owns the drives"), 2) << "another stream";
  rig.command(CancelTask{});
  rig.run_s(2);
  drive_by_joints();
  rig.run_s(0.5);
  EXPECT_EQ(told("joint commands ended: the stream of joint commands fell silent"), 1);
}
TEST_F(JointCommands, ThatMoveTheRobotHinderATask) {
  rig.settle();
  drive_by_joints();
  rig.start(path, 40, 0.5);
  ASSERT_EQ(rig.said<CommandRefused>().size(), 0U) << "events come with the next cycle";
  rig.tick();
  ASSERT_EQ(rig.said<CommandRefused>().size(), 1U);
  EXPECT_THAT(std::string(rig.said<CommandRefused>()[0].reason.view()),
              HasSubstr("joint commands"));
  EXPECT_EQ(rig.said<PathReleased>().size(), 1U);
}
TEST_F(JointCommands, ThatRestMakeWayForATask) {
  rig.settle();
  stream_s(0, 0.5);
  rig.start(path, 40, 0.5);
  stream_s(0, 2);
  EXPECT_EQ(rig.said<NavigationStarted>().size(), 1U);
  EXPECT_EQ(rig.snapshot().nav.owner, Owner::task);
}
TEST_F(JointCommands, StopForAnObstacleInTheNearZone) {
  drive_by_joints();
  rig.lines[3] = true;
  stream_s(2, 1.5);
  EXPECT_EQ(rig.fastest_command_radps(), 0);
}
TEST_F(JointCommands, StopAtOnceWhenADriveLeavesClosedLoop) {
  drive_by_joints();
  rig.drives[1].state = AxisState::idle;
  rig.drives[1].refuses = true;
  send(2);
  rig.tick();
  rig.tick();
  EXPECT_EQ(rig.fastest_command_radps(), 0);
  EXPECT_THAT(reason(), HasSubstr("front_right"));
}
TEST_F(JointCommands, WithANumberThatIsNoneAreRefusedAndCounted) {
  stream_s(0, 0.5);
  send(std::nan(""));
  rig.tick();
  EXPECT_EQ(rig.snapshot().joint_command.refused, 1U);
  rig.command(JointTargetsRefused{"joint arm: unknown"});
  rig.tick();
  EXPECT_EQ(rig.snapshot().joint_command.refused, 2U);
  EXPECT_EQ(reason(), "joint arm: unknown");
}

TEST_F(AnEngine, StopsAtOnceForAnOperatorsEmergencyStopUntilItIsReset) {
  drive();
  rig.command(EngageStop{});
  rig.tick();
  EXPECT_EQ(rig.fastest_command_radps(), 0);
  ASSERT_EQ(rig.said<TaskEnded>().size(), 1U);
  EXPECT_EQ(rig.said<TaskEnded>()[0].how, TaskEnded::How::failed);
  expect_no_motion_for_s(1);
  rig.start(path, 40, 0.5);
  rig.run_s(1);
  EXPECT_THAT(std::string(rig.said<CommandRefused>().back().reason.view()),
              HasSubstr("reset the stop first: emergency stop of an operator"));
  rig.command(ResetStop{});
  rig.start(path, 40, 0.5);
  rig.run_s(2);
  EXPECT_GT(rig.fastest_command_radps(), 0);
}

}  // namespace
}  // namespace drover::engine
