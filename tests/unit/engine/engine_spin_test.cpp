// A robot that was told to turn on the spot, and turns on after its stop: wheels with frozen
// encoders say nothing, a receiver that stands still neither. What is left is gyro and heading.
#include "engine_rest_fixture.h"

namespace drover::engine {
namespace {

constexpr WheelSpeeds kSpinsLeft{-2, 2};
constexpr WheelSpeeds kSpinsRight{2, -2};

class ARobotThatSpins : public ARobotThatShouldRest {
 protected:
  ARobotThatSpins() {
    // Far from its middle the antenna would show a speed.
    rig.config.estimate.antenna_x_m = 0.05;
    rebuild();
  }
  void rebuild() { rig.engine = std::make_unique<Engine>(rig.config); }
  void stand_on_a_slope() {
    rig.config.base.hold = HoldBy::level_ground_only;
    rig.config.base.max_tilt_deg = 10;
    rebuild();
    rig.gravity_mps2 = {9.81 * std::sin(to_rad(8)), 0, 9.81 * std::cos(to_rad(8))};
  }
  void stream(double left_radps, double right_radps, double seconds) {
    JointTargets targets;
    for (AxisId id = 0; id < 4; ++id)
      (void)targets.joints.push_back({id, id % 2 == 0 ? left_radps : right_radps});
    for (int i = 0; i < static_cast<int>(seconds * 50 + 0.5); ++i) {
      rig.command(targets);
      rig.run_s(0.02);
    }
  }
  /// Turned left for a while by a stream of joint commands.
  void spin_left() {
    rig.settle();
    stream(0, 0, 1);
    stream(-2, 2, 2);
    ASSERT_GT(rig.fastest_command_radps(), 0.5) << rig.why();
    ASSERT_GT(rig.plant.truth().wz_radps, 0.2);
  }
  void stop() { rig.command(EngageStop{}); }
};

TEST_F(ARobotThatSpins, LosesItsPowerWhenItTurnsOnAfterAStop) {
  spin_left();
  freeze_encoders();
  rig.disobeys = kSpinsLeft;
  stop();
  ASSERT_TRUE(cut_within_s(2));
  EXPECT_THAT(rig.why(), HasSubstr("the gyro"));
  EXPECT_THAT(rig.why(), HasSubstr("the receiver's heading turned by"));
}

TEST_F(ARobotThatSpins, LosesItsPowerOnASlopeToo) {
  stand_on_a_slope();
  spin_left();
  freeze_encoders();
  rig.disobeys = kSpinsLeft;
  stop();
  ASSERT_TRUE(cut_within_s(2));
  EXPECT_THAT(rig.why(), HasSubstr("the robot did not stop"));
}

TEST_F(ARobotThatSpins, LosesItsPowerOnASlopeWhenItsWheelsTellOfIt) {
  stand_on_a_slope();
  spin_left();
  rig.disobeys = kSpinsLeft;
  stop();
  ASSERT_TRUE(cut_within_s(2));
  EXPECT_THAT(rig.why(), HasSubstr("the wheels turn by"));
}

TEST_F(ARobotThatSpins, KeepsItsPowerWhenItComesToRest) {
  spin_left();
  freeze_encoders();
  stop();
  rest_s(10);
}

TEST_F(ARobotThatSpins, KeepsItsPowerWhenItIsTurnedBack) {
  stand_on_a_slope();
  spin_left();
  freeze_encoders();
  stop();
  rig.run_s(0.3);
  rig.carried = kSpinsRight;
  rest_s(3);
}

TEST_F(ARobotThatSpins, KeepsItsPowerWhenItRollsAwayTurning) {
  stand_on_a_slope();
  spin_left();
  freeze_encoders();
  stop();
  rig.run_s(0.3);
  rig.carried = WheelSpeeds{-4, -1};
  rest_s(3);
}

TEST_F(ARobotThatSpins, KeepsItsPowerWhenOnlyItsHeadingJumps) {
  spin_left();
  freeze_encoders();
  stop();
  rig.run_s(0.4);
  rig.heading_off_deg = -30;  // a compass turns right: this is to the left
  rest_s(10);
}

TEST_F(ARobotThatSpins, WithOneAntennaHasNoSecondWitness) {
  rig.settle();  // the heading of the first seconds
  spin_left();
  rig.no_heading = true;
  freeze_encoders();
  rig.disobeys = kSpinsLeft;
  stop();
  rest_s(3);
}

}  // namespace
}  // namespace drover::engine
