#include "engine/own/arming.h"

#include <gtest/gtest.h>

#include <string>

#include "../engine_rig.h"
#include "engine/own/arming_checks.h"

namespace drover::engine {
namespace {

/// Four drives that answer as they are told, and a hold over them; 5 ms a cycle.
class Holding : public ::testing::Test {
 protected:
  Holding() : hold(config) {
    for (AxisSnapshot& axis : axes) {
      axis.health = SourceState::fresh;
      axis.state = AxisState::running;
    }
    health.ready = true;
  }
  void tick() {
    now += kRigTick;
    health.drives_running = true;
    for (AxisSnapshot& axis : axes) {
      if (axis.health == SourceState::fresh) axis.last_motion = now;
      if (axis.state != AxisState::running || axis.health != SourceState::fresh)
        health.drives_running = false;
    }
    hold.step({now, kRigTick, health, axes, driven, run_away, power_cut, guard_has_bus, joints},
              events);
  }
  void run_s(double seconds) {
    for (int i = 0; i < static_cast<int>(seconds * 200 + 0.5); ++i) tick();
  }
  /// A task armed the drives, drove, and came to rest.
  void drive_and_stop() {
    driven = true;
    run_s(0.1);
    driven = false;
    run_s(0.1);
  }
  void let_go(double velocity_radps) {
    for (AxisSnapshot& axis : axes) {
      axis.state = AxisState::idle;
      axis.motion.velocity_radps = velocity_radps;
    }
  }
  AxisRequest asked() const { return hold.command(0).request; }
  std::string answer() {
    FixedVector<Event, 64> said;
    events.drain(said);
    for (const Event& event : said) {
      if (const auto* no = std::get_if<CommandRefused>(&event.body))
        return std::string(no->reason.view());
      if (std::holds_alternative<CommandAccepted>(event.body)) return "yes";
    }
    return "nothing";
  }

  EngineConfig config = rig_config();
  Arming hold;
  std::array<AxisSnapshot, 4> axes{};
  HealthReport health;
  EventQueue events;
  bool driven = false;
  bool run_away = false;
  bool power_cut = false;
  bool guard_has_bus = false;
  bool joints = false;
  Time now{std::chrono::seconds(50)};
};

TEST_F(Holding, ArmsWhatAnOwnerMovesAndLeavesTheRestAlone) {
  config.base.left = config.base.right = {};
  (void)config.base.left.push_back(0);
  (void)config.base.right.push_back(1);
  hold = Arming(config);
  driven = true;
  tick();
  EXPECT_EQ(hold.command(1).request, AxisRequest::run);
  EXPECT_EQ(hold.command(2).request, AxisRequest::rest) << "no joint of the base";
  joints = true;
  tick();
  EXPECT_EQ(hold.command(2).request, AxisRequest::run) << "he commands single joints";
  EXPECT_TRUE(hold.driven());
}
TEST_F(Holding, LetsGoOfWhatHasItsPowerCutWhoeverDrives) {
  driven = power_cut = true;
  tick();
  EXPECT_EQ(asked(), AxisRequest::idle);
}
TEST_F(Holding, LeavesDrivesAloneThatNobodyEverArmed) {
  let_go(1);
  run_s(1);
  EXPECT_EQ(asked(), AxisRequest::rest);
  EXPECT_EQ(hold.state(), HoldState::idle);
}
TEST_F(Holding, TakesBackWhatLetGoAtItsOwnSpeedAndRampsItDown) {
  drive_and_stop();
  EXPECT_EQ(hold.state(), HoldState::held);
  let_go(2);
  tick();
  EXPECT_EQ(asked(), AxisRequest::hold);
  EXPECT_EQ(hold.state(), HoldState::catching);
  EXPECT_DOUBLE_EQ(hold.command(0).velocity_radps, 2);
  for (AxisSnapshot& axis : axes) axis.state = AxisState::running;
  double before = 2;
  int cycles = 0;
  for (; asked() == AxisRequest::hold && cycles < 1000; ++cycles) {
    tick();
    const double asked_radps = hold.command(0).velocity_radps;
    ASSERT_LE(asked_radps, before);
    const double step = config.limits.deceleration_mps2 / config.base.wheel_radius_m * 0.005;
    ASSERT_GE(asked_radps, before - step * 1.001);
    before = asked_radps;
    for (AxisSnapshot& axis : axes) axis.motion.velocity_radps = before;
  }
  EXPECT_EQ(before, 0);
  EXPECT_NEAR(cycles * 0.005, 2 * config.base.wheel_radius_m / config.limits.deceleration_mps2,
              0.02);
  tick();
  EXPECT_EQ(hold.state(), HoldState::held);
}
TEST_F(Holding, TakesTheTimeThatAFastRollNeeds) {
  drive_and_stop();
  const double rolls_radps = 4 / config.base.wheel_radius_m;
  let_go(rolls_radps);
  tick();
  for (AxisSnapshot& axis : axes) axis.state = AxisState::running;
  double took_s = 0;
  for (double before = rolls_radps; asked() == AxisRequest::hold && took_s < 10; took_s += 0.005) {
    tick();
    const double asked_radps = hold.command(0).velocity_radps;
    ASSERT_GE(asked_radps, before - 0.03) << took_s;
    before = asked_radps;
    for (AxisSnapshot& axis : axes) axis.motion.velocity_radps = before;
  }
  EXPECT_NEAR(took_s, 5, 0.05);
}
TEST_F(Holding, StopsAWheelAtOnceWhereTheOthersHold) {
  drive_and_stop();
  axes[0].state = AxisState::idle;
  axes[0].motion.velocity_radps = 3;
  tick();
  EXPECT_EQ(asked(), AxisRequest::hold);
  EXPECT_EQ(hold.command(0).velocity_radps, 0);
}
TEST_F(Holding, NeverAsksForMoreThanTheWheelHasOrHad) {
  drive_and_stop();
  let_go(-1);
  tick();
  for (AxisSnapshot& axis : axes) axis.motion.velocity_radps = -3;  // it rolls faster meanwhile
  tick();
  EXPECT_DOUBLE_EQ(hold.command(0).velocity_radps, -1);
  for (AxisSnapshot& axis : axes) axis.motion.velocity_radps = -0.5;
  tick();
  EXPECT_DOUBLE_EQ(hold.command(0).velocity_radps, -0.5);
  for (AxisSnapshot& axis : axes) axis.motion.velocity_radps = 0.5;
  tick();
  EXPECT_EQ(hold.command(0).velocity_radps, 0);
}
TEST_F(Holding, GivesUpTenSecondsAfterTheDrivesLastHeld) {
  drive_and_stop();
  for (AxisSnapshot& axis : axes) axis.health = SourceState::stale;
  run_s(10.1);
  EXPECT_EQ(hold.state(), HoldState::lost);
  for (AxisSnapshot& axis : axes) axis.health = SourceState::fresh;
  let_go(0);
  run_s(1);
  EXPECT_EQ(asked(), AxisRequest::rest);
}
TEST_F(Holding, HoldsAgainAfterARestartHoweverLongItTook) {
  Remembered before;
  before.holding = true;
  hold.recall(before);
  for (AxisSnapshot& axis : axes) axis.health = SourceState::never_heard;
  run_s(60);
  EXPECT_TRUE(hold.armed());
  for (AxisSnapshot& axis : axes) axis.health = SourceState::fresh;
  let_go(1);
  tick();
  EXPECT_EQ(asked(), AxisRequest::hold);
}

/// Nobody hears them, and they may hold the robot: they are fed, and never armed.
TEST_F(Holding, SaysOfDrivesThatAreNotHeardThatTheyHeldBeforeARestart) {
  for (AxisSnapshot& axis : axes) axis.health = SourceState::never_heard;
  run_s(1);
  EXPECT_FALSE(hold.command(0).held) << "nobody knows";
  Remembered before;
  before.holding = true;
  hold.recall(before);
  run_s(60);
  EXPECT_TRUE(hold.command(0).held);
  EXPECT_TRUE(hold.command(3).held);
  EXPECT_EQ(asked(), AxisRequest::rest);
}
TEST_F(Holding, SaysOfNoDriveThatItHeldWhenAPersonLetGoOfItOrItsPowerWasCut) {
  Remembered before;
  before.holding = true;
  const auto held_after = [&](auto what) {
    hold = Arming(config);
    hold.recall(before);
    for (AxisSnapshot& axis : axes) axis.health = SourceState::never_heard;
    tick();
    EXPECT_TRUE(hold.command(0).held);
    what();
    tick();
    return hold.command(0).held;
  };
  EXPECT_FALSE(held_after([&] { hold.release({}, {true}, {}, 0, now, events); }));
  EXPECT_FALSE(held_after([&] { power_cut = true; }));
  power_cut = false;
  EXPECT_FALSE(held_after([&] { run_away = true; }));
  run_away = false;
  EXPECT_FALSE(held_after([&] {
    health.estop = true;
    health.causes = 1U << static_cast<unsigned>(Cause::estop);
  }));
}

TEST_F(Holding, ArmsNothingAfterAnEstop) {
  drive_and_stop();
  health.estop = true;
  health.causes = 1U << static_cast<unsigned>(Cause::estop);
  tick();
  health.estop = false;
  health.causes = 0;
  let_go(1);
  run_s(1);
  EXPECT_EQ(asked(), AxisRequest::rest);
  EXPECT_FALSE(hold.armed());
}
TEST_F(Holding, ArmsNothingAfterAPowerCutOrARunawayWheel) {
  for (bool* cause : {&power_cut, &run_away}) {
    drive_and_stop();
    ASSERT_TRUE(hold.armed());
    *cause = true;
    tick();
    *cause = false;
    EXPECT_FALSE(hold.armed());
  }
}
TEST_F(Holding, WaitsForAnEstopLineThatCannotBeRead) {
  drive_and_stop();
  health.estop = true;  // a lost line counts as pressed
  let_go(1);
  run_s(1);
  EXPECT_EQ(asked(), AxisRequest::rest);
  health.estop = false;
  tick();
  EXPECT_EQ(asked(), AxisRequest::hold);
}
TEST_F(Holding, LeavesADriveWithAFaultOfItsOwnToAPerson) {
  drive_and_stop();
  for (AxisSnapshot& axis : axes) axis.state = AxisState::fault;
  run_s(1);
  EXPECT_EQ(asked(), AxisRequest::rest);
  axes[0].lapsed = true;  // only its watchdog ran out
  tick();
  EXPECT_EQ(asked(), AxisRequest::hold);
  EXPECT_EQ(hold.command(1).request, AxisRequest::rest);
}
TEST_F(Holding, DoesNothingOnBlocksUntilAPersonAsks) {
  config.base.hold_again = false;
  hold = Arming(config);
  drive_and_stop();
  let_go(1);
  run_s(12);
  EXPECT_EQ(asked(), AxisRequest::rest);
  EXPECT_EQ(hold.state(), HoldState::idle) << "nothing was tried, and nothing has failed";
  hold.arm({}, {}, now, events);
  tick();
  EXPECT_EQ(asked(), AxisRequest::hold);
}
TEST_F(Holding, TriesAgainWhenADriveDoesNotArm) {
  drive_and_stop();
  let_go(0.5);
  int attempts = 0;
  AxisRequest before = AxisRequest::rest;
  for (int i = 0; i < 2000; ++i) {
    tick();
    if (asked() == AxisRequest::hold && before != AxisRequest::hold) ++attempts;
    before = asked();
  }
  EXPECT_EQ(attempts, 3);
}
TEST_F(Holding, WaitsForTheGuardToHandTheBusBackButNotForLong) {
  drive_and_stop();
  guard_has_bus = true;
  let_go(1);
  run_s(0.25);
  EXPECT_EQ(asked(), AxisRequest::rest);
  run_s(0.1);
  EXPECT_EQ(asked(), AxisRequest::hold);
  EXPECT_EQ(hold.command(0).velocity_radps, 0);
}
TEST_F(Holding, IsReleasedOnLevelGroundAndStaysSoOverARestart) {
  drive_and_stop();
  hold.release({}, {}, {}, 0.5, now, events);
  EXPECT_EQ(answer(), "yes");
  tick();
  EXPECT_EQ(asked(), AxisRequest::idle);
  EXPECT_EQ(hold.state(), HoldState::released);
  EXPECT_FALSE(hold.hindrance().empty());
  Remembered kept;
  kept.released = hold.released();
  kept.holding = hold.armed();
  hold = Arming(config);
  hold.recall(kept);
  run_s(1);
  EXPECT_EQ(asked(), AxisRequest::idle);
  hold.arm({}, {}, now, events);
  let_go(0);
  tick();
  EXPECT_EQ(asked(), AxisRequest::hold);
}
TEST_F(Holding, IsNotReleasedOnASlopeOrWhereTheTiltIsUnknown) {
  drive_and_stop();
  hold.release({}, {}, {}, 2.5, now, events);
  EXPECT_EQ(answer(), "it would roll: the ground falls by 2.5 degrees (--on-slope lets it go)");
  hold.release({}, {}, {}, kAbsent, now, events);
  EXPECT_EQ(answer(), "the tilt is not known: with --on-slope a person answers for it");
  EXPECT_FALSE(hold.released());
  hold.release({}, {true}, {}, 2.5, now, events);
  EXPECT_EQ(answer(), "yes");
}

/// A line that cannot be read counts as a pressed button.
TEST_F(Holding, SaysThatTheEmergencyStopsLineCannotBeReadWhenThatIsWhyItIsRefused) {
  health.estop = true;
  health.causes = 1U << static_cast<unsigned>(Cause::line_lost);
  health.texts[static_cast<std::size_t>(Cause::line_lost)] = "line estop: not readable";
  EXPECT_EQ(check_arm(health, Latch(), false), "line estop: not readable");
  health.causes |= 1U << static_cast<unsigned>(Cause::estop);
  EXPECT_EQ(check_arm(health, Latch(), false), "the e-stop is pressed");
  health.causes = 0;
  EXPECT_EQ(check_arm(health, Latch(), false), "the e-stop is pressed");
}

TEST_F(Holding, SaysOfADriveThatFailedItsFaultNotWhatWasSilentBefore) {
  health.estop_known = true;
  health.drives_ok = false;
  health.texts[static_cast<std::size_t>(Cause::drive_silent)] = "wheel a: silent, long ago";
  health.texts[static_cast<std::size_t>(Cause::drive_fault)] = "wheel b: over current";
  health.causes = 1U << static_cast<unsigned>(Cause::drive_fault);
  EXPECT_EQ(check_arm(health, Latch(), false), "wheel b: over current");
  health.causes |= 1U << static_cast<unsigned>(Cause::drive_silent);
  EXPECT_EQ(check_arm(health, Latch(), false), "wheel a: silent, long ago");
}

TEST_F(Holding, SaysThatTheBasesOwnEstopIsPressed) {
  health.estop_known = true;
  health.drives_ok = false;
  health.texts[static_cast<std::size_t>(Cause::base_stop)] = "the base: its e-stop is pressed";
  health.causes = bit(Cause::base_stop);
  EXPECT_EQ(check_arm(health, Latch(), false), "the base: its e-stop is pressed");
}

TEST_F(Holding, DoesNotSayThatItTakesBackADriveThatFailed) {
  drive_and_stop();
  axes[2].state = AxisState::fault;
  run_s(0.2);
  EXPECT_EQ(hold.command(2).request, AxisRequest::rest) << "it is not taken back";
  EXPECT_EQ(hold.hindrance(),
            "a drive has failed: for 10 s it is waited whether it can hold again");
  axes[2].lapsed = true;
  tick();
  EXPECT_EQ(hold.command(2).request, AxisRequest::hold);
  EXPECT_EQ(hold.hindrance(), "the drives are being taken back to hold the robot");
}

/// The e-stop's line tells nothing until its contact has held for a while.
class HoldingAfterARestart : public Holding {
 protected:
  HoldingAfterARestart() {
    Remembered remembered;
    remembered.holding = true;
    hold.recall(remembered);
    let_go(0.5);
    know_nothing();
  }
  void know_nothing() {
    health.estop_known = false;
    health.causes = 1U << static_cast<unsigned>(Cause::line_lost);
  }
  void press() {
    health.estop_known = true;
    health.estop = true;
    health.causes = 1U << static_cast<unsigned>(Cause::estop);
  }
  void release() {
    health.estop_known = true;
    health.estop = false;
    health.causes = 0;
  }
};

TEST_F(HoldingAfterARestart, WaitsUntilTheEmergencyStopsLineHasToldOfItself) {
  run_s(0.2);
  EXPECT_EQ(asked(), AxisRequest::rest);
  EXPECT_TRUE(hold.waits_for_lines());
  release();
  run_s(0.1);
  EXPECT_EQ(asked(), AxisRequest::hold);
  EXPECT_FALSE(hold.waits_for_lines());
}
TEST_F(HoldingAfterARestart, HoldsNothingWhenTheEmergencyStopIsPressed) {
  run_s(0.1);
  press();
  tick();
  EXPECT_FALSE(hold.waits_for_lines());
  EXPECT_FALSE(hold.armed());
  release();
  run_s(1);
  EXPECT_EQ(asked(), AxisRequest::rest);
}
TEST_F(HoldingAfterARestart, WaitsNotForEverForALineThatTellsNothing) {
  run_s(0.6);
  EXPECT_FALSE(hold.waits_for_lines());
  EXPECT_EQ(asked(), AxisRequest::rest);
  EXPECT_TRUE(hold.armed()) << "nobody has pressed it";
}
TEST_F(HoldingAfterARestart, DoesNotTakeALineThatIsLostForReleased) {
  health.causes = 1U << static_cast<unsigned>(Cause::line_lost);
  run_s(0.1);
  EXPECT_TRUE(hold.waits_for_lines());
  EXPECT_EQ(asked(), AxisRequest::rest);
}

}  // namespace
}  // namespace drover::engine
