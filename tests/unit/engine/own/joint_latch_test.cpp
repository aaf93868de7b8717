// After what stopped the base, joint commands wait until a person acts.
#include "owners_fixture.h"

namespace drover::engine {
namespace {

TEST_F(JointCommands, StopAtOnceForAnEstopAndStayStoppedUntilAPersonResets) {
  drive_by_joints();
  rig.lines[0] = true;
  rig.tick();
  EXPECT_EQ(rig.fastest_command_radps(), 0);
  rig.lines[0] = false;
  stream_s(0, 1);
  stream_s(2, 1);
  EXPECT_EQ(rig.fastest_command_radps(), 0);
  EXPECT_THAT(reason(), HasSubstr("reset the stop first: e-stop pressed"));
  EXPECT_TRUE(rig.snapshot().stop_latched);
  rig.command(ResetStop{});
  drive_by_joints();
}
TEST_F(JointCommands, StayStoppedAfterAnEstopDuringTheRampOfTheirEnd) {
  drive_by_joints();
  rig.run_s(0.2);
  ASSERT_GT(rig.fastest_command_radps(), 0) << "the stream has ended, the ramp has not";
  rig.lines[0] = true;
  rig.tick();
  EXPECT_EQ(rig.fastest_command_radps(), 0);
  EXPECT_TRUE(rig.snapshot().stop_latched);
  rig.lines[0] = false;
  stream_s(0, 1);
  stream_s(2, 1);
  EXPECT_EQ(rig.fastest_command_radps(), 0);
  EXPECT_THAT(reason(), HasSubstr("reset the stop first: e-stop pressed"));
  rig.command(ResetStop{});
  drive_by_joints();
}
TEST_F(JointCommands, StayStoppedAfterABumperDuringTheRampForAnObstacle) {
  drive_by_joints();
  rig.lines[static_cast<std::size_t>(Line::zone_near)] = true;
  stream_s(2, 0.1);
  ASSERT_GT(rig.fastest_command_radps(), 0);
  rig.lines[static_cast<std::size_t>(Line::bumper)] = true;
  rig.tick();
  rig.lines = {};
  stream_s(0, 1);
  stream_s(2, 1);
  EXPECT_EQ(rig.fastest_command_radps(), 0);
  EXPECT_THAT(reason(), HasSubstr("reset the stop first: bumper"));
}
TEST_F(JointCommands, StayAtRestAfterAnEstopDuringTheRampOfACancelledTask) {
  drive();
  rig.command(CancelTask{});
  rig.run_s(0.2);
  ASSERT_GT(rig.fastest_command_radps(), 0) << "the task has ended, the ramp has not";
  for (const Line line : {Line::estop, Line::bumper}) {
    tap(line);
    expect_no_joint_moves("reset the stop first");
    EXPECT_TRUE(rig.snapshot().stop_latched);
  }
  rig.command(ResetStop{});
  drive_by_joints();
}
TEST_F(JointCommands, StayAtRestAfterAnEstopOfATask) {
  drive();
  tap(Line::estop);
  expect_no_joint_moves("reset the stop first: e-stop pressed");
  rig.command(CancelTask{});
  drive_by_joints();
}
TEST_F(JointCommands, StayAtRestAfterAnEstopOfAHeadingSearchOrOfItsRamp) {
  for (const bool during_its_ramp : {false, true}) {
    rig = EngineRig();
    rig.no_heading = true;
    rig.settle();
    rig.command(FindHeading{});
    rig.run_s(3);
    ASSERT_EQ(rig.snapshot().nav.owner, Owner::manual);
    if (during_its_ramp) {
      rig.command(CancelTask{});
      rig.run_s(0.1);
      ASSERT_GT(rig.fastest_command_radps(), 0);
    }
    tap(Line::estop);
    expect_no_joint_moves("reset the stop first: e-stop pressed");
    rig.command(ResetStop{});
    drive_by_joints();
  }
}
TEST_F(JointCommands, StayAtRestAfterASoftwareStopDuringTheRampOfACancelledTask) {
  drive();
  rig.command(CancelTask{});
  rig.run_s(0.2);
  ASSERT_GT(rig.fastest_command_radps(), 0);
  rig.command(EngageStop{});
  rig.tick();
  EXPECT_EQ(rig.fastest_command_radps(), 0);
  expect_no_joint_moves("reset the stop first: emergency stop of an operator");
  rig.command(ResetStop{});
  drive_by_joints();
}
TEST_F(JointCommands, LeaveAHeadingSearchToAPersonWhoAsksForItAnew) {
  rig.no_heading = true;
  rig.settle();
  rig.command(FindHeading{});
  rig.run_s(3);
  tap(Line::estop);
  expect_no_joint_moves("reset the stop first: e-stop pressed");
  rig.command(FindHeading{});
  rig.run_s(3);
  EXPECT_EQ(rig.snapshot().nav.owner, Owner::manual);
  EXPECT_GT(rig.fastest_command_radps(), 0);
}
TEST_F(JointCommands, StayStoppedAfterAnEstopThoughTheGatewayIsKilled) {
  drive_by_joints();
  rig.lines[static_cast<std::size_t>(Line::estop)] = true;
  rig.tick();
  restart();
  rig.lines = {};
  expect_no_joint_moves("reset the stop first: e-stop pressed");
  EXPECT_TRUE(rig.snapshot().stop_latched);
  EXPECT_TRUE(rig.out.remembered.stop.empty()) << "a task may begin";
  restart();
  expect_no_joint_moves("reset the stop first: e-stop pressed");
  rig.command(ResetStop{});
  drive_by_joints();
  EXPECT_TRUE(rig.out.remembered.joints_wait.empty());
}
TEST_F(JointCommands, StayStoppedAfterABumperOfATaskThoughTheGatewayIsKilled) {
  drive();
  tap(Line::bumper);
  restart();
  expect_no_joint_moves("reset the stop first: bumper");
  rig.command(CancelTask{});
  drive_by_joints();
}
TEST_F(JointCommands, LeaveTheDrivesToATaskThatAPersonStartsAfterTheGatewayWasKilled) {
  drive();
  tap(Line::bumper);
  restart();
  rig.run_s(3);
  rig.start(path, 40, 0.5);
  rig.run_s(4);
  EXPECT_EQ(rig.snapshot().nav.status, NavStatus::run) << rig.why() << refusal();
  EXPECT_TRUE(rig.out.remembered.joints_wait.empty()) << "a person acted";
}
TEST_F(JointCommands, NeedNoResetAfterAnEstopAtRest) {
  rig.settle();
  tap(Line::estop);
  EXPECT_FALSE(rig.snapshot().stop_latched);
  drive_by_joints();
}

}  // namespace
}  // namespace drover::engine
