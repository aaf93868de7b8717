// A person's word that the receiver is right, after it contradicted the wheels.
#include "engine_fixture.h"

namespace drover::engine {
namespace {

using ::testing::HasSubstr;

class APersonWhoLooked : public AnEngine {
 protected:
  APersonWhoLooked() { rig.imu = true; }
  void accept() {
    rig.command(AcceptPosition{});
    rig.tick();
  }
  void expect_accepted() {
    const std::size_t before = rig.said<CommandAccepted>().size();
    accept();
    EXPECT_EQ(rig.said<CommandAccepted>().size(), before + 1) << refusal();
  }
  void expect_refused(const std::string& reason) {
    const std::size_t before = rig.said<CommandRefused>().size();
    accept();
    ASSERT_EQ(rig.said<CommandRefused>().size(), before + 1);
    EXPECT_THAT(refusal(), HasSubstr(reason));
  }
  /// The fixed receiver goes away to the left, until the task ends by it.
  void drift_aside() {
    path = straight_path(60);
    rig.settle();
    rig.start(path, 120, 0.5);
    rig.run_s(30);
    for (int i = 0; i < 600 && rig.snapshot().nav.status == NavStatus::run; ++i) {
      rig.aside_m += 0.002;
      rig.run_s(0.1);
    }
    rig.run_s(3);
    ASSERT_THAT(rig.why(), HasSubstr("drifts away from odometry"));
  }
  void drift_back() {
    for (; rig.aside_m > 0; rig.aside_m -= 0.002) rig.run_s(0.1);
    rig.aside_m = 0;
  }
  void expect_start_refused(const std::string& reason) {
    rig.start(path, 120, 0.5);
    rig.tick();
    EXPECT_THAT(refusal(), HasSubstr(reason));
    expect_no_motion_for_s(1);
  }
  void expect_drives() {
    rig.start(path, 120, 0.5);
    rig.run_s(3);
    EXPECT_GT(rig.fastest_command_radps(), 1) << rig.why() << refusal();
  }
};

TEST_F(APersonWhoLooked, EndsWhatADriftLeftBehind) {
  drift_aside();
  rig.run_s(60);
  expect_start_refused("drover position accept");
  expect_accepted();
  rig.run_s(1);
  EXPECT_NEAR(rig.snapshot().pose.y_m, rig.aside_m + rig.plant.truth().y_m, 0.05);
  EXPECT_EQ(rig.snapshot().nav.locate, LocateState::good) << rig.why();
  expect_drives();
}

TEST_F(APersonWhoLooked, IsNeededAlsoWhenTheFixWasLostMeanwhile) {
  drift_aside();
  rig.quality = FixQuality::rtk_float;
  rig.run_s(20);
  rig.quality = FixQuality::rtk_fixed;
  rig.run_s(60);
  expect_start_refused("drover position accept");
}

TEST_F(APersonWhoLooked, IsNotNeededWhenThePositionHasComeBack) {
  drift_aside();
  drift_back();
  expect_start_refused("drover position accept");  // it is not back for 10 s yet
  rig.run_s(10);
  expect_drives();
}

TEST_F(APersonWhoLooked, IsNotAskedToLookAgainAfterAJump) {
  rig.settle();
  rig.jump_m = 1.9;
  rig.run_s(3);
  expect_accepted();
  rig.run_s(1);
  rig.start(path, 40, 0.5);
  rig.run_s(3);
  EXPECT_GT(rig.fastest_command_radps(), 1) << rig.why() << refusal();
}

TEST_F(APersonWhoLooked, IsBelievedOfTheHeadingToo) {
  rig.settle();
  rig.heading_off_deg = 25;
  rig.run_s(0.3);
  expect_accepted();
  rig.run_s(1);
  EXPECT_EQ(rig.snapshot().nav.locate, LocateState::good) << rig.why();
  EXPECT_NEAR(rig.snapshot().pose.yaw_rad, to_rad(-25), 0.02);
}

TEST_F(APersonWhoLooked, MovesNothing) {
  rig.settle();
  rig.jump_m = 1.9;
  rig.run_s(3);
  expect_accepted();
  expect_no_motion_for_s(5);
}

TEST_F(APersonWhoLooked, IsRefusedWhileATaskRunsOrTheRobotMoves) {
  drive();
  expect_refused("a task runs: cancel it first");
  rig.command(CancelTask{});
  rig.tick();
  expect_refused("the robot moves");
  rig.run_s(4);
  expect_accepted();
  rig.carried = WheelSpeeds{1, 1};
  rig.run_s(1);
  expect_refused("the robot moves");
}

/// As the README has it: drover task cancel, drover position accept, a new start.
TEST_F(APersonWhoLooked, EndsATaskThatWaitsForItsPlaceFirst) {
  path = straight_path(60);
  rig.settle();
  rig.start(path, 120, 0.5);
  rig.run_s(20);
  rig.aside_m = 0.6;
  rig.run_s(6);
  ASSERT_TRUE(rig.snapshot().nav.paused) << rig.why();
  const double driven_m = rig.plant.truth().x_m;
  expect_refused("a task runs: cancel it first");
  rig.run_s(3);
  EXPECT_TRUE(rig.snapshot().nav.paused) << rig.why();
  rig.command(CancelTask{});
  rig.run_s(1);
  expect_accepted();
  rig.run_s(2);
  EXPECT_NEAR(rig.plant.truth().x_m, driven_m, 0.01) << "to accept moves nothing";
  EXPECT_NEAR(rig.snapshot().pose.y_m, rig.aside_m + rig.plant.truth().y_m, 0.05);
  expect_drives();
}

TEST_F(APersonWhoLooked, IsRefusedWithoutAFixToBelieve) {
  rig.run_s(1);
  expect_refused("there is no origin");
  rig.settle();
  rig.quality = FixQuality::rtk_float;
  rig.run_s(1);
  expect_refused("the position is not RTK fixed");
  rig.receiver_silent = true;
  rig.run_s(3);
  expect_refused("the receiver gives no position");
}

}  // namespace
}  // namespace drover::engine
