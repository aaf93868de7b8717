// A task whose position may drift: it stands and looks.
#include "engine_fixture.h"

namespace drover::engine {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;

class ALook : public AnEngine {
 protected:
  ALook() { rig.imu = true; }
  void begin() {
    path = straight_path(60);
    rig.settle();
    rig.start(path, 120, 0.5);
    rig.run_s(4);
  }
  static std::string notices_of(const EngineRig& of) {
    std::string all;
    for (const Notice& notice : of.said<Notice>()) all += std::string(notice.text.view()) + '\n';
    return all;
  }
  std::string notices() const { return notices_of(rig); }
  std::string notices_at_the_start_of(const EngineConfig& config) {
    EngineRig other(config);
    other.settle();
    other.start(path, 40, 0.5);
    other.run_s(4);
    EXPECT_EQ(other.said<NavigationStarted>().size(), 1U);
    return notices_of(other);
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

TEST_F(ALook, SaysAtAStartThatItIsNotKnownWhereTheAntennaIsUntilItHasTurned) {
  begin();
  EXPECT_THAT(notices(), HasSubstr("where the antenna is is not known before the robot has turned: "
                                   "until then it may go 0.12 m beside its track"));
}

TEST_F(ALook, SaysNothingOfAnAntennaLineThatWasCalibrated) {
  EngineConfig config = rig_config();
  config.estimate.heading_mount_sigma_deg = 0;
  EXPECT_THAT(notices_at_the_start_of(config), Not(HasSubstr("is mounted")));
}

TEST_F(ALook, SaysNothingOfAnAntennaThatWasMeasured) {
  EngineConfig config = rig_config();
  config.estimate.antenna_sigma_m = 0.01;
  EXPECT_THAT(notices_at_the_start_of(config), Not(HasSubstr("where the antenna is")));
}

}  // namespace
}  // namespace drover::engine
