#include "engine/navigate/navigator_checks.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <limits>

namespace drover::engine {
namespace {

using ::testing::HasSubstr;

TEST(SpeedCheck, RefusesWhatIsNoSpeed) {
  const LimitsConfig limits;
  for (const double bad :
       {0.0, -0.0, -1.0, 0.049, 1e-300, std::numeric_limits<double>::quiet_NaN(),
        std::numeric_limits<double>::infinity(), -std::numeric_limits<double>::infinity()}) {
    const SpeedCheck check = check_speed(bad, limits);
    EXPECT_FALSE(check.refusal.empty()) << bad;
    EXPECT_EQ(check.speed_mps, 0) << bad;
  }
}
TEST(SpeedCheck, ClampsWhatIsTooFastAndSaysSo) {
  for (const double fast : {0.81, 9.0, 1e308}) {
    const SpeedCheck check = check_speed(fast, {});
    EXPECT_TRUE(check.refusal.empty());
    EXPECT_DOUBLE_EQ(check.speed_mps, 0.8);
    EXPECT_THAT(std::string(check.note.view()), HasSubstr("limited to 0.80 m/s"));
  }
}
TEST(SpeedCheck, TakesWhatIsInsideAsItIs) {
  for (const double speed : {0.05, 0.2, 0.5, 0.8}) {
    const SpeedCheck check = check_speed(speed, {});
    EXPECT_DOUBLE_EQ(check.speed_mps, speed);
    EXPECT_TRUE(check.refusal.empty() && check.note.empty());
  }
}

HealthReport good_health() {
  HealthReport report;
  report.ready = report.drives_ok = report.lines_ok = report.gnss_ok = report.guard_ok = true;
  report.locate = LocateState::good;
  report.budget_used = 0.2;
  return report;
}

TEST(RobotCheck, RefusesBeforeTheFirstCycle) {
  EXPECT_FALSE(check_robot(HealthReport{}, true).empty());
}
TEST(RobotCheck, RefusesWithTheCauseThatStops) {
  HealthReport report = good_health();
  report.stop = "e-stop pressed";
  EXPECT_EQ(check_robot(report, true), "e-stop pressed");
}
TEST(RobotCheck, RefusesWithoutAnOrigin) {
  EXPECT_EQ(check_robot(good_health(), false), "no origin is set");
}
TEST(RobotCheck, RefusesWithASilentReceiver) {
  HealthReport report = good_health();
  report.gnss_ok = false;
  report.texts[static_cast<std::size_t>(Cause::receiver)] = "receiver silent for 1.0 s";
  EXPECT_EQ(check_robot(report, true), "receiver silent for 1.0 s");
}
TEST(RobotCheck, RefusesWithoutAnImuThatIsConfigured) {
  HealthReport report = good_health();
  report.causes = 1U << static_cast<unsigned>(Cause::imu);
  report.texts[static_cast<std::size_t>(Cause::imu)] = "IMU silent for 0.3 s";
  EXPECT_EQ(check_robot(report, true), "IMU silent for 0.3 s");
}
TEST(RobotCheck, RefusesUntilThePositionIsGood) {
  for (const LocateState state : {LocateState::uninit, LocateState::lost}) {
    HealthReport report = good_health();
    report.locate = state;
    EXPECT_FALSE(check_robot(report, true).empty());
    report.locate_reason = "no heading yet";
    EXPECT_EQ(check_robot(report, true), "no heading yet");
  }
}
TEST(RobotCheck, LetsADriveWithAFaultTryToArm) {
  HealthReport report = good_health();
  report.drives_ok = false;
  report.not_running = "wheel a: over temperature";
  EXPECT_TRUE(check_robot(report, true).empty());
}
TEST(RobotCheck, AcceptsAHealthyRobot) {
  EXPECT_TRUE(check_robot(good_health(), true).empty());
}

class APlaceCheck : public ::testing::Test {
 protected:
  APlaceCheck() {
    for (int i = 0; i <= 10; ++i) path.points.push_back({1.0 * i, 0});
  }
  std::string refusal(double x_m, double y_m, double yaw_rad, std::uint32_t target = 10) {
    Pose pose;
    pose.x_m = x_m;
    pose.y_m = y_m;
    pose.yaw_rad = yaw_rad;
    Tracker tracker(config, {});
    tracker.begin(path, target, 0.5, pose);
    return std::string(check_place(path, target, pose, tracker.locate(pose), config).view());
  }
  NavigateConfig config;
  Path path;
};

TEST_F(APlaceCheck, RefusesARobotBesideTheTrack) {
  EXPECT_THAT(refusal(5, 2.1, 0), HasSubstr("2.1 m away from the track"));
  EXPECT_THAT(refusal(5, -2.1, 0), HasSubstr("away from the track"));
}
TEST_F(APlaceCheck, RefusesARobotBeforeOrBeyondTheEnds) {
  EXPECT_THAT(refusal(-2.5, 0, 0), HasSubstr("2.5 m away from the track"));
  EXPECT_THAT(refusal(13, 0, 3.1), HasSubstr("away from the track"));
}
TEST_F(APlaceCheck, RefusesARobotThatIsBadlyTurned) {
  EXPECT_THAT(refusal(5, 0, 0.55), HasSubstr("turned 32 degrees"));
  EXPECT_THAT(refusal(5, 0, 3.1), HasSubstr("degrees away from the way to point 11"));
}
TEST_F(APlaceCheck, RefusesAGoalBehindTheRobot) {
  EXPECT_FALSE(refusal(11, 0, 0).empty());
}
TEST_F(APlaceCheck, SaysWhatToDoAboutAGoalBehindTheRobot) {
  EXPECT_EQ(refusal(5.5, 0, 0, 5),
            "the robot is turned 180 degrees away from the way to point 6, allowed 30: turn it "
            "round, or choose a point ahead of it");
  EXPECT_EQ(
      refusal(10.5, 0, 0),
      "point 11 lies 0.5 m behind the robot: choose a point ahead, or bring the robot back to "
      "before it");
  EXPECT_THAT(refusal(5, 0, 0.55), HasSubstr("allowed 30: turn it into the way"));
}
TEST_F(APlaceCheck, AcceptsARobotNearTheTrackAndRoughlyAlongIt) {
  EXPECT_EQ(refusal(5, 1.9, 0), "");
  EXPECT_EQ(refusal(5, 0, 0.5), "");
  EXPECT_EQ(refusal(-1.5, 0, 0), "");
}
TEST_F(APlaceCheck, AcceptsTheWayBackAlongTheListForARobotTurnedSo) {
  EXPECT_EQ(refusal(5, 0, 3.1, 0), "");
  EXPECT_THAT(refusal(5, 0, 0, 0), HasSubstr("point 1"));
}
TEST_F(APlaceCheck, AcceptsAnyHeadingWhereTheGoalIsReachedAlready) {
  EXPECT_EQ(refusal(10, 0.02, 2.0), "");
}

}  // namespace
}  // namespace drover::engine
