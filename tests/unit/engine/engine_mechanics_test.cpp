// The first way after the start shows wrong mechanics before they hurt.
#include "own/owners_fixture.h"

namespace drover::engine {
namespace {

using ::testing::HasSubstr;

EngineConfig unproved() {
  EngineConfig config = rig_config();
  config.navigate.first_way_m = 0.3;
  return config;
}

class ARobotOnItsFirstWay : public ::testing::Test {
 protected:
  ARobotOnItsFirstWay() {
    rig.imu = true;
    rig.settle();
    rig.start(path, 40, 0.5);
  }
  /// The true way until nothing was commanded any more.
  double stops_after_m() {
    const double before_m = rig.driven_m;
    double last_m = before_m;
    bool moved = false;
    for (int i = 0; i < 20 * 200; ++i) {
      rig.tick();
      if (rig.fastest_command_radps() > 0) {
        moved = true;
        last_m = rig.driven_m;
      }
      if (moved && rig.snapshot().nav.status == NavStatus::error) break;
    }
    EXPECT_EQ(rig.snapshot().nav.status, NavStatus::error);
    return last_m - before_m;
  }
  static std::string end_of(const EngineRig& one) {
    const auto ends = one.said<TaskEnded>();
    return ends.empty() ? "" : std::string(ends[0].reason.view());
  }
  std::string ended() const { return end_of(rig); }
  /// With what reason another one ends its task.
  std::string ended_by_itself(EngineRig& other) const {
    other.settle();
    other.start(path, 40, 0.5);
    for (int i = 0; i < 20 * 200 && other.snapshot().nav.status != NavStatus::error; ++i)
      other.tick();
    return end_of(other);
  }

  Path path = straight_path(20);
  EngineRig rig{unproved()};
};

TEST_F(ARobotOnItsFirstWay, DrivesSlowlyForThirtyCentimetresAndThenAsAsked) {
  double fastest_radps = 0;
  while (rig.driven_m < 0.28) {
    rig.tick();
    fastest_radps = std::max(fastest_radps, rig.fastest_command_radps());
    ASSERT_EQ(rig.snapshot().nav.status, NavStatus::run) << ended();
  }
  EXPECT_LT(fastest_radps * 0.165, 0.09);  // the outer wheel of a turn
  rig.run_s(5);
  EXPECT_GT(rig.fastest_command_radps() * 0.165, 0.45);
}

TEST_F(ARobotOnItsFirstWay, SaysWhyItIsSlowAndHowLongStill) {
  EXPECT_EQ(rig.why(), "") << "before it moves";
  while (rig.driven_m < 0.18) rig.tick();
  EXPECT_THAT(rig.why(),
              testing::StartsWith(
                  "slowly: the wheels, gyro and receiver are compared on the first 0.3 m, 0.1"));
  EXPECT_EQ(rig.snapshot().nav.status, NavStatus::run);
  while (rig.driven_m < 0.4) rig.tick();
  EXPECT_EQ(rig.why(), "");
}

/// Its antenna is 0.2 m ahead: of one that faces the other way the place is 0.4 m beside.
TEST_F(ARobotOnItsFirstWay, HasRoomInItsBoundForAHeadingThatIsTheOtherWayRound) {
  EXPECT_GT(rig.snapshot().nav.error_bound_m, 0.4);
  while (rig.driven_m < 0.1) rig.tick();
  EXPECT_GT(rig.snapshot().nav.error_bound_m, 0.4);
  while (!rig.out.remembered.mechanics_proved && rig.driven_m < 1) rig.tick();
  ASSERT_TRUE(rig.out.remembered.mechanics_proved);
  rig.tick();
  EXPECT_LT(rig.snapshot().nav.error_bound_m, 0.35);
}

TEST_F(ARobotOnItsFirstWay, TakesAPositionThatJumpsForNoWrongRatio) {
  while (rig.driven_m < 0.12) rig.tick();
  rig.aside_m = 0.15;
  while (rig.driven_m < 0.8 && rig.snapshot().nav.status == NavStatus::run) rig.tick();
  EXPECT_EQ(rig.snapshot().nav.status, NavStatus::run) << ended();
  EXPECT_TRUE(rig.out.remembered.mechanics_proved);
}

TEST_F(ARobotOnItsFirstWay, IsNotAskedForAnotherOneAfterARestartOfTheProgram) {
  rig.run_s(2);
  EXPECT_FALSE(rig.out.remembered.mechanics_proved);
  rig.run_s(10);
  ASSERT_TRUE(rig.out.remembered.mechanics_proved) << ended();
  const Remembered left = rig.out.remembered;
  rig.engine = std::make_unique<Engine>(rig.config);
  rig.engine->recall(left, rig.now);
  rig.settle();
  rig.start(path, 40, 0.5);
  rig.run_s(3);
  EXPECT_GT(rig.fastest_command_radps() * 0.165, 0.45) << ended();
}

TEST_F(ARobotOnItsFirstWay, TurnsFiveDegreesToEachSideAndStaysOnItsTrack) {
  double left_rad = 0;
  double right_rad = 0;
  while (rig.driven_m < 0.32) {
    rig.tick();
    left_rad = std::max(left_rad, rig.plant.truth().yaw_rad);
    right_rad = std::min(right_rad, rig.plant.truth().yaw_rad);
    EXPECT_LT(std::abs(rig.plant.truth().y_m), 0.03);
  }
  EXPECT_NEAR(to_deg(left_rad), 5, 2);
  EXPECT_NEAR(to_deg(right_rad), -5, 2);
}

TEST_F(ARobotOnItsFirstWay, FindsAGearRatioOfTen) {
  rig.mechanics.gear = 10;
  EXPECT_LT(stops_after_m(), 0.2);
  EXPECT_THAT(ended(), HasSubstr("gear ratio"));
}

TEST_F(ARobotOnItsFirstWay, FindsAGearRatioOfTwo) {
  rig.mechanics.gear = 2;
  EXPECT_LT(stops_after_m(), 0.2);
  EXPECT_THAT(ended(), HasSubstr("gear ratio"));
}

TEST_F(ARobotOnItsFirstWay, FindsAGearRatioOfAHalf) {
  rig.mechanics.gear = 0.5;
  EXPECT_LT(stops_after_m(), 0.2);
  EXPECT_THAT(ended(), HasSubstr("gear ratio"));
}

TEST_F(ARobotOnItsFirstWay, FindsSwappedSides) {
  rig.mechanics.swapped = true;
  EXPECT_LT(stops_after_m(), 0.2);
  EXPECT_THAT(ended(), HasSubstr("sides swapped"));
}

TEST_F(ARobotOnItsFirstWay, FindsAReversedWheel) {
  rig.mechanics.reversed = true;
  EXPECT_LT(stops_after_m(), 0.2);
  EXPECT_THAT(ended(), HasSubstr("wheel reversed"));
}

/// The mean of each side is as it should be, and its wheels work against each other.
TEST_F(ARobotOnItsFirstWay, FindsSidesThatAreSwappedOnOneAxleAlone) {
  rig.mechanics.crossed = true;
  EXPECT_LT(stops_after_m(), 0.25);
  EXPECT_THAT(ended(), HasSubstr("by the gyro +0: are the sides swapped on one axle "
                                 "(front_left/front_right or rear_left/rear_right)?"));
  EXPECT_FALSE(rig.out.remembered.mechanics_proved);
}

/// Its drives hold them so firmly that not even the wheels turn otherwise than ahead.
TEST_F(ARobotOnItsFirstWay, FindsThemWhereTheDrivesAreTooWeakToSlip) {
  rig.mechanics.crossed = true;
  rig.mechanics.differs = 0.1;
  EXPECT_LT(stops_after_m(), 0.3);
  EXPECT_THAT(ended(), HasSubstr("asked to turn"));
  EXPECT_THAT(ended(), HasSubstr("on one axle"));
}

TEST_F(ARobotOnItsFirstWay, FindsThemByTheReceiverWhereThereIsNoGyro) {
  EngineRig without{unproved()};
  without.mechanics.crossed = true;
  EXPECT_THAT(ended_by_itself(without), HasSubstr("by the receiver"));
  EXPECT_LT(without.driven_m, 0.3);
}

/// Small set points are followed badly, by drives that are healthy.
TEST_F(ARobotOnItsFirstWay, SwingsUntilItWasSeenToTurnToBothSides) {
  rig.mechanics.differs = 0.25;
  double left_rad = 0;
  double then_right_rad = 0;
  while (!rig.out.remembered.mechanics_proved && rig.driven_m < 2) {
    rig.tick();
    ASSERT_EQ(rig.snapshot().nav.status, NavStatus::run) << ended();
    const double yaw_rad = rig.plant.truth().yaw_rad;
    left_rad = std::max(left_rad, yaw_rad);
    then_right_rad = std::max(then_right_rad, left_rad - yaw_rad);
    EXPECT_LT(rig.fastest_command_radps() * 0.165, 0.12);
    EXPECT_LT(std::abs(rig.plant.truth().y_m), 0.05);
  }
  EXPECT_GT(to_deg(left_rad), 2.9);
  EXPECT_GT(to_deg(then_right_rad), 2.9);
  EXPECT_LT(rig.driven_m, 0.7);
}

TEST_F(ARobotOnItsFirstWay, SaysThatItWasNotSeenToTurnYet) {
  rig.mechanics.differs = 0.25;
  while (rig.driven_m < 0.35) rig.tick();
  EXPECT_EQ(rig.why(), "slowly: it was not seen to turn to both sides yet");
}

TEST_F(ARobotOnItsFirstWay, ThatCannotTurnAtAllSaysSo) {
  rig.mechanics.differs = 0;
  EXPECT_LT(stops_after_m(), 0.3);
  EXPECT_THAT(ended(), HasSubstr("asked to turn +24 degrees, by the gyro +0"));
}

TEST_F(ARobotOnItsFirstWay, TellsAGyroThatIsDeadFromWheelsThatDoNotTurnIt) {
  rig.mechanics.gyro = 0;
  EXPECT_LT(stops_after_m(), 0.2);
  EXPECT_THAT(ended(), HasSubstr("is the IMU mounted as configured"));
}

TEST_F(ARobotOnItsFirstWay, FindsDrivesThatRunBackwards) {
  rig.mechanics.gear = -1;
  EXPECT_LT(stops_after_m(), 0.2);
  EXPECT_THAT(ended(), HasSubstr("drives reversed, the heading turned round"));
}

TEST_F(ARobotOnItsFirstWay, TellsAGyroThatTurnsTheOtherWayFromSwappedSides) {
  rig.mechanics.gyro = -1;
  EXPECT_LT(stops_after_m(), 0.2);
  EXPECT_THAT(ended(), HasSubstr("is the IMU mounted as configured"));
}

TEST_F(ARobotOnItsFirstWay, FindsSwappedSidesByTheReceiverWhereThereIsNoGyro) {
  EngineRig without{unproved()};
  without.mechanics.swapped = true;
  EXPECT_THAT(ended_by_itself(without), HasSubstr("by the receiver"));
  EXPECT_LT(without.driven_m, 0.3);
}

TEST_F(ARobotOnItsFirstWay, IsSlowAgainAfterAFailure) {
  rig.mechanics.swapped = true;
  stops_after_m();
  rig.run_s(3);
  rig.mechanics.swapped = false;
  rig.start(path, 40, 0.5);
  rig.run_s(3);
  EXPECT_GT(rig.fastest_command_radps(), 0.2);
  EXPECT_LT(rig.fastest_command_radps() * 0.165, 0.09);
}

TEST_F(ARobotOnItsFirstWay, IsNotSlowInTheNextTask) {
  while (rig.driven_m < 1) rig.tick();
  rig.command(CancelTask{});
  rig.run_s(3);
  rig.start(path, 40, 0.5);
  rig.run_s(3);
  EXPECT_GT(rig.fastest_command_radps() * 0.165, 0.45);
}

TEST_F(ARobotOnItsFirstWay, IsProvedByItsReceiverAloneWhereThereIsNoGyro) {
  EngineRig without{unproved()};
  without.settle();
  without.start(path, 40, 0.5);
  while (without.driven_m < 0.5 && without.now < Time{std::chrono::seconds(60)}) without.tick();
  EXPECT_TRUE(without.out.remembered.mechanics_proved) << without.why();
}

class JointCommandsOnAFirstWay : public JointCommands {
 protected:
  JointCommandsOnAFirstWay() {
    rig = EngineRig(unproved());
    rig.imu = true;
  }
};

TEST_F(JointCommandsOnAFirstWay, AreSlowOnceWhereNothingCanBeCompared) {
  rig.quality = FixQuality::rtk_float;
  rig.settle();
  stream_s(0, 0.5);
  while (rig.driven_m < 0.28) {
    stream_s(2, 0.1);
    ASSERT_LE(rig.fastest_command_radps() * 0.165, 0.051) << rig.driven_m;
    ASSERT_LT(rig.now, Time{std::chrono::seconds(60)}) << reason();
    EXPECT_THAT(reason(),
                testing::StartsWith("slowly: the wheels, gyro and receiver are compared"));
  }
  stream_s(2, 2);
  EXPECT_EQ(reason(), "");
  EXPECT_NEAR(rig.fastest_command_radps(), 2, 1e-9);
  EXPECT_FALSE(rig.out.remembered.mechanics_proved);
  stream_s(0, 4);
  stream_s(2, 2);
  EXPECT_NEAR(rig.fastest_command_radps(), 2, 1e-9) << reason();
}

TEST_F(JointCommandsOnAFirstWay, ThatTurnNothingProveNothing) {
  rig.settle();
  stream_s(0, 0.5);
  for (int i = 0; i < 200 && rig.driven_m < 1; ++i) stream_s(2, 0.1);
  ASSERT_GE(rig.driven_m, 1) << reason();
  EXPECT_EQ(reason(), "");
  EXPECT_FALSE(rig.out.remembered.mechanics_proved);
}

TEST_F(JointCommandsOnAFirstWay, FindARatioOfTwentyByAPositionEachSecond) {
  rig.mechanics.gear = 20;
  rig.receiver_ticks = 200;
  rig.settle();
  rig.run_s(5);
  stream_s(0, 0.5);
  const double from_m = rig.driven_m;
  for (int i = 0; i < 100 && rig.driven_m - from_m < 6; ++i) stream_s(2, 0.1);
  EXPECT_LT(rig.driven_m - from_m, 3) << reason();
  EXPECT_EQ(rig.fastest_command_radps(), 0);
  EXPECT_THAT(reason(), HasSubstr("gear ratio"));
}

class ARobotWithAnIMU : public AnEngine {
 protected:
  ARobotWithAnIMU() { rig.imu = true; }
  void tilt(double deg, double degps) {
    rig.gravity_mps2 = {9.81 * std::sin(to_rad(deg)), 0, 9.81 * std::cos(to_rad(deg))};
    rig.pitch_radps = to_rad(degps);
    rig.tick();
  }
};

TEST_F(ARobotWithAnIMU, ThatIsMountedUpsideDownRefusesAStart) {
  rig.gravity_mps2 = {0, 0, -9.81};
  rig.settle();
  rig.start(path, 40, 0.5);
  rig.tick();
  EXPECT_THAT(refusal(), HasSubstr("gravity on the wrong axis"));
}

TEST_F(ARobotWithAnIMU, ThatIsMountedUpsideDownIsNamedStillWhenItsDriverRejectsIt) {
  rig.gravity_mps2 = {0, 0, -9.81};
  rig.settle();
  rig.imu = false;
  rig.environment.imu[0].state = SourceState::stale;
  rig.run_s(2);
  rig.start(path, 40, 0.5);
  rig.tick();
  EXPECT_THAT(refusal(), HasSubstr("gravity on the wrong axis"));
}

TEST_F(ARobotWithAnIMU, ThatIsMountedOnItsSideRefusesAStart) {
  rig.gravity_mps2 = {0, 9.81, 0};
  rig.settle();
  rig.start(path, 40, 0.5);
  rig.tick();
  EXPECT_THAT(refusal(), HasSubstr("gravity on the wrong axis"));
}

TEST_F(ARobotWithAnIMU, StopsAndHoldsWhenItTiltsTooFar) {
  drive();
  rig.run_s(2);  // the gyro's zero is learned at rest
  for (int i = 0; i <= 100; ++i) tilt(0.3 * i, -60);
  for (int i = 0; i < 80; ++i) tilt(30, 0);
  EXPECT_EQ(rig.fastest_command_radps(), 0);
  EXPECT_THAT(rig.why(), HasSubstr("tilted by more than 25 degrees"));
  EXPECT_NE(rig.out.axes[0].request, AxisRequest::idle);
}

TEST_F(ARobotWithAnIMU, DrivesUpASlopeOfEightDegrees) {
  drive();
  rig.gravity_mps2 = {9.81 * std::sin(to_rad(8)), 0, 9.81 * std::cos(to_rad(8))};
  rig.run_s(6);
  EXPECT_GT(rig.fastest_command_radps(), 1) << rig.why();
}

}  // namespace
}  // namespace drover::engine
