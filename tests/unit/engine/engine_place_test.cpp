// Places that change while the wheels stand: in a pause of a task, and before a start.
#include "engine_fixture.h"

namespace drover::engine {
namespace {

using ::testing::HasSubstr;

class ARobotWhosePlaceChanges : public AnEngine {
 protected:
  ARobotWhosePlaceChanges() {
    rig.imu = true;
    rig.tells_speed = true;
  }
  void obstacle(bool there) { rig.lines[static_cast<std::size_t>(Line::zone_near)] = there; }
  void wait_before_an_obstacle() {
    drive();
    obstacle(true);
    rig.run_s(5);
    ASSERT_TRUE(rig.snapshot().nav.paused) << rig.why();
  }
  void expect_failed(const std::string& reason) {
    ASSERT_EQ(rig.said<TaskEnded>().size(), 1U);
    EXPECT_EQ(rig.said<TaskEnded>()[0].how, TaskEnded::How::failed);
    EXPECT_THAT(std::string(rig.said<TaskEnded>()[0].reason.view()), HasSubstr(reason));
    EXPECT_EQ(rig.snapshot().nav.status, NavStatus::error);
    obstacle(false);
    expect_no_motion_for_s(5);
  }
  void expect_refused(const std::string& reason) {
    const std::size_t before = rig.said<CommandRefused>().size();
    rig.start(path, 40, 0.5);
    rig.tick();
    ASSERT_EQ(rig.said<CommandRefused>().size(), before + 1);
    EXPECT_THAT(refusal(), HasSubstr(reason));
    expect_no_motion_for_s(0.5);
  }
  void expect_drives() {
    rig.start(path, 40, 0.5);
    rig.run_s(3);
    EXPECT_GT(rig.fastest_command_radps(), 1) << rig.why() << refusal();
  }
  /// Moved by so much on a trailer; its wheels stand on it.
  void carry(const WheelSpeeds& speeds, double seconds) {
    for (auto& drive : rig.drives) drive.stuck = true;
    rig.carried = speeds;
    rig.run_s(seconds);
    rig.carried.reset();
    for (auto& drive : rig.drives) drive.stuck = false;
  }
  std::string told() const {
    std::string all;
    for (const Notice& notice : rig.said<Notice>()) all += std::string(notice.text.view()) + "\n";
    return all;
  }
};

TEST_F(ARobotWhosePlaceChanges, GoesOnAfterAPauseInWhichNothingChanged) {
  wait_before_an_obstacle();
  rig.run_s(20);
  obstacle(false);
  rig.run_s(3);
  EXPECT_GT(rig.fastest_command_radps(), 1) << rig.why();
}

class AJumpInAPause : public ARobotWhosePlaceChanges, public testing::WithParamInterface<double> {};

TEST_P(AJumpInAPause, EndsTheTask) {
  wait_before_an_obstacle();
  rig.jump_m = GetParam();
  rig.run_s(3);
  expect_failed("jumped by");
}

TEST_P(AJumpInAPause, IsNotDrivenFromWhenTheObstacleGoesAtTheSameTime) {
  wait_before_an_obstacle();
  rig.jump_m = GetParam();
  rig.run_s(0.3);
  obstacle(false);
  rig.run_s(4);
  ASSERT_EQ(rig.said<TaskEnded>().size(), 1U);
  EXPECT_EQ(rig.said<TaskEnded>()[0].how, TaskEnded::How::failed);
}

INSTANTIATE_TEST_SUITE_P(OfTheReceiver, AJumpInAPause,
                         testing::Values(-0.45, 0.3, 0.45, 2, -5, 50));

/// 4 mm/s: its place became a little better known meanwhile, and was taken for the one it stood at.
TEST_F(ARobotWhosePlaceChanges, FailsWhenTheReceiverWalksAwayInAPause) {
  wait_before_an_obstacle();
  double told_after_m = 0;
  for (int i = 0; i < 200 && rig.said<TaskEnded>().empty(); ++i) {
    rig.jump_m += 0.002;
    told_after_m = rig.snapshot().pose.x_m - rig.plant.truth().x_m;
    rig.run_s(0.5);
  }
  EXPECT_LT(told_after_m, 0.2);
  expect_failed("jumped by");
}

TEST_F(ARobotWhosePlaceChanges, FailsWhenTheHeadingFlipsInAPause) {
  wait_before_an_obstacle();
  rig.heading_off_deg = 180;
  rig.run_s(5);
  expect_failed("the heading jumped by 180 degrees though no wheel turned");
}

TEST_F(ARobotWhosePlaceChanges, FailsWhenItIsCarriedInAPause) {
  wait_before_an_obstacle();
  carry({6, 6}, 2);
  expect_failed("pushed or carried");
}

TEST_F(ARobotWhosePlaceChanges, FailsWhenItIsCarriedAndTurnedInAPause) {
  wait_before_an_obstacle();
  carry({-6, 6}, 1);
  rig.run_s(3);
  expect_failed("");
}

TEST_F(ARobotWhosePlaceChanges, FailsWhenItIsCarriedTooSlowlyToBeTold) {
  rig.imu = false;
  rig.tells_speed = false;
  wait_before_an_obstacle();
  carry({-1, -1}, 4);  // 0.17 m/s
  rig.run_s(3);
  expect_failed("");
}

TEST_F(ARobotWhosePlaceChanges, FailsWhenItIsPushedInAPauseSoThatItsWheelsTurn) {
  wait_before_an_obstacle();
  rig.carried = WheelSpeeds{1, 1};
  rig.run_s(0.5);
  rig.carried.reset();
  expect_failed("the robot rolls without a command");
}

TEST_F(ARobotWhosePlaceChanges, IsStartedAfterAJumpOnlyByAPersonWhoWasTold) {
  rig.settle();
  rig.jump_m = 1.9;
  rig.run_s(3);
  EXPECT_EQ(rig.snapshot().nav.locate, LocateState::good) << rig.why();
  EXPECT_THAT(told(), HasSubstr("the position jumped by 1.9 m though no wheel turned"));
  expect_refused("jumped by 1.9 m though no wheel turned: look where it stands");
  rig.run_s(4);
  expect_refused("10 s after the jump");
  rig.run_s(4);
  expect_drives();
}

TEST_F(ARobotWhosePlaceChanges, IsStartedAtTheSecondAttemptWhenTheJumpWasLongAgo) {
  rig.settle();
  rig.jump_m = 0.5;
  rig.run_s(60);
  expect_refused("the position jumped by 0.5 m");
  expect_drives();
}

TEST_F(ARobotWhosePlaceChanges, IsRefusedWhenItsHeadingJumpedAtRest) {
  rig.settle();
  rig.heading_off_deg = 25;
  rig.run_s(3);
  expect_refused("the heading jumped by 25 degrees");
}

TEST_F(ARobotWhosePlaceChanges, IsStartedTenSecondsAfterAJumpThatEndedItsTask) {
  wait_before_an_obstacle();
  rig.jump_m = 0.45;
  rig.run_s(3);
  expect_failed("jumped by");
  rig.run_s(6);
  expect_drives();
}

TEST_F(ARobotWhosePlaceChanges, IsRefusedAgainWhenItJumpsAgain) {
  rig.settle();
  rig.jump_m = 1.9;
  rig.run_s(12);
  expect_refused("jumped by 1.9 m");
  rig.jump_m = 0;
  rig.run_s(12);
  expect_refused("jumped by 1.9 m");
  expect_drives();
}

TEST_F(ARobotWhosePlaceChanges, IsNotToldToJumpWhenItsFixComesAndGoes) {
  rig.settle();
  for (int i = 0; i < 6; ++i) {
    rig.quality = FixQuality::rtk_float;
    rig.jump_m = i % 2 == 0 ? 0.4 : -0.4;
    rig.run_s(10);
    rig.quality = FixQuality::rtk_fixed;
    rig.jump_m = 0;
    rig.run_s(10);
  }
  EXPECT_THAT(told(), ::testing::Not(HasSubstr("jumped")));
  expect_drives();
}

struct Loss {
  FixQuality meanwhile = FixQuality::none;
  double lost_s = 0;
  double elsewhere_m = 0;
  double burst_s =
      0;  ///< a computer that was busy: the first positions come at once, so much later
};

class AFixFoundElsewhere : public ARobotWhosePlaceChanges,
                           public testing::WithParamInterface<Loss> {
 protected:
  void lose_and_find_it() {
    rig.settle();
    rig.run_s(5);
    rig.quality = GetParam().meanwhile;
    rig.receiver_silent = GetParam().meanwhile == FixQuality::none;
    rig.run_s(GetParam().lost_s);
    rig.receiver_silent = false;
    rig.receiver_late = GetParam().burst_s > 0;
    rig.quality = FixQuality::rtk_fixed;
    rig.jump_m = GetParam().elsewhere_m;
    rig.run_s(GetParam().burst_s);
    rig.receiver_late = false;
  }
  bool is_there() const {
    return std::abs(rig.snapshot().pose.x_m - rig.plant.truth().x_m) > std::abs(rig.jump_m) / 2;
  }
  void press() {
    rig.log.clear();
    rig.start(path, 40, 0.5);
  }
};

/// A person who presses start in each cycle finds none in which the other place is good and nobody
/// was told of it.
TEST_P(AFixFoundElsewhere, IsNotDrivenFromBeforeAPersonWasTold) {
  lose_and_find_it();
  for (int i = 0; i < 60 * 200 && !is_there(); ++i) rig.tick();
  int cycles = 0;
  for (; cycles < 9.9 * 200; ++cycles) {
    press();
    rig.tick();
    ASSERT_TRUE(is_there());
    ASSERT_EQ(rig.said<CommandAccepted>().size(), 0U) << cycles;
    ASSERT_EQ(rig.fastest_command_radps(), 0) << cycles;
  }
  EXPECT_THAT(refusal(), HasSubstr("jumped by"));
  rig.run_s(0.2);
  expect_drives();
}

/// Nor is one that began before that.
TEST_P(AFixFoundElsewhere, IsNotDrivenFromByATaskThatWasStartedJustBefore) {
  lose_and_find_it();
  for (int i = 0; i < 9 * 200; ++i) {
    press();
    rig.tick();
    ASSERT_FALSE(is_there() && rig.fastest_command_radps() > 0) << i << ": " << rig.why();
  }
}

INSTANTIATE_TEST_SUITE_P(
    AtRest, AFixFoundElsewhere,
    testing::Values(Loss{FixQuality::none, 5, 3, 0}, Loss{FixQuality::none, 5, 3, 0.4},
                    Loss{FixQuality::none, 70, 3, 0}, Loss{FixQuality::none, 70, -1.5, 0.4},
                    Loss{FixQuality::rtk_float, 15, 3, 0}, Loss{FixQuality::rtk_float, 70, 3, 0.4},
                    Loss{FixQuality::single, 15, 3, 0}, Loss{FixQuality::single, 70, -1.5, 0.4},
                    Loss{FixQuality::rtk_float, 15, 0.6, 0.2}));

TEST_F(ARobotWhosePlaceChanges, IsNotToldToJumpWhenItsOriginIsMoved) {
  rig.settle();
  rig.command(SetOrigin{{kRigOrigin.latitude_deg + 1e-4, kRigOrigin.longitude_deg, 500}});
  rig.run_s(5);
  EXPECT_THAT(told(), ::testing::Not(HasSubstr("jumped")));
}

TEST_F(ARobotWhosePlaceChanges, IsToldOfTheWheelsThatAreHeardWhereOneIsNot) {
  rig.settle();
  rig.drives[1].silent = true;
  rig.run_s(1);
  rig.jump_m = 1;
  rig.run_s(30);
  EXPECT_THAT(told(), HasSubstr("though no wheel that is heard turned"));
}

TEST_F(ARobotWhosePlaceChanges, IsNotToldToJumpWhenItRollsOutUnheardAfterAnEstop) {
  drive();
  rig.lines[static_cast<std::size_t>(Line::estop)] = true;
  for (auto& drive : rig.drives) drive.silent = true;
  rig.carried = WheelSpeeds{2, 2};
  rig.run_s(1);
  rig.carried.reset();
  rig.run_s(3);
  rig.lines[static_cast<std::size_t>(Line::estop)] = false;
  for (auto& drive : rig.drives) drive.silent = false;
  rig.run_s(5);
  EXPECT_THAT(told(), ::testing::Not(HasSubstr("jumped")));
}

struct Silence {
  double for_s = 3;             ///< of all wheels, which stand
  double jump_m = 3;            ///< of the receiver meanwhile
  bool lost_meanwhile = false;  ///< it gives no fix until it is elsewhere
  bool imu = false;
};

/// A cable that is loose, drives that begin anew: nobody hears whether the base is pushed, and the
/// receiver is elsewhere after it.
class WheelsSilentWhileTheReceiverJumps : public ARobotWhosePlaceChanges,
                                          public testing::WithParamInterface<Silence> {
 protected:
  void fall_silent() {
    rig.imu = GetParam().imu;
    rig.settle();
    rig.run_s(2);
    for (auto& drive : rig.drives) drive.silent = true;
    if (GetParam().lost_meanwhile) rig.quality = FixQuality::none;
    rig.run_s(GetParam().for_s / 2);
    rig.quality = FixQuality::rtk_fixed;
    rig.jump_m = GetParam().jump_m;
    rig.run_s(GetParam().for_s / 2);
    for (auto& drive : rig.drives) drive.silent = false;
  }
  void expect_in_the_bound_for_s(double seconds) {
    for (int i = 0; i < seconds * 200; ++i) {
      rig.tick();
      const double error_m = std::hypot(rig.snapshot().pose.x_m - rig.plant.truth().x_m,
                                        rig.snapshot().pose.y_m - rig.plant.truth().y_m);
      const double bound_m = rig.snapshot().nav.error_bound_m;
      ASSERT_TRUE(!std::isfinite(bound_m) || error_m <= bound_m)
          << i / 200.0 << " s: " << error_m << " m off, told " << bound_m;
    }
  }
};

TEST_P(WheelsSilentWhileTheReceiverJumps, IsNotDrivenFromBeforeAPersonWasTold) {
  fall_silent();
  bool told = false;
  for (int i = 0; i < 9 * 200 && !told; ++i) {
    rig.log.clear();
    rig.start(path, 40, 0.5);
    rig.tick();
    ASSERT_EQ(rig.said<CommandAccepted>().size(), 0U) << i;
    ASSERT_EQ(rig.fastest_command_radps(), 0) << i;
    const auto refused = rig.said<CommandRefused>();
    told = !refused.empty() && refusal().find("look where it stands") != std::string::npos;
  }
  EXPECT_TRUE(told) << refusal();
  EXPECT_THAT(refusal(), HasSubstr("jumped by"));
  rig.run_s(11);
  expect_drives();
}

/// As long as nobody was told to look: what was lost meanwhile is in it for a minute.
TEST_P(WheelsSilentWhileTheReceiverJumps, HasTheOtherPlaceInItsBound) {
  fall_silent();
  expect_in_the_bound_for_s(GetParam().lost_meanwhile ? 59 - GetParam().for_s / 2 : 120);
}

INSTANTIATE_TEST_SUITE_P(AtRest, WheelsSilentWhileTheReceiverJumps,
                         testing::Values(Silence{3, 3}, Silence{3, -0.6},
                                         Silence{3, 3, false, true}, Silence{6, 3, true},
                                         Silence{30, 3}, Silence{30, -1.5, true}, Silence{30, 0.6},
                                         Silence{30, 0.3, true}, Silence{40, 3, true, true}));

/// Less than anybody pushes it from one fix to the next.
class WheelsSilentWhileTheReceiverJumpsALittle : public WheelsSilentWhileTheReceiverJumps {};

TEST_P(WheelsSilentWhileTheReceiverJumpsALittle, AndHasTheOtherPlaceInItsBound) {
  fall_silent();
  expect_in_the_bound_for_s(120);
}

INSTANTIATE_TEST_SUITE_P(AtRest, WheelsSilentWhileTheReceiverJumpsALittle,
                         testing::Values(Silence{3, 0.1}, Silence{3, 0.2}, Silence{3, 0.3},
                                         Silence{30, -0.2}, Silence{3, 0.15, false, true}));

/// Without power it is pushed by hand, which the receiver follows.
TEST_F(ARobotWhosePlaceChanges, IsStartedAtOnceWhenItWasPushedUnheardWithinSightOfTheReceiver) {
  rig.config.estimate.antenna_sigma_m = 0;  // what the push leaves in the bound is asked for
  rig.engine = std::make_unique<Engine>(rig.config);
  rig.settle();
  rig.run_s(2);
  for (auto& drive : rig.drives) drive.silent = true;
  rig.run_s(3);
  for (const double radps : {2.0, 5.0, 9.0, 5.0, 2.0}) {
    rig.carried = WheelSpeeds{radps, radps};
    rig.run_s(1);
  }
  rig.carried.reset();
  rig.run_s(3);
  for (auto& drive : rig.drives) drive.silent = false;
  rig.run_s(5);
  EXPECT_THAT(told(), ::testing::Not(HasSubstr("jumped")));
  EXPECT_LT(rig.snapshot().nav.error_bound_m, 0.4);
  expect_drives();
}

}  // namespace
}  // namespace drover::engine
