// A task whose position may drift: it stands and looks.
#include "engine_fixture.h"

namespace drover::engine {
namespace {

using ::testing::HasSubstr;

class ALook : public AnEngine {
 protected:
  ALook() { rig.imu = true; }
  void begin() {
    path = straight_path(60);
    rig.settle();
    rig.start(path, 120, 0.5);
    rig.run_s(4);
  }
  std::string notices() const {
    std::string all;
    for (const Notice& notice : rig.said<Notice>()) all += std::string(notice.text.view()) + '\n';
    return all;
  }
  bool looks() const { return rig.why().find("stands and looks") != std::string::npos; }
  /// Until it does, with the position going aside by so much each second.
  void drive_until_it_looks(double aside_mps) {
    for (int i = 0; i < 600 && !looks(); ++i) {
      rig.aside_m += aside_mps / 10;
      rig.run_s(0.1);
    }
    ASSERT_TRUE(looks()) << rig.why();
    EXPECT_TRUE(rig.snapshot().nav.paused);
    EXPECT_EQ(rig.snapshot().nav.status, NavStatus::run);
  }
};

TEST_F(ALook, FindsADriftThatBeganOnTheFirstLeg) {
  begin();
  drive_until_it_looks(0.02);
  for (int i = 0; i < 200 && rig.snapshot().nav.status == NavStatus::run; ++i) {
    rig.aside_m += 0.002;
    rig.run_s(0.1);
  }
  EXPECT_EQ(rig.snapshot().nav.status, NavStatus::error);
  EXPECT_THAT(rig.why(), HasSubstr("position drifts away from odometry"));
  EXPECT_LT(rig.aside_m, 0.45);
}

TEST_F(ALook, FindsAFastDriftAndTakesItForNoJump) {
  begin();
  drive_until_it_looks(0.05);
  for (int i = 0; i < 200 && rig.snapshot().nav.status == NavStatus::run; ++i) {
    rig.aside_m += 0.005;
    rig.run_s(0.1);
  }
  EXPECT_THAT(rig.why(), HasSubstr("position drifts away from odometry"));
}

TEST_F(ALook, GoesOnByItselfWhenItWasTheMounting) {
  rig.heading_off_deg = 3;
  begin();
  drive_until_it_looks(0);
  rig.run_s(2);
  EXPECT_LT(rig.fastest_command_radps(), 0.01);
  rig.run_s(12);
  EXPECT_FALSE(rig.snapshot().nav.paused) << rig.why();
  EXPECT_GT(rig.fastest_command_radps(), 1);
  rig.run_s(110);
  EXPECT_EQ(rig.snapshot().nav.status, NavStatus::success) << rig.why();
}

TEST_F(ALook, GoesOnWhenTheFixComesBackAfterwards) {
  rig.heading_off_deg = 3;
  begin();
  drive_until_it_looks(0);
  rig.run_s(2);
  rig.quality = FixQuality::rtk_float;
  rig.run_s(3);
  rig.quality = FixQuality::rtk_fixed;
  rig.run_s(15);
  EXPECT_FALSE(rig.snapshot().nav.paused) << rig.why();
}

TEST_F(ALook, IsNotForgottenWhenTheFixIsLostMeanwhile) {
  begin();
  drive_until_it_looks(0.02);
  rig.quality = FixQuality::rtk_float;
  rig.run_s(5);
  rig.quality = FixQuality::rtk_fixed;
  for (int i = 0; i < 200 && rig.snapshot().nav.status == NavStatus::run; ++i) {
    rig.aside_m += 0.002;
    rig.run_s(0.1);
    EXPECT_LT(rig.fastest_command_radps(), 0.5);
  }
  EXPECT_THAT(rig.why(), HasSubstr("position drifts away from odometry"));
}

TEST_F(ALook, IsAnnouncedAtAStartAsLongAsTheMountingIsNotKnown) {
  begin();
  EXPECT_THAT(notices(), HasSubstr("how the antenna line is mounted is not known"));
}

TEST_F(ALook, IsNotAnnouncedWhenTheMountingWasCalibrated) {
  EngineConfig config = rig_config();
  config.estimate.heading_mount_sigma_deg = 0;
  EngineRig calibrated(config);
  calibrated.settle();
  calibrated.start(path, 40, 0.5);
  calibrated.run_s(4);
  ASSERT_EQ(calibrated.said<NavigationStarted>().size(), 1U);
  for (const Notice& notice : calibrated.said<Notice>())
    EXPECT_THAT(std::string(notice.text.view()), ::testing::Not(HasSubstr("is mounted")));
}

}  // namespace
}  // namespace drover::engine
