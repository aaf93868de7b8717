// Who may move the base: joint commands, the straight way for a heading, and their betters.
#include <algorithm>
#include <cmath>

#include "../engine_fixture.h"
#include "engine/drive/skid_steer.h"

namespace drover::engine {
namespace {

using ::testing::HasSubstr;

class AnOwner : public AnEngine {
 protected:
  /// How often the journal said so.
  std::ptrdiff_t told(const std::string& text) const {
    const auto notices = rig.said<Notice>();
    return std::count_if(notices.begin(), notices.end(),
                         [&](const Notice& notice) { return notice.text == text; });
  }
};

class JointCommands : public AnOwner {
 protected:
  /// One message: the same velocity for all four joints.
  void send(double radps) {
    JointTargets targets;
    for (AxisId id = 0; id < 4; ++id) (void)targets.joints.push_back({id, radps});
    rig.command(targets);
  }
  void send(const std::array<double, 4>& radps) {
    JointTargets targets;
    for (AxisId id = 0; id < 4; ++id) (void)targets.joints.push_back({id, radps[id]});
    rig.command(targets);
  }
  /// What the front wheels are commanded, as a motion of a base whose wheels do not slip.
  Twist commanded() const {
    const double radius_m = rig.config.base.wheel_radius_m;
    return twist_from_wheels(rig.config.base, 1.0, rig.out.axes[0].velocity_radps * radius_m,
                             rig.out.axes[1].velocity_radps * radius_m);
  }
  /// A stream at 50 Hz.
  void stream_s(double radps, double seconds) {
    for (int i = 0; i < static_cast<int>(seconds * 50 + 0.5); ++i) {
      send(radps);
      for (int k = 0; k < 4; ++k) rig.tick();
    }
  }
  void drive_by_joints() {
    stream_s(0, 0.5);
    stream_s(2, 2);
    ASSERT_NEAR(rig.out.axes[0].velocity_radps, 2, 1e-9) << reason() << rig.why();
    ASSERT_EQ(rig.snapshot().nav.owner, Owner::joint_command);
  }
  /// Pressed or touched for an instant.
  void tap(Line line) {
    rig.lines[static_cast<std::size_t>(line)] = true;
    rig.tick();
    EXPECT_EQ(rig.fastest_command_radps(), 0);
    rig.lines = {};
    rig.run_s(1);
  }
  void expect_no_joint_moves(const std::string& why) {
    stream_s(0, 1);
    stream_s(2, 1);
    EXPECT_EQ(rig.fastest_command_radps(), 0);
    EXPECT_THAT(reason(), HasSubstr(why));
  }
  /// The gateway died and another one is back, with what was remembered; the stream went on.
  void restart() {
    const Remembered left = rig.out.remembered;
    rig.engine = std::make_unique<Engine>(rig.config);
    rig.engine->recall(left, rig.now);
    for (auto& drive : rig.drives) drive = {};
    rig.tick();
    rig.set_origin();
    stream_s(0, 0.1);
  }
  std::string reason() const { return std::string(rig.snapshot().joint_command.reason.view()); }
};

TEST_F(JointCommands, MoveNothingBeforeAMessageWithVelocityZero) {
  stream_s(2, 1);
  EXPECT_EQ(rig.fastest_command_radps(), 0);
  EXPECT_THAT(reason(), HasSubstr("begins with velocity 0"));
  EXPECT_EQ(rig.snapshot().joint_command.refused, 50U);
  EXPECT_EQ(rig.snapshot().nav.owner, Owner::nobody);
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

class FindingTheHeading : public AnOwner {
 protected:
  void settle_without_heading() {
    rig.no_heading = true;
    rig.settle();
    ASSERT_EQ(rig.snapshot().nav.locate, LocateState::uninit);
  }
  std::string last_notice() const { return std::string(rig.said<Notice>().back().text.view()); }
};

TEST_F(FindingTheHeading, IsRefusedWhenItIsKnown) {
  rig.settle();
  rig.command(FindHeading{});
  rig.run_s(1);
  EXPECT_EQ(rig.fastest_command_radps(), 0);
  EXPECT_THAT(std::string(rig.said<CommandRefused>().back().reason.view()), HasSubstr("known"));
}
TEST_F(FindingTheHeading, DrivesNoFartherThanItMay) {
  settle_without_heading();
  rig.quality = FixQuality::none;  // nothing will ever show it
  rig.command(FindHeading{});
  rig.run_s(3);
  EXPECT_EQ(rig.snapshot().nav.owner, Owner::manual);
  EXPECT_GT(rig.fastest_command_radps(), 0);
  rig.run_s(40);
  EXPECT_EQ(rig.fastest_command_radps(), 0);
  EXPECT_THAT(last_notice(), HasSubstr("no heading"));
  EXPECT_LT(rig.plant.estimate().x_m, rig.config.navigate.find_heading_distance_m + 0.3);
}
TEST_F(FindingTheHeading, SlowsDownForSomebodyInTheFarZone) {
  EngineConfig config = rig_config();
  config.navigate.find_heading_speed_mps = 0.5;
  rig = EngineRig(config);
  settle_without_heading();
  rig.quality = FixQuality::none;
  rig.command(FindHeading{});
  rig.lines[static_cast<std::size_t>(Line::zone_far)] = true;
  rig.run_s(3);
  EXPECT_NEAR(rig.fastest_command_radps() * rig.config.base.wheel_radius_m,
              rig.config.navigate.far_zone_speed_mps, 1e-6);
}
TEST_F(FindingTheHeading, TellsThatAnOperatorsEmergencyStopEndedIt) {
  settle_without_heading();
  rig.command(FindHeading{});
  rig.run_s(2);
  ASSERT_GT(rig.fastest_command_radps(), 0);
  rig.command(EngageStop{});
  rig.tick();
  EXPECT_EQ(rig.fastest_command_radps(), 0);
  EXPECT_EQ(told("no heading: emergency stop of an operator"), 1);
}
TEST_F(FindingTheHeading, EndsWithACancelAndWithAnEstop) {
  settle_without_heading();
  rig.command(FindHeading{});
  rig.run_s(2);
  rig.command(CancelTask{});
  rig.run_s(1.5);
  EXPECT_EQ(rig.fastest_command_radps(), 0);
  rig.command(FindHeading{});
  rig.run_s(2);
  rig.lines[0] = true;
  rig.tick();
  EXPECT_EQ(rig.fastest_command_radps(), 0);
  rig.lines[0] = false;
  expect_no_motion_for_s(2);
}

}  // namespace
}  // namespace drover::engine
