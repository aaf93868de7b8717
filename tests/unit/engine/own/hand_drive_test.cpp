// A person who drives with a key that is held down: what moves the robot, and what does not.
#include "engine/own/hand_drive.h"

#include "owners_fixture.h"

namespace drover::engine {
namespace {

class DrivingByHand : public AnOwner {
 protected:
  static constexpr std::uint64_t kMine = 1;
  static constexpr std::uint64_t kOther = 2;

  void say(Twist twist, std::uint64_t hand = kMine) { rig.command(DriveByHand{hand, twist}); }
  /// As the terminal repeats it, or as the command line says that no key is held.
  void say_s(Twist twist, double seconds, std::uint64_t hand = kMine) {
    for (int i = 0; i < static_cast<int>(seconds * 10 + 0.5); ++i) {
      say(twist, hand);
      rig.run_s(0.1);
    }
  }
  void hold_s(double seconds) { say_s(kAhead, seconds); }
  double speed_mps() const { return rig.fastest_command_radps() * rig.config.base.wheel_radius_m; }
  std::string refused() const {
    const auto all = rig.said<CommandRefused>();
    return all.empty() ? "" : std::string(all.back().reason.view());
  }
  void expect_rest_for_s(double seconds) {
    for (int i = 0; i < static_cast<int>(seconds * 200); ++i) {
      rig.tick();
      ASSERT_EQ(rig.fastest_command_radps(), 0) << i;
    }
  }
  static constexpr Twist kAhead{0.4, 0};
};

TEST_F(DrivingByHand, MovesWhileTheKeyIsHeldAndRestsWhenItIsLetGo) {
  rig.settle();
  hold_s(3);
  EXPECT_NEAR(speed_mps(), 0.4, 1e-9);
  EXPECT_EQ(rig.snapshot().nav.owner, Owner::manual);
  EXPECT_NEAR(rig.snapshot().nav.owner_timeout_s, 0.3, 1e-9);
  rig.run_s(0.15);
  EXPECT_NEAR(speed_mps(), 0.4, 1e-9) << "one message lasts for 0.3 s";
  // Then a ramp, with the deceleration that is configured and no more.
  double last = speed_mps();
  for (int i = 0; i < 200; ++i) {
    rig.tick();
    ASSERT_LE(last - speed_mps(), rig.config.limits.deceleration_mps2 * 0.005 + 1e-9);
    last = speed_mps();
  }
  EXPECT_EQ(last, 0);
  expect_rest_for_s(1);
  EXPECT_EQ(rig.snapshot().nav.owner, Owner::nobody);
  hold_s(3);
  EXPECT_NEAR(speed_mps(), 0.4, 1e-9);
}
TEST_F(DrivingByHand, DoesNotMoveBeforeTheKeyWasHeldForAWhile) {
  rig.settle();
  hold_s(0.3);
  EXPECT_EQ(rig.fastest_command_radps(), 0);
  EXPECT_EQ(rig.snapshot().nav.owner, Owner::manual) << "the drives are armed meanwhile";
}
TEST_F(DrivingByHand, ComesToRestWhenOneKeyIsLate) {
  rig.settle();
  hold_s(3);
  rig.run_s(0.25);
  EXPECT_LT(speed_mps(), 0.4);
  say(kAhead);
  rig.tick();
  const double then = speed_mps();
  for (int i = 0; i < 40; ++i) {  // it is the first of a new row
    rig.tick();
    ASSERT_LE(speed_mps(), then);
  }
}
TEST_F(DrivingByHand, ABurstAfterAGapMovesNothing) {
  rig.settle();
  hold_s(3);
  rig.run_s(3);
  for (int burst = 0; burst < 5; ++burst) {
    for (int i = 0; i < 20; ++i) say(kAhead);
    expect_rest_for_s(0.4);
  }
}
TEST_F(DrivingByHand, WhatCameTooLateIsNoKey) {
  rig.settle();
  for (int i = 0; i < 20; ++i) {
    const Time old = rig.now - std::chrono::milliseconds(400);
    rig.engine->on_command({{RequestId::Source::cli, 99}, old, DriveByHand{kMine, kAhead}},
                           rig.now);
    expect_rest_for_s(0.1);
  }
  EXPECT_THAT(refused(), HasSubstr("too late"));
}
TEST_F(DrivingByHand, StaysWithHimWhoSaysThatNoKeyIsHeld) {
  rig.settle();
  hold_s(1);
  say_s({}, 2);
  EXPECT_EQ(rig.fastest_command_radps(), 0);
  EXPECT_EQ(rig.snapshot().nav.owner, Owner::manual);
  rig.start(path, 20, 0.5);
  rig.tick();
  EXPECT_THAT(refused(), HasSubstr("a person drives"));
  for (int i = 0; i < 20; ++i) {
    say(kAhead, kOther);
    rig.tick();
    EXPECT_THAT(refused(), HasSubstr("somebody else"));
    say_s({}, 0.1);
  }
  say_s(kAhead, 2, kOther);
  EXPECT_THAT(refused(), HasSubstr("let the key go first"));
  EXPECT_EQ(rig.fastest_command_radps(), 0);
}
TEST_F(DrivingByHand, SayingThatNoKeyIsHeldBeginsNothing) {
  rig.settle();
  say_s({}, 1);
  EXPECT_EQ(rig.snapshot().nav.owner, Owner::nobody);
  EXPECT_NE(rig.out.axes[0].request, AxisRequest::run);
}
TEST_F(DrivingByHand, AnotherOneCannotTakeItOverInMotion) {
  rig.settle();
  hold_s(2);
  for (int i = 0; i < 20; ++i) {
    say(kAhead);
    say({-0.4, 0}, kOther);
    rig.run_s(0.1);
  }
  EXPECT_NEAR(rig.out.axes[0].velocity_radps * rig.config.base.wheel_radius_m, 0.4, 1e-9);
  say_s({-0.4, 0}, 2, kOther);  // the first one is silent by now
  expect_rest_for_s(1);
  say_s({-0.4, 0}, 2, kOther);
  EXPECT_NEAR(rig.out.axes[0].velocity_radps * rig.config.base.wheel_radius_m, -0.4, 1e-9);
}
TEST_F(DrivingByHand, AStopEndsItUntilTheKeyIsLetGoAndTheStopIsOver) {
  rig.settle();
  hold_s(2);
  rig.command(EngageStop{});
  rig.tick();
  EXPECT_EQ(rig.fastest_command_radps(), 0);
  hold_s(1);
  EXPECT_EQ(rig.fastest_command_radps(), 0);
  EXPECT_THAT(refused(), HasSubstr("emergency stop"));
  rig.command(ResetStop{});
  hold_s(2);
  EXPECT_EQ(rig.fastest_command_radps(), 0) << "it was held all the time";
  EXPECT_THAT(refused(), HasSubstr("let the key go first"));
  say_s({}, 0.5);
  hold_s(2);
  EXPECT_GT(speed_mps(), 0.3) << refused();
}
TEST_F(DrivingByHand, AnEstopOrABumperEndsItAtOnceAndArmsNothing) {
  for (const Line line : {Line::estop, Line::bumper}) {
    rig = EngineRig();
    rig.settle();
    hold_s(2);
    ASSERT_GT(speed_mps(), 0.3);
    rig.lines[static_cast<std::size_t>(line)] = true;
    rig.tick();
    EXPECT_EQ(rig.fastest_command_radps(), 0);
    hold_s(1);
    rig.lines = {};
    hold_s(2);
    EXPECT_EQ(rig.fastest_command_radps(), 0);
    say_s({}, 1);
    EXPECT_EQ(rig.snapshot().nav.owner, Owner::nobody);
    hold_s(2);
    EXPECT_GT(speed_mps(), 0.3) << refused();
  }
}
TEST_F(DrivingByHand, IsRefusedForWhatRefusesOthers) {
  rig.settle();
  rig.guard_alive = false;
  rig.run_s(0.5);
  hold_s(1);
  EXPECT_EQ(rig.fastest_command_radps(), 0);
  EXPECT_THAT(refused(), HasSubstr("guard"));
  rig.guard_alive = true;
  rig.run_s(2);
  rig.lines[static_cast<std::size_t>(Line::zone_near)] = true;
  rig.run_s(0.1);
  hold_s(1);
  EXPECT_EQ(rig.fastest_command_radps(), 0);
  rig.lines = {};
  rig.run_s(2);
  rig.command(ReleaseHold{true});
  hold_s(1);
  EXPECT_EQ(rig.fastest_command_radps(), 0);
  EXPECT_THAT(refused(), HasSubstr("released"));
}
TEST_F(DrivingByHand, IsRefusedWhileATaskRuns) {
  rig.settle();
  rig.start(path, 20, 0.5);
  rig.run_s(3);
  ASSERT_EQ(rig.snapshot().nav.owner, Owner::task);
  hold_s(1);
  EXPECT_THAT(refused(), HasSubstr("a task owns the drives"));
  EXPECT_EQ(rig.snapshot().nav.owner, Owner::task);
}
TEST_F(DrivingByHand, StopsForTheNearZoneAndSlowsForTheFarOne) {
  rig.settle();
  rig.lines[static_cast<std::size_t>(Line::zone_far)] = true;
  hold_s(3);
  EXPECT_NEAR(speed_mps(), rig.config.navigate.far_zone_speed_mps, 1e-9);
  rig.lines[static_cast<std::size_t>(Line::zone_near)] = true;
  const double ramp_s =
      rig.config.navigate.far_zone_speed_mps / rig.config.limits.deceleration_mps2;
  for (int i = 0; i < static_cast<int>(ramp_s * 200) + 2; ++i) {
    if (i % 10 == 0) say(kAhead);
    rig.tick();
  }
  EXPECT_EQ(rig.fastest_command_radps(), 0) << "within the ramp, though the key is held";
  hold_s(1);
  EXPECT_EQ(rig.fastest_command_radps(), 0);
  EXPECT_THAT(refused(), HasSubstr("near zone"));
  EXPECT_GT(told("no longer driven by hand: obstacle in the near zone"), 0);
  rig.lines = {};
  hold_s(2);
  EXPECT_EQ(rig.fastest_command_radps(), 0);
  EXPECT_THAT(refused(), HasSubstr("let the key go first: obstacle in the near zone"));
  say_s({}, 0.5);
  hold_s(2);
  EXPECT_GT(speed_mps(), 0.3) << refused();
}
TEST_F(DrivingByHand, NeedsNoFixAndNoOrigin) {
  rig.receiver_silent = true;
  rig.run_s(3);
  hold_s(3);
  EXPECT_NEAR(speed_mps(), 0.4, 1e-9) << refused();
}
TEST_F(DrivingByHand, EndsWithACancel) {
  rig.settle();
  hold_s(2);
  rig.command(CancelTask{});
  hold_s(2);
  EXPECT_EQ(rig.fastest_command_radps(), 0) << "the key is still held";
}
TEST_F(DrivingByHand, EndsBySomebodyElsesCommandsAndASearchThatHasBegunDoesNot) {
  rig.settle();
  hold_s(2);
  rig.environment.foreign = "somebody else commands front_left on can0";
  hold_s(1);
  EXPECT_EQ(rig.fastest_command_radps(), 0);
  EXPECT_THAT(refused(), HasSubstr("somebody else commands"));
  EXPECT_GT(told("no longer driven by hand: somebody else commands front_left on can0"), 0);

  rig = EngineRig();
  rig.no_heading = true;
  rig.settle();
  rig.command(FindHeading{});
  rig.run_s(2);
  ASSERT_GT(speed_mps(), 0.1) << refused();
  rig.environment.foreign = "somebody else commands front_left on can0";
  rig.run_s(0.5);
  EXPECT_GT(speed_mps(), 0.1);
}
TEST_F(DrivingByHand, IsSlowUntilTheMechanicsAreProved) {
  EngineConfig config = rig_config();
  config.navigate.first_way_m = 0.3;
  rig = EngineRig(config);
  rig.imu = true;
  rig.settle();
  double way_m = 0;
  while (way_m < 0.29) {
    say(kAhead);
    for (int i = 0; i < 20; ++i) {
      rig.tick();
      ASSERT_LE(std::abs(rig.plant.truth().vx_mps), 0.07) << way_m;
    }
    way_m = rig.plant.truth().x_m;
    ASSERT_LT(rig.now, Time{std::chrono::seconds(60)});
  }
  const auto answers = rig.said<CommandAccepted>();
  EXPECT_THAT(std::string(answers.back().note.view()), HasSubstr("slowly"));
  hold_s(3);
  EXPECT_NEAR(speed_mps(), 0.4, 1e-9);
  EXPECT_TRUE(rig.said<CommandAccepted>().back().note.empty());
}
TEST_F(DrivingByHand, SidesThatAreSwappedStopItOnTheFirstWay) {
  EngineConfig config = rig_config();
  config.navigate.first_way_m = 0.3;
  std::swap(config.base.left, config.base.right);
  rig = EngineRig(config);
  rig.imu = true;
  rig.plant = test::Plant2d(rig_config().base, {}, 0, 0, 0);
  rig.settle();
  for (int i = 0; i < 200; ++i) {
    hold_s(0.1);
    ASSERT_LE(std::abs(rig.plant.truth().vx_mps), 0.1);
    ASSERT_LE(std::hypot(rig.plant.truth().x_m, rig.plant.truth().y_m), 0.3);
  }
  EXPECT_EQ(rig.fastest_command_radps(), 0);
  EXPECT_THAT(refused(), HasSubstr("let the key go first: by its wheels the robot turned"));
}

TEST_F(DrivingByHand, AKeyThatWasLetGoHindersOthersUntilTheCommandLineSaysSo) {
  rig.settle();
  hold_s(3);
  // It notices 0.3 s after the last key, and says it then.
  for (int i = 0; i < 70; ++i) {
    rig.tick();
    ASSERT_EQ(rig.snapshot().nav.owner, Owner::manual) << i;
  }
  say_s({}, 3);
  EXPECT_EQ(rig.fastest_command_radps(), 0);
  EXPECT_EQ(rig.snapshot().nav.owner, Owner::manual);
  rig.start(path, 20, 0.5);
  rig.tick();
  EXPECT_THAT(refused(), HasSubstr("a person drives"));
  hold_s(3);
  EXPECT_NEAR(speed_mps(), 0.4, 1e-9) << refused();
}
TEST_F(DrivingByHand, ADriveThatFaultsStopsTheOthersAtOnce) {
  rig.settle();
  hold_s(3);
  ASSERT_NEAR(speed_mps(), 0.4, 1e-9);
  rig.drives[0].fault = true;
  rig.tick();
  rig.tick();
  for (const auto& axis : rig.out.axes) EXPECT_EQ(axis.velocity_radps, 0);
  EXPECT_GT(told("no longer driven by hand: wheel front_left: over temperature"), 0);
}
TEST_F(DrivingByHand, ADriveThatFaultsInASearchForTheHeadingStopsTheOthersAtOnce) {
  rig.no_heading = true;
  rig.settle();
  rig.command(FindHeading{});
  rig.run_s(2);
  ASSERT_GT(speed_mps(), 0.1) << refused();
  rig.drives[0].fault = true;
  rig.tick();
  rig.tick();
  for (const auto& axis : rig.out.axes) EXPECT_EQ(axis.velocity_radps, 0);
}
TEST(AHandDrive, IsNotInheritedByASecondHand) {
  using namespace std::chrono_literals;
  HandDrive by_hand;
  EventQueue events;
  Time now{10s};
  const auto say = [&](std::uint64_t hand, const Reason& busy) {
    const Command command{{RequestId::Source::cli, 1}, now, DriveByHand{hand, {0.4, 0}}};
    by_hand.take(command, std::get<DriveByHand>(command.body), busy, {}, now, events);
    by_hand.step(now);
  };
  for (int i = 0; i < 10; ++i, now += 100ms) say(1, {});
  ASSERT_TRUE(by_hand.moves());
  now += 400ms;
  say(2, {});
  EXPECT_TRUE(by_hand.active_of(1)) << "not so soon";
  now += 700ms;  // nobody looked meanwhile
  say(2, "the robot moves");
  EXPECT_FALSE(by_hand.active());
  EXPECT_FALSE(by_hand.moves());
}
TEST_F(DrivingByHand, AfterASayThatTheKeyIsUpItHasToBeHeldAnew) {
  rig.settle();
  hold_s(3);
  say({});
  for (int i = 0; i < 8; ++i) {
    const double before_mps = speed_mps();
    if (i % 4 == 0) say(kAhead);
    for (int k = 0; k < 5; ++k) rig.tick();
    ASSERT_LT(speed_mps(), before_mps) << i;
  }
}
TEST(AHandDrive, EachOfTwoRivalsIsToldThatAnotherHandDrives) {
  using namespace std::chrono_literals;
  HandDrive by_hand;
  EventQueue events;
  Time now{10s};
  std::uint64_t number = 0;
  const auto answer = [&](std::uint64_t hand) -> std::string {
    const Command command{{RequestId::Source::cli, ++number}, now, DriveByHand{hand, {0.4, 0}}};
    by_hand.take(command, std::get<DriveByHand>(command.body), {}, {}, now, events);
    by_hand.step(now);
    std::string why;
    FixedVector<Event, 16> all;
    events.drain(all);
    for (const Event& event : all)
      if (const auto* no = std::get_if<CommandRefused>(&event.body)) why = no->reason.view();
    return why;
  };
  for (int i = 0; i < 10; ++i, now += 100ms) {
    EXPECT_EQ(answer(1), "");
    for (const std::uint64_t rival : {2, 3, 4})
      EXPECT_EQ(answer(rival), "somebody else drives by hand");
  }
  ASSERT_TRUE(by_hand.moves());
  // Now he lets it go. The other keys are held on: none of them drives before it was let go.
  for (int i = 0; i < 30; ++i, now += 100ms) {
    for (const std::uint64_t rival : {2, 3, 4}) {
      EXPECT_THAT(answer(rival), HasSubstr("somebody else drives by hand"));
      EXPECT_FALSE(by_hand.active() && !by_hand.active_of(1));
    }
  }
  // Two more are let go, too; the fourth is still held.
  for (int i = 0; i < 30; ++i, now += 100ms)
    EXPECT_THAT(answer(4), HasSubstr("somebody else drives by hand"));
  EXPECT_FALSE(by_hand.moves());
  now += 1s;
  EXPECT_EQ(answer(4), "");
}
TEST_F(DrivingByHand, WhatNobodyComparedIsNotProvedAndStaysSlow) {
  EngineConfig config = rig_config();
  config.navigate.first_way_m = 0.3;
  rig = EngineRig(config);
  rig.imu = true;
  rig.quality = FixQuality::rtk_float;
  rig.settle();
  hold_s(15);
  EXPECT_GT(rig.driven_m, 0.5);
  EXPECT_LE(std::abs(rig.plant.truth().vx_mps), 0.07);
  EXPECT_FALSE(rig.out.remembered.mechanics_proved);
  EXPECT_THAT(std::string(rig.said<CommandAccepted>().back().note.view()), HasSubstr("slowly"));
  // The key turns it all the same.
  say_s({0.4, 0.4}, 2);
  EXPECT_GT(rig.plant.truth().wz_radps, 0.03);
  // A task begins with a first way of its own.
  rig.quality = FixQuality::rtk_fixed;
  rig.run_s(8);
  const double from_m = rig.driven_m;
  Path ahead = straight_path(20);
  const Pose at = rig.plant.truth();
  for (auto& point : ahead.points) {
    const double s_m = point.x_m;
    point = {at.x_m + s_m * std::cos(at.yaw_rad), at.y_m + s_m * std::sin(at.yaw_rad)};
  }
  rig.start(ahead, 40, 0.5);
  while (rig.driven_m < from_m + 0.28) {
    rig.tick();
    ASSERT_LE(std::abs(rig.plant.truth().vx_mps), 0.07) << rig.driven_m - from_m;
    ASSERT_LT(rig.now, Time{std::chrono::seconds(70)}) << refused() << rig.why();
  }
  rig.run_s(4);
  EXPECT_GT(speed_mps(), 0.4) << rig.why();
  EXPECT_TRUE(rig.out.remembered.mechanics_proved);
}

class AHandBesideAStream : public JointCommands {};

TEST_F(AHandBesideAStream, ResetsNothingForJointCommandsThatWait) {
  rig.settle();
  drive_by_joints();
  tap(Line::estop);
  stream_s(0, 2);
  for (int i = 0; i < 150; ++i) {
    if (i % 5 == 0) rig.command(DriveByHand{1, {0.4, 0}});
    if (i % 2 == 0) send(0.0);
    for (int k = 0; k < 4; ++k) rig.tick();
  }
  ASSERT_GT(rig.fastest_command_radps(), 1) << rig.why();
  stream_s(0, 3);
  expect_no_joint_moves("reset the stop first");
}
}  // namespace
}  // namespace drover::engine
