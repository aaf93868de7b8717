// Stops that do not work lose their power.
#include "engine_rest_fixture.h"

namespace drover::engine {
namespace {

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

// Drives whose encoders are frozen push with all that they have.
TEST_F(ARobotThatShouldRest, LosesItsPowerAtOnceWhenItIsFasterThanItMayBeAndItsWheelsDoNotShowIt) {
  drive();
  freeze_encoders();
  rig.disobeys = WheelSpeeds{12, 12};  // 2 m/s
  const double before_m = rig.driven_m;
  ASSERT_TRUE(cut_within_s(0.5));
  EXPECT_LT(rig.driven_m - before_m, 0.8);
  EXPECT_THAT(rig.why(), HasSubstr("runs away"));
  EXPECT_THAT(rig.why(), HasSubstr("the receiver says 1."));
  EXPECT_TRUE(rig.snapshot().stop_latched);
}

TEST_F(ARobotThatShouldRest, IsNotCutWhileItDrivesForAReceiverThatJumpsOrTellsOneWildSpeed) {
  drive();
  rig.jump_m = 3;
  EXPECT_FALSE(cut_within_s(0.5));
  rig.jump_m = 0;
  rig.speed_noise_mps = 3;
  EXPECT_FALSE(cut_within_s(1)) << rig.why();
}

TEST_F(ARobotThatShouldRest, IsNotCutForAReceiverWhoseSpeedsAreWild) {
  drive();
  rig.speed_noise_mps = 3;
  EXPECT_FALSE(cut_within_s(20)) << rig.why();
}

TEST_F(ARobotThatShouldRest, LosesItsPowerWhenAPersonStopsWhatSomebodyElseDrives) {
  drive();
  rig.command(CancelTask{});
  rest_s(5);
  rig.disobeys = WheelSpeeds{1, 1};  // too slow for a wheel that runs away
  rest_s(3);
  EXPECT_THAT(told(), HasSubstr("rolls without a command"));
  rig.command(EngageStop{});
  EXPECT_TRUE(cut_within_s(2)) << rig.why();
}

TEST_F(ARobotThatShouldRest, LosesItsPowerWhenAPersonStopsWhatItsFrozenEncodersDoNotShow) {
  drive();
  rig.command(CancelTask{});
  rest_s(5);
  freeze_encoders();
  rig.disobeys = kStraight;
  rest_s(3);
  EXPECT_THAT(told(), HasSubstr("pushed or carried"));
  rig.command(EngageStop{});
  EXPECT_TRUE(cut_within_s(2)) << rig.why();
}

/// Drives without a time-out of their own: the one that is silent might go on, and is seen not to.
TEST_F(ARobotThatShouldRest, IsNotCutWhenOneDriveOfFourIsSilentAndTheOthersHoldIt) {
  rig.environment.drives_on_in_silence = true;
  drive();
  rig.drives[0].silent = true;
  rest_s(10);
  EXPECT_EQ(rig.fastest_command_radps(), 0);
  rig.command(EngageStop{});
  rest_s(10);
}

TEST_F(ARobotThatShouldRest, LosesItsPowerWhenOneDriveIsSilentAndTheRobotTurns) {
  rig.environment.drives_on_in_silence = true;
  drive();
  for (auto& drive : rig.drives) drive.stuck = true;
  rig.drives[0].silent = true;
  rig.disobeys = WheelSpeeds{1, -1};
  EXPECT_TRUE(cut_within_s(4)) << rig.why();
}

/// Its drives refuse us since another program commands them.
TEST_F(ARobotThatShouldRest, LosesItsPowerWhenAnotherProgramDrivesIt) {
  drive();
  for (auto& drive : rig.drives) drive.fault = true;
  rig.disobeys = kStraight;
  EXPECT_TRUE(cut_within_s(4)) << rig.why();
}

TEST_F(ARobotThatShouldRest, LosesItsPowerWhenAPersonStopsWhatAnotherProgramDrives) {
  drive();
  rig.command(CancelTask{});
  rest_s(5);
  for (auto& drive : rig.drives) drive.fault = true;
  rig.disobeys = WheelSpeeds{-2, -2};
  rest_s(3);
  rig.command(EngageStop{});
  EXPECT_TRUE(cut_within_s(3)) << rig.why();
}

TEST_F(ARobotThatShouldRest, IsNotCutForWheelsThatSlipAtAllowedSpeeds) {
  drive();
  freeze_encoders();
  rig.disobeys = WheelSpeeds{6, 6};  // 1 m/s
  EXPECT_FALSE(cut_within_s(0.4)) << rig.why();
}

/// A base without a brake, and its e-stop is let go before it stands: 0.15 m/s2, as hard tyres on
/// concrete.
TEST_F(ARobotThatShouldRest, IsNotCutWhileItRollsOutOfWhatTheEstopTookThePower) {
  drive();
  const auto feed = [this](bool power) {
    for (auto& drive : rig.drives) drive.silent = !power;
    rig.lines[static_cast<std::size_t>(Line::estop)] = !power;
  };
  double radps = 3;
  for (int i = 0; i < 200 * 6; ++i) {
    feed(i >= 300);
    radps = std::max(0.0, radps - 0.9 * 0.005);
    rig.carried = WheelSpeeds{radps, radps};
    rig.tick();
    ASSERT_THAT(told(), Not(HasSubstr("did not stop"))) << i;
  }
  rig.carried.reset();
  rig.run_s(3);
  drive_again();
}

TEST_F(ARobotThatShouldRest, LosesItsPowerWhenItGoesOnAfterTheEstopWasLetGo) {
  drive();
  rig.lines[static_cast<std::size_t>(Line::estop)] = true;
  rig.disobeys = kStraight;
  rig.run_s(1);
  rig.lines[static_cast<std::size_t>(Line::estop)] = false;
  rig.run_s(4);
  EXPECT_THAT(told(), HasSubstr("did not stop"));
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

TEST_F(ARobotThatShouldRest, PublishesTheWorseOfTwoSpeeds) {
  drive();
  rig.disobeys = WheelSpeeds{20, 20};
  freeze_encoders();
  rig.run_s(0.35);
  EXPECT_GT(rig.snapshot().worst_vx_mps, 2);
  EXPECT_LT(std::abs(rig.snapshot().pose.vx_mps), 1);
}

TEST_F(ARobotThatShouldRest, DoesNotPublishTheSpeedBeforeAStopAsTheSpeedAfterIt) {
  drive();
  rig.run_s(3);
  ASSERT_GT(rig.snapshot().worst_vx_mps, 0.4);
  rig.command(EngageStop{});
  for (int i = 0; i < 200; ++i) {
    rig.tick();
    const auto& seen = rig.snapshot();
    ASSERT_NEAR(seen.worst_vx_mps, seen.pose.vx_mps, 1e-9) << 5 * i << " ms after the stop";
  }
}

TEST(RobotsThatShouldRest, LoseTheirPowerHoweverTheyGoOn) {
  for (int seed = 1; seed <= seeds(); ++seed) {
    Any any(seed);
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

}  // namespace
}  // namespace drover::engine
