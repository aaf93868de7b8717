// A program that drives by twists (cmd_vel): what moves the robot, and what does not.
#include "engine/own/twist_stream.h"

#include <cmath>

#include "owners_fixture.h"

namespace drover::engine {
namespace {

using namespace std::chrono_literals;

class CmdVel : public JointCommands {
 protected:
  static constexpr Twist kAhead{0.4, 0};
  void say(Twist twist) { rig.command(FollowTwist{twist}); }
  void say_at(Twist twist, Time received) {
    rig.engine->on_command({{RequestId::Source::ros2, 1}, received, FollowTwist{twist}}, rig.now);
  }
  /// A stream at 20 Hz.
  void say_s(Twist twist, double seconds) {
    for (int i = 0; i < static_cast<int>(seconds * 20 + 0.5); ++i) {
      say(twist);
      rig.run_s(0.05);
    }
  }
  void drive_by_twists() {
    say_s({}, 0.5);
    say_s(kAhead, 2);
    ASSERT_NEAR(speed_mps(), 0.4, 1e-9) << why() << rig.why();
    ASSERT_EQ(rig.snapshot().nav.owner, Owner::cmd_vel);
  }
  void expect_rest_of(Twist twist, const std::string& reason) {
    say_s({}, 0.5);
    say_s(twist, 1);
    EXPECT_EQ(rig.fastest_command_radps(), 0);
    EXPECT_THAT(why(), HasSubstr(reason));
  }
  double speed_mps() const { return rig.fastest_command_radps() * rig.config.base.wheel_radius_m; }
  std::string why() const { return std::string(rig.snapshot().cmd_vel.reason.view()); }
};

TEST_F(CmdVel, DrivesThroughTheLimitsAndIsTheOwner) {
  rig.settle();
  say_s({}, 0.5);
  EXPECT_EQ(rig.fastest_command_radps(), 0);
  double last = 0;
  for (int i = 0; i < 200; ++i) {
    say({100, 0});
    rig.tick();
    ASSERT_LE(speed_mps() - last, rig.config.limits.acceleration_mps2 * 0.005 + 1e-9);
    last = speed_mps();
  }
  say_s({100, 0}, 5);
  EXPECT_NEAR(speed_mps(), rig.config.limits.max_speed_mps, 1e-6);
  EXPECT_EQ(rig.snapshot().nav.owner, Owner::cmd_vel);
  EXPECT_NEAR(rig.snapshot().nav.owner_timeout_s, 0.3, 1e-9);
  EXPECT_TRUE(rig.snapshot().cmd_vel.active);
  EXPECT_GT(rig.snapshot().cmd_vel.accepted, 100U);
}
TEST_F(CmdVel, TurnsToTheLeftForAPositiveRate) {
  rig.settle();
  say_s({}, 0.5);
  say_s({0, 0.5}, 2);
  EXPECT_GT(commanded().wz_radps, 0.1);
  EXPECT_NEAR(commanded().vx_mps, 0, 1e-6);
}
TEST_F(CmdVel, MovesNothingBeforeItSaidZeroForAWhile) {
  rig.settle();
  say_s(kAhead, 2);
  EXPECT_EQ(rig.fastest_command_radps(), 0);
  EXPECT_THAT(why(), HasSubstr("begins with a zero twist"));
  say({});
  say_s(kAhead, 1);
  EXPECT_EQ(rig.fastest_command_radps(), 0) << "one zero is none";
  drive_by_twists();
}
/// "Nothing else": what was refused was no zero, whoever sent it.
TEST_F(CmdVel, DoesNotBeginWithZerosBetweenMessagesThatAreRefused) {
  rig.settle();
  for (int i = 0; i < 20; ++i) {
    say({});
    rig.run_s(0.05);
    if (i % 2 == 0)
      say({NAN, 0});
    else
      rig.command(TwistRefused{"linear.y is 0.3"});
  }
  say({});
  rig.run_s(0.05);
  say_s(kAhead, 1);
  EXPECT_EQ(rig.fastest_command_radps(), 0);
  drive_by_twists();
}
TEST_F(CmdVel, DoesNotBeginWithZerosThatEachFollowedMotion) {
  rig.settle();
  for (int i = 0; i < 20; ++i) {
    rig.command(FollowTwist{{}, true});
    rig.run_s(0.05);
  }
  say_s(kAhead, 1);
  EXPECT_EQ(rig.fastest_command_radps(), 0);
  drive_by_twists();
}
TEST_F(CmdVel, EndsAtOnceWithItsReasonWhenTwoProgramsWrite) {
  rig.settle();
  drive_by_twists();
  rig.command(TwistRefused{"two programs write it", true});
  rig.run_s(0.02);
  EXPECT_LT(speed_mps(), 0.4);
  EXPECT_THAT(why(), HasSubstr("two programs write it"));
  say_s(kAhead, 2);
  EXPECT_EQ(rig.fastest_command_radps(), 0) << "it has to begin anew";
  drive_by_twists();
}
TEST_F(CmdVel, ComesToRestInARampWhenItFallsSilentAndHasToBeginAnew) {
  rig.settle();
  drive_by_twists();
  rig.run_s(0.2);
  EXPECT_NEAR(speed_mps(), 0.4, 1e-9) << "0.25 s after the last";
  rig.run_s(0.06);
  EXPECT_LT(speed_mps(), 0.4);
  double last = speed_mps();
  for (int i = 0; i < 200; ++i) {
    rig.tick();
    ASSERT_LE(last - speed_mps(), rig.config.limits.deceleration_mps2 * 0.005 + 1e-9);
    last = speed_mps();
  }
  EXPECT_EQ(last, 0);
  EXPECT_THAT(why(), HasSubstr("cmd_vel fell silent"));
  say_s(kAhead, 1);
  EXPECT_EQ(rig.fastest_command_radps(), 0);
  drive_by_twists();
}
TEST_F(CmdVel, IsObeyedFromWhenItCameAndNotFromWhenItIsRead) {
  rig.settle();
  drive_by_twists();
  say_at(kAhead, rig.now - 250ms);  // older than what was heard: it lengthens nothing
  rig.run_s(0.2);
  say_at(kAhead, rig.now - 200ms);
  rig.run_s(0.12);
  EXPECT_LT(speed_mps(), 0.4);
}
TEST_F(CmdVel, WhatCameTooLateIsNotFollowed) {
  rig.settle();
  for (const Twist twist : {Twist{}, kAhead}) {
    for (int i = 0; i < 40; ++i) {
      say_at(twist, rig.now - 400ms);
      rig.run_s(0.05);
      ASSERT_EQ(rig.fastest_command_radps(), 0);
    }
  }
  EXPECT_THAT(why(), HasSubstr("too late"));
  EXPECT_EQ(rig.snapshot().nav.owner, Owner::nobody);
}
/// A line or a program hung, and then lets everything go at once: zeros and motion.
TEST_F(CmdVel, ABurstAfterAGapMovesNothing) {
  rig.settle();
  drive_by_twists();
  rig.run_s(3);
  for (int burst = 0; burst < 5; ++burst) {
    for (int i = 0; i < 20; ++i) say({});
    for (int i = 0; i < 20; ++i) say(kAhead);
    for (int i = 0; i < 80; ++i) {
      rig.tick();
      ASSERT_EQ(rig.fastest_command_radps(), 0) << burst;
    }
  }
}
TEST_F(CmdVel, ThatCannotBeIsRefusedAndTheOthersGoOn) {
  rig.settle();
  drive_by_twists();
  for (int i = 0; i < 20; ++i) {
    say({NAN, 0});
    say({0.4, INFINITY});
    rig.command(TwistRefused{"linear.y is 0.3: this base cannot go sideways"});
    rig.tick();
    say(kAhead);
    rig.run_s(0.05);
    ASSERT_NEAR(speed_mps(), 0.4, 1e-9);
  }
  EXPECT_EQ(rig.snapshot().cmd_vel.refused, 60U);
  for (int i = 0; i < 20; ++i) {
    say({NAN, 0});
    rig.run_s(0.05);
  }
  EXPECT_EQ(rig.fastest_command_radps(), 0) << "nothing is followed any more";
  EXPECT_THAT(why(), HasSubstr("a speed that cannot be"));
}
TEST_F(CmdVel, StopsAtOnceForAnEstopAndBeginsOnlyAfterAResetAndFromRest) {
  rig.settle();
  drive_by_twists();
  tap(Line::estop);
  EXPECT_TRUE(rig.snapshot().stop_latched);
  expect_rest_of(kAhead, "reset the stop first: e-stop pressed");
  rig.command(ResetStop{});
  say_s(kAhead, 1);
  EXPECT_EQ(rig.fastest_command_radps(), 0);
  drive_by_twists();
}
TEST_F(CmdVel, StopsAtOnceForAnEstopDuringItsRampAndWaitsForAPerson) {
  rig.settle();
  drive_by_twists();
  rig.run_s(0.4);
  ASSERT_GT(rig.fastest_command_radps(), 0) << "it has ended, the ramp has not";
  EXPECT_EQ(rig.snapshot().nav.owner, Owner::cmd_vel);
  tap(Line::bumper);
  expect_rest_of(kAhead, "reset the stop first: bumper");
  rig.command(ResetStop{});
  drive_by_twists();
}
TEST_F(CmdVel, EndsForWhatIsNearAndTellsItsSender) {
  rig.settle();
  drive_by_twists();
  rig.lines[static_cast<std::size_t>(Line::zone_near)] = true;
  say_s(kAhead, 2);
  EXPECT_EQ(rig.fastest_command_radps(), 0);
  EXPECT_TRUE(rig.snapshot().nav.obstacle);
  rig.lines = {};
  say_s(kAhead, 1);
  EXPECT_EQ(rig.fastest_command_radps(), 0);
  drive_by_twists();
}
TEST_F(CmdVel, IsSlowWhileSomebodyIsInTheFarZone) {
  rig.settle();
  say_s({}, 0.5);
  rig.lines[static_cast<std::size_t>(Line::zone_far)] = true;
  say_s({1, 0}, 2);
  EXPECT_NEAR(speed_mps(), rig.config.navigate.far_zone_speed_mps, 1e-6);
}
TEST_F(CmdVel, IsRefusedWhileATaskRunsAndMakesWayAtRest) {
  rig.settle();
  say_s({}, 0.5);
  ASSERT_EQ(rig.snapshot().nav.owner, Owner::cmd_vel);
  drive();
  ASSERT_EQ(rig.snapshot().nav.owner, Owner::task);
  say_s({}, 0.5);
  say_s({-0.4, 0}, 0.5);
  EXPECT_GT(rig.out.axes[0].velocity_radps, 0);
  EXPECT_THAT(why(), HasSubstr("a task owns the drives"));
}
TEST_F(CmdVel, ThatMovesTheRobotLetsNobodyElseBegin) {
  rig.settle();
  drive_by_twists();
  rig.start(path, 20, 0.5);
  rig.command(DriveByHand{1, {0.4, 0}});
  rig.tick();
  const auto refused = rig.said<CommandRefused>();
  ASSERT_GE(refused.size(), 2U);
  EXPECT_THAT(std::string(refused[refused.size() - 2].reason.view()), HasSubstr("cmd_vel moves"));
  EXPECT_THAT(std::string(refused.back().reason.view()), HasSubstr("the robot moves"));
  say(kAhead);
  for (int i = 0; i < 40; ++i) {
    send(i < 30 ? 0 : 2);
    rig.tick();
  }
  EXPECT_THAT(reason(), HasSubstr("cmd_vel drives the robot")) << reason();
}
TEST_F(CmdVel, IsRefusedWhileJointCommandsAreFollowed) {
  rig.settle();
  drive_by_joints();
  for (int i = 0; i < 100; ++i) {
    send(2);
    say(i < 50 ? Twist{} : Twist{-0.4, 0});
    rig.run_s(0.02);
    ASSERT_EQ(rig.snapshot().nav.owner, Owner::joint_command);
    ASSERT_NEAR(rig.out.axes[0].velocity_radps, 2, 1e-9);
  }
  EXPECT_THAT(why(), HasSubstr("joint commands drive the robot"));
}
TEST_F(CmdVel, AndJointCommandsThatBeginTogetherAreNotBothFollowed) {
  rig.settle();
  for (int i = 0; i < 200; ++i) {
    say(i < 100 ? Twist{} : kAhead);
    send(i < 100 ? 0 : 3);
    rig.run_s(0.02);
    ASSERT_FALSE(rig.snapshot().cmd_vel.active && rig.snapshot().joint_command.active);
  }
  EXPECT_EQ(rig.snapshot().nav.owner, Owner::cmd_vel);
}
TEST_F(CmdVel, AtRestMakesWayForAPersonWithAKey) {
  rig.settle();
  say_s({}, 0.5);
  for (int i = 0; i < 20; ++i) {
    rig.command(DriveByHand{1, {0.3, 0}});
    say(i < 10 ? Twist{} : kAhead);
    rig.run_s(0.1);
  }
  EXPECT_EQ(rig.snapshot().nav.owner, Owner::manual);
  EXPECT_NEAR(speed_mps(), 0.3, 1e-9);
  EXPECT_THAT(why(), HasSubstr("a person drives"));
}
TEST_F(CmdVel, EndsWithAPersonsCancelAndHasToBeginFromRest) {
  rig.settle();
  drive_by_twists();
  rig.command(CancelTask{});
  say_s(kAhead, 2);
  EXPECT_EQ(rig.fastest_command_radps(), 0);
  drive_by_twists();
}
TEST_F(CmdVel, StopsWithoutARampWhenADriveLetsGo) {
  rig.settle();
  drive_by_twists();
  rig.drives[1].state = AxisState::fault;
  say_s(kAhead, 1);
  EXPECT_EQ(rig.fastest_command_radps(), 0);
  EXPECT_TRUE(rig.snapshot().stop_latched);
}
TEST_F(CmdVel, TellsTheJournalOnceForARowThatIsRefused) {
  rig.settle();
  say_s(kAhead, 3);
  EXPECT_EQ(told("cmd_vel refused: cmd_vel begins with a zero twist, and nothing else for 0.3 s"),
            1);
}

}  // namespace
}  // namespace drover::engine
