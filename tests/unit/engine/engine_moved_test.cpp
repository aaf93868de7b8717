// What is pushed or carried, or rolls, is told; it keeps its power, and does not start.
#include "engine_rest_fixture.h"

namespace drover::engine {
namespace {

TEST_F(ARobotThatShouldRest, ThatIsCarriedAwayIsToldAndNotCut) {
  drive();
  rig.command(CancelTask{});
  rest_s(4);
  freeze_encoders();
  rig.carried = kCircle;
  rest_s(5);
  EXPECT_THAT(told(), HasSubstr("pushed or carried"));
  rig.start(path, 40, 0.5);
  rig.tick();
  EXPECT_THAT(refusal(), HasSubstr("pushed or carried"));
  rig.carried.reset();
  rest_s(5);
  EXPECT_THAT(rig.why(), ::testing::Not(HasSubstr("carried")));
}

/// They may have let go of it: a person was not seen.
TEST_F(ARobotThatShouldRest, ThatMovesWhileItsDrivesAreSilentIsNotSaidToBePushed) {
  drive();
  rig.command(CancelTask{});
  rest_s(4);
  for (auto& drive : rig.drives) drive.silent = true;
  rig.carried = kRollsBack;
  rest_s(5);
  EXPECT_THAT(told(), HasSubstr("moves without a command: the wheels are silent"));
  EXPECT_THAT(told(), ::testing::Not(HasSubstr("pushed or carried")));
}

/// Nor are they heard when the e-stop took their power.
TEST_F(ARobotThatShouldRest, ThatIsPushedWithoutItsPowerIsSaidToBe) {
  drive();
  rig.command(CancelTask{});
  rest_s(4);
  rig.lines[static_cast<std::size_t>(Line::estop)] = true;
  for (auto& drive : rig.drives) drive.silent = true;
  rig.run_s(1);
  rig.carried = kRollsBack;
  rig.run_s(5);
  EXPECT_THAT(told(), HasSubstr("pushed or carried: the wheels are silent"));
}

TEST_F(ARobotThatShouldRest, ThatIsPushedSoThatItsWheelsTurnIsToldAndNotCut) {
  drive();
  rig.command(CancelTask{});
  rest_s(4);
  rig.carried = WheelSpeeds{1, 1};
  rest_s(5);
  EXPECT_THAT(told(), HasSubstr("rolls without a command"));
  rig.start(path, 40, 0.5);
  rig.tick();
  EXPECT_THAT(refusal(), HasSubstr("rolls without a command"));
}

TEST_F(ARobotThatShouldRest, RefusesAStartWhileItRollsSinceItsBeginning) {
  rig.carried = WheelSpeeds{1, 1};
  rig.settle();
  rig.start(path, 40, 0.5);
  rig.tick();
  EXPECT_THAT(refusal(), HasSubstr("without a command"));
  rest_s(5);
}

TEST_F(ARobotThatShouldRest, RefusesAStartFromTheFirstMomentsOnWhileItRollsFast) {
  rig.carried = kRollsFast;
  rig.tick();
  rig.set_origin();
  for (int i = 0; i < 60; ++i) {
    rig.run_s(0.05);
    rig.start(path, 40, 0.5);
    rig.tick();
    ASSERT_NE(rig.snapshot().nav.status, NavStatus::run) << 0.05 * i << " s";
  }
  EXPECT_THAT(refusal(), HasSubstr("without a command: the wheels turn by -1.6"));
  EXPECT_THAT(told(), HasSubstr("without a command: the wheels turn by -1.6"));
}

TEST_F(ARobotThatShouldRest, EndsAStartWhileWhoseDrivesAreArmedItBeginsToRoll) {
  rig.settle();
  for (auto& drive : rig.drives) drive.refuses = true;
  rig.start(path, 40, 0.5);
  rig.run_s(0.1);
  ASSERT_EQ(rig.snapshot().nav.status, NavStatus::run) << rig.why();
  rig.carried = kRollsBack;
  rig.run_s(0.4);
  EXPECT_EQ(rig.snapshot().nav.status, NavStatus::error);
  ASSERT_EQ(rig.said<NavigationNotStarted>().size(), 1U);
  EXPECT_THAT(std::string(rig.said<NavigationNotStarted>()[0].reason.view()),
              HasSubstr("rolls without a command"));
}

TEST_F(ARobotThatShouldRest, IsNotToldToRollWhenAnArmingDriveSwingsItsWheel) {
  rig.settle();
  rig.run_s(1);
  rig.carried = WheelSpeeds{-1, -1};
  rig.run_s(0.1);
  rig.carried = WheelSpeeds{1, 1};
  rig.run_s(0.15);
  rig.carried.reset();
  rig.run_s(2);
  EXPECT_THAT(told(), ::testing::Not(HasSubstr("without a command")));
}

TEST_F(ARobotThatShouldRest, KeepsItsPowerWhenSomebodyReleasesAndPushesItHalfASecondAfterAStop) {
  drive();
  rig.command(CancelTask{});
  for (int i = 0; i < 400 && rig.fastest_command_radps() > 0; ++i) rig.tick();
  rig.run_s(0.5);
  rig.command(ReleaseHold{true});
  rig.tick();
  ASSERT_EQ(rig.snapshot().hold, HoldState::released) << refusal();
  rig.carried = kStraight;
  rig.run_s(2);
  EXPECT_TRUE(relay()) << rig.why();
  EXPECT_FALSE(rig.snapshot().stop_latched);
  rig.carried = WheelSpeeds{0.2, 0.2};
  rig.command(ArmHold{});
  rig.run_s(3);
  EXPECT_EQ(rig.snapshot().hold, HoldState::held);
  EXPECT_FALSE(rig.snapshot().stop_latched) << rig.why();
}

TEST(RobotsThatShouldRest, KeepTheirPowerWhoeverPushesThem) {
  for (int seed = 1; seed <= seeds(); ++seed) {
    Any any(seed);
    EngineRig rig;
    const Path path = straight_path(20);
    rig.imu = any(0, 1) < 0.7;
    rig.tells_speed = true;
    rig.settle();
    rig.start(path, 40, 0.5);
    rig.run_s(any(1.5, 5));
    for (auto& drive : rig.drives) drive.stuck = any(0, 1) < 0.5;
    rig.command(CancelTask{});
    if (any(0, 1) < 0.5) {
      rig.quality = FixQuality::rtk_float;
      rig.speed_noise_mps = 0.3;
    }
    rig.run_s(any(2.5, 6));
    for (auto& drive : rig.drives) drive.stuck = true;
    rig.carried = WheelSpeeds{any(-9, 9), any(-9, 9)};
    rig.run_s(any(0.2, 6));
    rig.carried.reset();
    rig.run_s(2);
    EXPECT_NE(rig.out.axes[0].request, AxisRequest::idle) << "seed " << seed << " " << rig.why();
  }
}

}  // namespace
}  // namespace drover::engine
