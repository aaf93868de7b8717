// On a slope a robot without power would roll away: it loses it only when it drives on.
#include "engine_rest_fixture.h"

namespace drover::engine {
namespace {

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

/// A cable is torn: what keeps its last command drives on, and says nothing of it.
TEST_F(ARobotOnASlope, LosesItsPowerWhenItsDrivesFallSilentAndGoOn) {
  drive_up();
  rig.environment.drives_on_in_silence = true;
  for (auto& drive : rig.drives) drive.silent = true;
  rig.disobeys = kStraight;
  EXPECT_TRUE(cut_within_s(4));
}

TEST_F(ARobotOnASlope, KeepsItsPowerWhenItsDrivesFallSilentAndStopByThemselves) {
  drive_up();
  for (auto& drive : rig.drives) drive.silent = true;
  rig.disobeys = kStraight;
  EXPECT_FALSE(cut_within_s(4)) << "they have let go: it rolls, whoever has the power";
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
  /// The drives boot idle.
  void supply_comes_back() {
    for (auto& drive : rig.drives) drive = {.position_rad = drive.position_rad};
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

// Driving down, what rolls goes the way that it was driven.
TEST_F(ARobotOnASlopeThatIsAllowed, IsCaughtAndNotCutWhenItsDrivesLoseTheirSupplyOnTheWayDown) {
  drive_up();
  for (auto& drive : rig.drives) drive = {.silent = true, .position_rad = drive.position_rad};
  rig.carried = WheelSpeeds{6, 6};
  rest_s(1.5);
  supply_comes_back();
  for (int i = 0; i < 200 && rig.drives[0].state != AxisState::running; ++i) rig.tick();
  rig.carried.reset();
  rest_s(5);
  EXPECT_EQ(rig.snapshot().hold, HoldState::held);
}

TEST_F(ARobotOnASlopeThatIsAllowed, IsNotCutWhenItsDrivesLoseTheirSupplyAtItsRest) {
  stop();
  for (auto& drive : rig.drives) drive = {.silent = true, .position_rad = drive.position_rad};
  rig.carried = WheelSpeeds{6, 6};
  rest_s(1.5);
  supply_comes_back();
  rest_s(0.1);
  rig.carried.reset();
  rest_s(5);
}

// A slope does not end where the inertial sensor ends.
TEST_F(ARobotOnASlopeThatIsAllowed, KeepsItsPowerWhenItSwingsBackAndTheImuIsSilent) {
  stop();
  rig.imu = false;
  rig.environment.imu[0].state = SourceState::stale;
  rest_s(0.5);
  rig.carried = WheelSpeeds{-0.5, -0.5};
  rest_s(2);
}

TEST_F(ARobotOnASlope, IsNotOnLevelGroundBecauseItsImuFellSilent) {
  drive_up();
  stop_on_the_slope();
  rig.imu = false;
  rig.environment.imu[0].state = SourceState::stale;
  rest_s(3);
  EXPECT_THAT(told(), testing::Not(HasSubstr("on level ground again")));
  rig.start(path, 40, 0.5);
  rig.tick();
  EXPECT_THAT(refusal(), HasSubstr("the ground falls by"));
}

TEST_F(ARobotOnASlope, StopsWhenNobodyKnowsHowSteepTheGroundIs) {
  drive();
  rig.imu = false;
  rig.environment.imu[0].state = SourceState::stale;
  rig.run_s(0.8);
  EXPECT_EQ(rig.snapshot().nav.status, NavStatus::run) << rig.why();
  rig.run_s(2);
  EXPECT_EQ(rig.snapshot().nav.status, NavStatus::error);
  EXPECT_THAT(rig.why(), HasSubstr("how steep the ground is"));
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

}  // namespace
}  // namespace drover::engine
