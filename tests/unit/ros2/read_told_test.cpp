// What droverd writes is what drover-ros2 reads.
#include <cmath>
#include <limits>

#include "drover/angle.h"
#include "unit/ros2/told_fixture.h"

namespace drover::ros2 {
namespace {

using namespace std::chrono_literals;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::SizeIs;

TEST_F(AToldRobot, TellsJointsWithAllTheirDigitsAndNothingOfASilentOne) {
  const Told read = tell();
  EXPECT_EQ(read.at_ns, kThen_ns);
  ASSERT_TRUE(read.joints);
  EXPECT_EQ(read.joints->at_ns, kThen_ns);
  ASSERT_THAT(read.joints->each, SizeIs(2));
  EXPECT_EQ(read.joints->each[0].name, "left");
  EXPECT_EQ(read.joints->each[0].position_rad, 1.0 / 3);
  EXPECT_EQ(read.joints->each[0].velocity_radps, -0.1);
  EXPECT_EQ(read.joints->each[0].effort_Nm, 2.5);
  EXPECT_TRUE(std::isnan(read.joints->each[1].velocity_radps));
}

TEST_F(AToldRobot, TellsNoSampleTwice) {
  seen.imu.configured = seen.gnss.configured = true;
  seen.imu.health = seen.gnss.health = SourceState::fresh;
  seen.imu.time = seen.gnss.position_time = seen.odometry.time = kThen;
  const Told first = tell();
  EXPECT_TRUE(first.joints && first.imu && first.fix && first.odometry);
  EXPECT_THAT(first.diagnostics, testing::Not(IsEmpty()));
  const Told again = tell();
  EXPECT_FALSE(again.joints || again.imu || again.fix || again.odometry);
  EXPECT_THAT(again.diagnostics, IsEmpty());
  EXPECT_THAT(tell_after(1s).diagnostics, testing::Not(IsEmpty())) << "once a second";
}

TEST_F(AToldRobot, TellsTheImuInBaseLinkWithTheRobotsOwnYaw) {
  seen.imu.configured = true;
  seen.imu.health = SourceState::fresh;
  seen.imu.time = kThen;
  seen.imu.sample.has_orientation = true;
  seen.imu.sample.acceleration_mps2 = {0.1, 0.2, 9.81};
  seen.imu.sample.angular_velocity_radps = {0, 0, 0.5};
  seen.imu.gyro_bias_radps = {0, 0, 0.1};
  seen.imu.orientation_sigma_rad = 0.02;
  seen.imu.angular_velocity_sigma_radps = 0.005;
  seen.pose.time = kThen;
  seen.pose.yaw_rad = kPi / 2;  // north
  seen.pose.yaw_sigma_rad = 0.01;
  const Told read = tell();
  ASSERT_TRUE(read.imu && read.imu->orientation);
  EXPECT_NEAR(read.imu->orientation->z, std::sqrt(0.5), 1e-12);
  EXPECT_NEAR(read.imu->orientation->w, std::sqrt(0.5), 1e-12);
  EXPECT_EQ(read.imu->yaw_sigma_rad, 0.01);
  EXPECT_EQ(read.imu->rate_radps.z, 0.4) << "the learned zero is taken off";
  EXPECT_EQ(read.imu->acceleration_mps2.z, 9.81);
  EXPECT_EQ(read.imu->rate_sigma_radps, 0.005);
  EXPECT_TRUE(std::isnan(read.imu->acceleration_sigma_mps2));
}

TEST_F(AToldRobot, TellsNoBoundOfASaturatedSample) {
  seen.imu.configured = true;
  seen.imu.health = SourceState::fresh;
  seen.imu.time = kThen;
  seen.imu.sample.saturated = true;
  seen.imu.angular_velocity_sigma_radps = 0.005;
  const Told read = tell();
  ASSERT_TRUE(read.imu);
  EXPECT_FALSE(read.imu->orientation);
  EXPECT_TRUE(std::isnan(read.imu->rate_sigma_radps));
}

TEST_F(AToldRobot, TellsThePlaceOnlyWhereItIsKnown) {
  seen.odometry.time = seen.pose.time = kThen;
  seen.odometry.x_m = 1.5;
  seen.odometry.yaw_var = 0.25;
  EXPECT_FALSE(tell().pose);
  seen.origin_set = true;
  seen.pose.position_sigma_m = 0.02;
  seen.odometry.time = seen.pose.time = kThen + 20ms;
  EXPECT_FALSE(tell().pose) << "where it looks is not known";
  seen.pose.yaw_sigma_rad = 0.01;
  seen.pose.x_m = -3;
  seen.odometry.time = seen.pose.time = kThen + 40ms;
  const Told read = tell();
  ASSERT_TRUE(read.pose && read.odometry);
  EXPECT_EQ(read.pose->x_m, -3);
  EXPECT_EQ(read.odometry->x_m, 1.5);
  EXPECT_EQ(read.odometry->yaw_var, 0.25);
  EXPECT_EQ(read.odometry->at_ns, kThen_ns + 40'000'000);
}

TEST_F(AToldRobot, TellsOfASilentBatteryThatItIsSilent) {
  seen.battery.configured = true;
  seen.battery.health = SourceState::fresh;
  seen.battery.time = kThen - 300ms;
  seen.battery.sample.voltage_V = 25.9;
  seen.battery.sample.flow = BatteryFlow::discharging;
  const Told heard = tell();
  ASSERT_TRUE(heard.battery);
  EXPECT_TRUE(heard.battery->heard);
  EXPECT_EQ(heard.battery->sample.voltage_V, 25.9);
  EXPECT_EQ(heard.battery->sample.flow, BatteryFlow::discharging);
  EXPECT_FALSE(tell_after(20ms).battery) << "no new sample";
  wall -= 128ns;  // two clocks that are read one after the other
  const auto again = tell_after(2s);
  ASSERT_TRUE(again.battery);
  EXPECT_EQ(again.battery->at_ns, heard.battery->at_ns) << "of the same sample";
  wall += 128ns;
  seen.battery.health = SourceState::stale;
  const Told silent = tell_after(1s);
  ASSERT_TRUE(silent.battery);
  EXPECT_FALSE(silent.battery->heard);
  EXPECT_TRUE(std::isnan(silent.battery->sample.voltage_V));
}

TEST_F(AToldRobot, TellsTouchAtEachChangeAndTenTimesASecond) {
  const auto bumper = static_cast<std::size_t>(Line::bumper);
  seen.line_configured[bumper] = true;
  seen.line_health[bumper] = SourceState::fresh;
  const Told free = tell();
  ASSERT_TRUE(free.touch);
  ASSERT_THAT(free.touch->each, SizeIs(1));
  EXPECT_EQ(free.touch->each[0].name, "bumper");
  EXPECT_FALSE(free.touch->each[0].touched);
  EXPECT_FALSE(tell_after(20ms).touch);
  seen.line_active[bumper] = true;
  const Told hit = tell_after(20ms);
  ASSERT_TRUE(hit.touch);
  EXPECT_TRUE(hit.touch->each[0].touched);
  EXPECT_TRUE(tell_after(100ms).touch);
}

TEST_F(AToldRobot, TellsEachTurnOfAScannerOnce) {
  scene::sensor::SeenTurn turn;
  turn.device = "lidar";
  turn.scan.begin = kThen - 100ms;
  turn.scan.end = kThen;
  turn.scan.turn_Hz = 10;
  (void)turn.scan.points.push_back({-1.25, 2.5, 77});
  (void)turn.scan.points.push_back({1.25, 0, 0});
  turns = {&turn};
  const Told read = tell();
  ASSERT_THAT(read.scans, SizeIs(1));
  EXPECT_EQ(read.scans[0].name, "lidar");
  EXPECT_EQ(read.scans[0].end_ns, kThen_ns);
  ASSERT_THAT(read.scans[0].points, SizeIs(2));
  EXPECT_EQ(read.scans[0].points[0].bearing_rad, -1.25);
  EXPECT_EQ(read.scans[0].points[0].range_m, 2.5);
  EXPECT_EQ(read.scans[0].points[0].intensity, 77);
  EXPECT_THAT(tell().scans, IsEmpty());
}

TEST_F(AToldRobot, TellsWhyItDoesNotMoveFirst) {
  (void)seen.why.push_back("the e-stop is pressed");
  const Told read = tell();
  ASSERT_THAT(read.diagnostics, testing::Not(IsEmpty()));
  EXPECT_EQ(read.diagnostics[0].name, "robot");
  EXPECT_EQ(read.diagnostics[0].level, 1);
  EXPECT_EQ(read.diagnostics[0].message, "the e-stop is pressed");
  EXPECT_EQ(read.diagnostics[1].name, "joint left");
  EXPECT_EQ(read.diagnostics[1].level, 0);
  EXPECT_EQ(read.diagnostics[2].level, 2) << "the right one is silent";
}

TEST(ReadTold, SaysWhatDroverdHasAgainstIt) {
  const auto refused = read_told(R"({"ok":false,"reason":"slow down"})");
  ASSERT_FALSE(refused.ok());
  EXPECT_EQ(refused.error().reason, "slow down");
  EXPECT_FALSE(refused.error().done);
  EXPECT_FALSE(refused.error().stop_refused);
  const auto stop = read_told(R"({"ok":false,"cmd":"stop","reason":"told the control loop"})");
  EXPECT_TRUE(!stop.ok() && stop.error().stop_refused && !stop.error().done);
  EXPECT_EQ(stop.error().reason, "told the control loop");
  const auto obeyed = read_told(R"({"ok":true,"note":"stopped"})");
  ASSERT_FALSE(obeyed.ok());
  EXPECT_EQ(obeyed.error().reason, "");
  EXPECT_TRUE(obeyed.error().done);
  EXPECT_THAT(read_told("{").error().reason, HasSubstr("not understood"));
  EXPECT_THAT(read_told("{}").error().reason, HasSubstr("at_ns is missing"));
}

TEST(ReadTold, LeavesAbsentWhatIsNotThere) {
  const auto read = read_told(R"({"at_ns":5,"imu":{},"fix":{"quality":99},"scans":[{}],"new":1})");
  ASSERT_TRUE(read.ok());
  EXPECT_FALSE(read->joints || read->battery);
  ASSERT_TRUE(read->imu && read->fix);
  EXPECT_FALSE(read->imu->orientation);
  EXPECT_TRUE(std::isnan(read->imu->rate_radps.x));
  EXPECT_EQ(read->fix->position.quality, FixQuality::none);
  EXPECT_THAT(read->scans, SizeIs(1));
}

}  // namespace
}  // namespace drover::ros2
