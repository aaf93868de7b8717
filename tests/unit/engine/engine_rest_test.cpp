// Stops that do not work lose their power; what is pushed or carried is told and no more.
#include <cstdlib>
#include <random>

#include "engine_fixture.h"

namespace drover::engine {
namespace {

using ::testing::HasSubstr;

constexpr WheelSpeeds kStraight{3, 3};  // about 0.5 m/s
constexpr WheelSpeeds kCircle{1, 4};
constexpr WheelSpeeds kRollsBack{-1.5, -1.5};
constexpr WheelSpeeds kRollsFast{-10, -10};  // 1.65 m/s

class ARobotThatShouldRest : public AnEngine {
 protected:
  ARobotThatShouldRest() {
    rig.imu = true;
    rig.tells_speed = true;
  }
  void freeze_encoders() {
    for (auto& drive : rig.drives) drive.stuck = true;
  }
  bool relay() const { return rig.out.outputs[static_cast<std::size_t>(Output::enable_relay)]; }
  bool lets_go() const { return rig.out.axes[0].request == AxisRequest::idle; }
  /// Whether the power was cut meanwhile.
  bool cut_within_s(double seconds) {
    for (int i = 0; i < static_cast<int>(seconds * 200 + 0.5); ++i) {
      rig.tick();
      if (lets_go()) return true;
    }
    return false;
  }
  void drive_again() {
    rig.start(path, 40, 0.5);
    rig.run_s(3);
    EXPECT_GT(rig.fastest_command_radps(), 1) << rig.why();
  }
  void rest_s(double seconds) {
    rig.run_s(seconds);
    ASSERT_FALSE(lets_go());
    ASSERT_TRUE(relay());
  }
  std::string told() const {
    std::string all;
    for (const Notice& notice : rig.said<Notice>()) all += std::string(notice.text.view()) + "\n";
    return all;
  }
};

TEST_F(ARobotThatShouldRest, LosesItsPowerWhenItCirclesWithFrozenEncodersAfterAStop) {
  drive();
  rig.disobeys = kCircle;
  freeze_encoders();
  rig.command(EngageStop{});
  const double before_m = rig.driven_m;
  ASSERT_TRUE(cut_within_s(2));
  EXPECT_LT(rig.driven_m - before_m, 0.8);
  EXPECT_THAT(rig.why(), HasSubstr("did not stop"));
  EXPECT_THAT(rig.why(), HasSubstr("the receiver says"));
  EXPECT_TRUE(rig.snapshot().stop_latched);
  rig.run_s(2);
  EXPECT_FALSE(relay());
}

TEST_F(ARobotThatShouldRest, LosesItsPowerWhenItDrivesStraightOnWithFrozenEncoders) {
  drive();
  rig.disobeys = kStraight;
  freeze_encoders();
  rig.command(CancelTask{});
  EXPECT_TRUE(cut_within_s(3));
}

TEST_F(ARobotThatShouldRest, LosesItsPowerWhenItsWheelsGoOn) {
  drive();
  rig.disobeys = kStraight;
  rig.command(CancelTask{});
  ASSERT_TRUE(cut_within_s(2));
  EXPECT_THAT(rig.why(), HasSubstr("the wheels turn by 0.5"));
}

TEST_F(ARobotThatShouldRest, FirstLetsTheDrivesGoAndThenTheRelay) {
  drive();
  rig.disobeys = kStraight;
  rig.command(CancelTask{});
  ASSERT_TRUE(cut_within_s(2));
  EXPECT_EQ(rig.fastest_command_radps(), 0);
  EXPECT_TRUE(relay());
  rig.run_s(2);
  EXPECT_FALSE(relay());
}

TEST_F(ARobotThatShouldRest, StaysCutUntilSomebodyAtTheRobotResetsIt) {
  drive();
  rig.disobeys = kStraight;
  rig.command(CancelTask{});
  ASSERT_TRUE(cut_within_s(2));
  rig.run_s(4);
  rig.command(ResetStop{});  // the rig speaks over MQTT
  rig.tick();
  EXPECT_THAT(refusal(), HasSubstr("at the robot"));
  rig.start(path, 40, 0.5);
  rig.tick();
  EXPECT_THAT(refusal(), HasSubstr("reset the stop first"));
  rig.disobeys.reset();
  rig.engine->on_command({{RequestId::Source::cli, 99}, rig.now, ResetStop{}}, rig.now);
  rig.run_s(1);
  EXPECT_TRUE(relay());
  EXPECT_FALSE(lets_go());
  EXPECT_FALSE(rig.snapshot().stop_latched);
}

TEST_F(ARobotThatShouldRest, IsResetThoughItRolledFarBeforeItsRest) {
  drive();
  rig.disobeys = WheelSpeeds{12, 12};
  freeze_encoders();
  rig.command(EngageStop{});
  ASSERT_TRUE(cut_within_s(2));
  rig.carried = WheelSpeeds{6, 6};
  rig.run_s(2);
  rig.carried = WheelSpeeds{0, 0};
  rig.disobeys.reset();
  for (auto& drive : rig.drives) drive.stuck = false;
  rig.run_s(4);
  rig.engine->on_command({{RequestId::Source::cli, 99}, rig.now, ResetStop{}}, rig.now);
  rig.run_s(1);
  EXPECT_FALSE(rig.snapshot().stop_latched) << refusal();
}

TEST_F(ARobotThatShouldRest, IsNotResetWhileItStillMoves) {
  drive();
  rig.disobeys = kStraight;
  rig.command(CancelTask{});
  ASSERT_TRUE(cut_within_s(2));
  rig.carried = kStraight;
  rig.run_s(2);
  rig.engine->on_command({{RequestId::Source::cli, 99}, rig.now, ResetStop{}}, rig.now);
  rig.tick();
  EXPECT_THAT(refusal(), HasSubstr("still moves"));
}

TEST_F(ARobotThatShouldRest, StopsAsEverWhenAllIsWell) {
  drive();
  rig.command(CancelTask{});
  rest_s(5);
  drive_again();
}

TEST_F(ARobotThatShouldRest, IsNotCutByFrozenEncodersAlone) {
  drive();
  freeze_encoders();
  rig.command(EngageStop{});
  rest_s(30);
}

TEST_F(ARobotThatShouldRest, IsNotCutByAFloatReceiverThatTellsNoise) {
  rig.quality = FixQuality::rtk_float;
  rig.speed_noise_mps = 0.3;
  rig.settle();
  rest_s(60);
}

TEST_F(ARobotThatShouldRest, IsNotCutByAFloatReceiversNoiseAfterADrive) {
  drive();
  rig.quality = FixQuality::rtk_float;
  rig.speed_noise_mps = 0.3;
  rig.command(CancelTask{});
  rest_s(30);
}

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

// Held by nothing but its drives, on ground that falls by 8 degrees.
class ARobotOnASlope : public ARobotThatShouldRest {
 protected:
  ARobotOnASlope() {
    rig.config.base.hold = HoldBy::level_ground_only;
    rig.engine = std::make_unique<Engine>(rig.config);
  }
  void drive_up() {
    drive();
    rig.gravity_mps2 = {9.81 * std::sin(to_rad(8)), 0, 9.81 * std::cos(to_rad(8))};
  }
  void stop_on_the_slope() {
    for (int i = 0; i < 2000 && rig.snapshot().nav.status != NavStatus::error; ++i) rig.tick();
    ASSERT_THAT(rig.why(), HasSubstr("the ground falls by"));
  }
};

TEST_F(ARobotOnASlope, LosesItsPowerWhenItDrivesOn) {
  drive_up();
  stop_on_the_slope();
  rig.disobeys = kStraight;
  ASSERT_TRUE(cut_within_s(2));
  EXPECT_THAT(rig.why(), HasSubstr("did not stop"));
}

TEST_F(ARobotOnASlope, LosesItsPowerWhenItDrivesOnWithFrozenEncoders) {
  drive_up();
  freeze_encoders();
  rig.disobeys = kStraight;
  EXPECT_TRUE(cut_within_s(4));
}

TEST_F(ARobotOnASlope, KeepsItsPowerWhenItRollsBack) {
  drive_up();
  stop_on_the_slope();
  rig.carried = kRollsBack;
  rest_s(5);
  EXPECT_THAT(told(), HasSubstr("the robot moves without a command"));
}

TEST_F(ARobotOnASlope, KeepsItsPowerWhenItRollsDownToLevelGround) {
  drive_up();
  stop_on_the_slope();
  rig.carried = kRollsBack;
  rest_s(2);
  rig.gravity_mps2 = {0, 0, 9.81};
  rest_s(3);
}

// It may stop here (10 degrees are allowed), and would roll all the same without power.
class ARobotOnASlopeThatIsAllowed : public ARobotOnASlope {
 protected:
  ARobotOnASlopeThatIsAllowed() {
    rig.config.base.max_tilt_deg = 10;
    rig.engine = std::make_unique<Engine>(rig.config);
  }
  void stop() {
    drive_up();
    rig.run_s(1);
    rig.command(CancelTask{});
    for (int i = 0; i < 400 && rig.fastest_command_radps() > 0; ++i) rig.tick();
    rig.run_s(0.3);
  }
};

TEST_F(ARobotOnASlopeThatIsAllowed, KeepsItsPowerWhenItSwingsBackAfterAStop) {
  stop();
  rig.carried = WheelSpeeds{-0.5, -0.5};  // 0.08 m/s
  rest_s(2);
  EXPECT_THAT(told(), HasSubstr("the robot moves without a command"));
}

TEST_F(ARobotOnASlopeThatIsAllowed, KeepsItsPowerWhenItSwingsTheWayThatItDrove) {
  stop();
  rig.carried = WheelSpeeds{0.5, 0.5};
  rest_s(0.3);
  rig.carried.reset();
  rest_s(2);
}

TEST_F(ARobotOnASlopeThatIsAllowed, LosesItsPowerWhenItDrivesOn) {
  stop();
  rig.disobeys = kStraight;
  EXPECT_TRUE(cut_within_s(1.5));
}

TEST_F(ARobotOnASlope, KeepsItsPowerWhenItIsCaughtAndRollsOn) {
  drive_up();
  stop_on_the_slope();
  rig.run_s(0.9);  // its ramp; not yet the second that confirms its rest
  rig.carried = kRollsBack;
  rig.run_s(0.2);
  for (auto& drive : rig.drives) drive.state = AxisState::idle;
  rig.run_s(0.1);
  ASSERT_EQ(rig.snapshot().hold, HoldState::catching);
  rest_s(5);
  EXPECT_EQ(rig.snapshot().hold, HoldState::held) << "the drives run again, and do not hold it";
}

/// More of them by DROVER_SEEDS.
int seeds() {
  const char* asked = std::getenv("DROVER_SEEDS");
  return asked == nullptr ? 4 : std::max(1, std::atoi(asked));
}

TEST(RobotsThatShouldRest, LoseTheirPowerHoweverTheyGoOn) {
  for (int seed = 1; seed <= seeds(); ++seed) {
    std::mt19937 random(static_cast<unsigned>(seed));
    const auto any = [&random](double low, double high) {
      return low + (high - low) * std::uniform_real_distribution<>()(random);
    };
    EngineRig rig;
    const Path path = straight_path(20);
    rig.imu = rig.tells_speed = true;
    rig.settle();
    rig.start(path, 40, 0.5);
    rig.run_s(any(1.5, 8));
    const bool frozen = any(0, 1) < 0.7;
    const double radps = any(2.5, 12);
    rig.disobeys = WheelSpeeds{radps, any(0, 1) < 0.5 ? radps : any(0, 0.8) * radps};
    for (auto& drive : rig.drives) drive.stuck = frozen;
    rig.command(EngageStop{});
    const double before_m = rig.driven_m;
    int ticks = 0;
    while (rig.out.axes[0].request != AxisRequest::idle && ticks < 1000) {
      rig.tick();
      ++ticks;
    }
    EXPECT_LT(ticks * 0.005, 2.0) << "seed " << seed << ", " << rig.driven_m - before_m << " m";
    rig.run_s(2);
    EXPECT_FALSE(rig.out.outputs[static_cast<std::size_t>(Output::enable_relay)]) << seed;
  }
}

TEST(RobotsThatShouldRest, KeepTheirPowerWhoeverPushesThem) {
  for (int seed = 1; seed <= seeds(); ++seed) {
    std::mt19937 random(static_cast<unsigned>(seed));
    const auto any = [&random](double low, double high) {
      return low + (high - low) * std::uniform_real_distribution<>()(random);
    };
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

TEST_F(ARobotThatShouldRest, PublishesTheWorseOfTwoSpeeds) {
  drive();
  rig.disobeys = WheelSpeeds{20, 20};
  freeze_encoders();
  rig.run_s(0.35);
  EXPECT_GT(rig.snapshot().worst_vx_mps, 2);
  EXPECT_LT(std::abs(rig.snapshot().pose.vx_mps), 1);
}

}  // namespace
}  // namespace drover::engine
