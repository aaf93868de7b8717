// What a ROS user checks first: axes, frames, units, signs, and what is not known.
#include "ros2/convert.h"

#include <gmock/gmock.h>

#include <cmath>

#include "drover/angle.h"

namespace drover::ros2 {
namespace {

constexpr Stamp_ns kAt_ns = 1795867200LL * 1'000'000'000 + 250'000'000;

class Messages : public testing::Test {
 protected:
  Arena arena;
};

double yaw_of(const geometry_msgs_msg_dds__Quaternion_& q) {
  return std::atan2(2 * (q.w_ * q.z_ + q.x_ * q.y_), 1 - 2 * (q.y_ * q.y_ + q.z_ * q.z_));
}

TEST_F(Messages, CarryTheWallTimeInSecondsAndNanoseconds) {
  const auto time = time_of(kAt_ns);
  EXPECT_EQ(time.sec_, 1795867200);
  EXPECT_EQ(time.nanosec_, 250'000'000U);
  EXPECT_EQ(time_of(-5).sec_, 0) << "a clock that was never set";
  EXPECT_EQ(time_of(-5).nanosec_, 0U);
}

TEST_F(Messages, OfJointsHaveListsOfOneLength) {
  const JointsTold told{kAt_ns, {{"left", 1, 2, 3}, {"right", kAbsent, kAbsent, kAbsent}}};
  const auto message = joint_state(told, arena);
  ASSERT_EQ(message.name_._length, 2U);
  ASSERT_EQ(message.position_._length, 2U);
  ASSERT_EQ(message.velocity_._length, 2U);
  ASSERT_EQ(message.effort_._length, 2U);
  EXPECT_STREQ(message.name_._buffer[1], "right");
  EXPECT_EQ(message.velocity_._buffer[0], 2);
  EXPECT_TRUE(std::isnan(message.effort_._buffer[1]));
  const auto twin = joint_state_array(told, 7, arena);
  ASSERT_EQ(twin.joints_._length, 2U);
  EXPECT_EQ(twin.header_.sequence_, 7U);
  EXPECT_STREQ(twin.joints_._buffer[0].name_, "left");
  EXPECT_EQ(twin.joints_._buffer[0].effort_, 3);
}

TEST_F(Messages, OfTheImuFollowRep145) {
  ImuTold told;
  told.at_ns = kAt_ns;
  told.acceleration_mps2 = {0, 0, 9.81};
  auto message = imu(told, arena);
  EXPECT_STREQ(message.header_.frame_id_, "base_link");
  EXPECT_EQ(message.orientation_covariance_[0], -1) << "there is no orientation";
  EXPECT_EQ(message.orientation_.w_, 1);
  EXPECT_EQ(message.angular_velocity_covariance_[0], 0) << "not known";
  EXPECT_EQ(message.linear_acceleration_.z_, 9.81) << "with gravity";
  told.orientation = Quaternion{1, 0, 0, 0};
  told.orientation_sigma_rad = 0.1;
  told.yaw_sigma_rad = kPi;
  told.rate_sigma_radps = 0.2;
  message = imu(told, arena);
  EXPECT_NEAR(message.orientation_covariance_[0], 0.01, 1e-15);
  EXPECT_EQ(message.orientation_covariance_[1], 0);
  EXPECT_NEAR(message.orientation_covariance_[8], kPi * kPi, 1e-12);
  EXPECT_NEAR(message.angular_velocity_covariance_[4], 0.04, 1e-15);
}

TEST_F(Messages, OfAFixTellTheHeightAboveTheEllipsoid) {
  FixTold told{kAt_ns, "gnss", {}};
  told.position = {.latitude_deg = 48.1,
                   .longitude_deg = 11.6,
                   .altitude_msl_m = 520,
                   .undulation_m = 46.5,
                   .quality = FixQuality::rtk_fixed,
                   .sigma_east_m = 0.01,
                   .sigma_north_m = 0.02,
                   .sigma_up_m = 0.03};
  auto message = nav_sat_fix(told, arena);
  EXPECT_STREQ(message.header_.frame_id_, "gnss");
  EXPECT_EQ(message.altitude_, 566.5);
  EXPECT_EQ(message.status_.status_, 2);
  EXPECT_EQ(message.position_covariance_type_, 2);
  EXPECT_NEAR(message.position_covariance_[0], 1e-4, 1e-12) << "east first";
  EXPECT_NEAR(message.position_covariance_[4], 4e-4, 1e-12);
  EXPECT_NEAR(message.position_covariance_[8], 9e-4, 1e-12);
  told.position.undulation_m = kAbsent;
  told.position.sigma_east_m = kAbsent;
  message = nav_sat_fix(told, arena);
  EXPECT_TRUE(std::isnan(message.altitude_)) << "not the height above the sea";
  EXPECT_EQ(message.position_covariance_type_, 0);
}

TEST_F(Messages, OfAFixTellWhatKindItIs) {
  const auto status = [this](FixQuality quality) {
    FixTold told;
    told.position.quality = quality;
    return static_cast<int>(nav_sat_fix(told, arena).status_.status_);
  };
  EXPECT_EQ(status(FixQuality::none), -1);
  EXPECT_EQ(status(FixQuality::single), 0);
  EXPECT_EQ(status(FixQuality::dgps), 1);
  EXPECT_EQ(status(FixQuality::rtk_float), 2);
  EXPECT_EQ(status(FixQuality::rtk_fixed), 2);
  EXPECT_EQ(status(FixQuality::estimated), -1) << "no satellite gave it";
}

TEST_F(Messages, OfOdometryHaveTheirTwistInTheChildFrame) {
  OdometryTold way;
  way.at_ns = kAt_ns;
  way.x_m = 3;
  way.yaw_rad = kPi / 2;
  way.vx_mps = 0.5;
  way.wz_radps = 0.25;
  way.x_var = 0.01;
  way.xy_var = 0.02;
  way.y_var = 0.03;
  way.x_yaw_var = 0.04;
  way.y_yaw_var = 0.05;
  way.yaw_var = 0.06;
  way.vx_var = 0.07;
  way.wz_var = 0.08;
  const auto message = odometry(way, arena);
  EXPECT_STREQ(message.header_.frame_id_, "odom");
  EXPECT_STREQ(message.child_frame_id_, "base_link");
  EXPECT_EQ(message.pose_.pose_.position_.x_, 3);
  EXPECT_NEAR(yaw_of(message.pose_.pose_.orientation_), kPi / 2, 1e-12);
  EXPECT_EQ(message.twist_.twist_.linear_.x_, 0.5) << "ahead, wherever it looks";
  EXPECT_EQ(message.twist_.twist_.angular_.z_, 0.25) << "to the left";
  const auto& pose = message.pose_.covariance_;
  EXPECT_EQ(pose[0], 0.01);
  EXPECT_EQ(pose[1], 0.02);
  EXPECT_EQ(pose[6], 0.02);
  EXPECT_EQ(pose[7], 0.03);
  EXPECT_EQ(pose[5], 0.04);
  EXPECT_EQ(pose[30], 0.04);
  EXPECT_EQ(pose[11], 0.05);
  EXPECT_EQ(pose[31], 0.05);
  EXPECT_EQ(pose[35], 0.06);
  EXPECT_GT(pose[14], 1000) << "no height";
  EXPECT_EQ(message.twist_.covariance_[0], 0.07);
  EXPECT_EQ(message.twist_.covariance_[35], 0.08);
}

TEST_F(Messages, OfFramesMakeThePoseOfMapToOdomToBaseLink) {
  OdometryTold way;
  way.x_m = 4;
  way.y_m = -1;
  way.yaw_rad = 0.7;
  const PoseTold pose{120, 35, -2.9, 0.02, 0.01};
  const auto message = frames(way, pose, arena);
  ASSERT_EQ(message.transforms_._length, 2U);
  const auto& odom = message.transforms_._buffer[0];
  const auto& map = message.transforms_._buffer[1];
  EXPECT_STREQ(odom.header_.frame_id_, "odom");
  EXPECT_STREQ(odom.child_frame_id_, "base_link");
  EXPECT_STREQ(map.header_.frame_id_, "map");
  EXPECT_STREQ(map.child_frame_id_, "odom");
  const double turn = yaw_of(map.transform_.rotation_);
  const auto& to_odom = map.transform_.translation_;
  const auto& to_base = odom.transform_.translation_;
  EXPECT_NEAR(to_odom.x_ + std::cos(turn) * to_base.x_ - std::sin(turn) * to_base.y_, 120, 1e-9);
  EXPECT_NEAR(to_odom.y_ + std::sin(turn) * to_base.x_ + std::cos(turn) * to_base.y_, 35, 1e-9);
  EXPECT_NEAR(wrap_rad(turn + yaw_of(odom.transform_.rotation_) + 2.9), 0, 1e-9);
  EXPECT_EQ(frames(way, std::nullopt, arena).transforms_._length, 1U)
      << "where odom is in the map is not known";
}

TEST_F(Messages, OfThePoseAreInTheMap) {
  const auto message = rtk_pose(kAt_ns, {120, 35, kPi / 2, 0.02, 0.01}, arena);
  EXPECT_STREQ(message.header_.frame_id_, "map");
  EXPECT_NEAR(yaw_of(message.pose_.pose_.orientation_), kPi / 2, 1e-12)
      << "north is a quarter turn";
  EXPECT_NEAR(message.pose_.covariance_[0], 4e-4, 1e-12);
  EXPECT_NEAR(message.pose_.covariance_[35], 1e-4, 1e-12);
}

TEST_F(Messages, OfTheBatteryHaveRossSignsAndNoZeroForUnknown) {
  BatteryTold told;
  told.heard = true;
  told.sample.voltage_V = 25.5;
  told.sample.current_A = -3;  // out of the pack
  told.sample.soc_percent = 40;
  told.sample.flow = BatteryFlow::discharging;
  auto message = battery_state(told, arena);
  EXPECT_EQ(message.current_, -3.0F);
  EXPECT_FLOAT_EQ(message.percentage_, 0.4F);
  EXPECT_EQ(message.power_supply_status_, 2);
  EXPECT_EQ(message.power_supply_health_, 1);
  EXPECT_TRUE(message.present_);
  EXPECT_TRUE(std::isnan(message.temperature_));
  EXPECT_TRUE(std::isnan(message.charge_));
  EXPECT_TRUE(std::isnan(message.design_capacity_));
  message = battery_state(BatteryTold{}, arena);
  EXPECT_FALSE(message.present_);
  EXPECT_TRUE(std::isnan(message.voltage_) && std::isnan(message.percentage_));
  EXPECT_EQ(message.power_supply_status_, 0);
  EXPECT_EQ(message.power_supply_health_, 0);
}

TEST_F(Messages, OfAScanHaveTheNearestOfEachAngleAndNaNWhereNothingIsKnown) {
  ScanTold told;
  told.name = "lidar";
  told.begin_ns = kAt_ns;
  told.end_ns = kAt_ns + 100'000'000;
  told.turn_Hz = 10;
  for (int i = 0; i < 8; ++i) told.points.push_back({-kPi + i * kPi / 4, 2.0 + i, 10});
  told.points[3].range_m = 0;
  told.points[5].bearing_rad = told.points[4].bearing_rad + 0.01;
  told.points[5].range_m = 1;
  const auto message = laser_scan(told, {0.05, 12}, 8, arena);
  EXPECT_STREQ(message.header_.frame_id_, "lidar");
  EXPECT_EQ(message.header_.stamp_.nanosec_, 300'000'000U) << "the middle of the turn";
  ASSERT_EQ(message.ranges_._length, 8U);
  ASSERT_EQ(message.intensities_._length, 8U);
  EXPECT_FLOAT_EQ(message.angle_min_, static_cast<float>(-kPi));
  EXPECT_FLOAT_EQ(message.angle_max_, static_cast<float>(kPi * 3 / 4));
  EXPECT_NEAR(message.angle_min_ + 7 * message.angle_increment_, message.angle_max_, 1e-5);
  EXPECT_FLOAT_EQ(message.scan_time_, 0.1F);
  EXPECT_FLOAT_EQ(message.range_max_, 12.0F);
  EXPECT_EQ(message.ranges_._buffer[0], 2.0F);
  EXPECT_TRUE(std::isnan(message.ranges_._buffer[3])) << "nothing came back: not free";
  EXPECT_EQ(message.ranges_._buffer[4], 1.0F) << "the nearer of two";
  EXPECT_TRUE(std::isnan(message.ranges_._buffer[5]));
}

/// SLAM sets up its beams by the first scan and drops others.
TEST_F(Messages, OfAScanHaveTheSameAnglesWhateverTheTurnHas) {
  for (const int points : {0, 1, 7, 37, 40, 1000}) {
    ScanTold told;
    told.name = "lidar";
    for (int i = 0; i < points; ++i)
      told.points.push_back({-kPi + (i + 0.5) * 2 * kPi / points, 2.0 + i, 10});
    const auto message = laser_scan(told, {0.05, 12}, 40, arena);
    ASSERT_EQ(message.ranges_._length, 40U) << points;
    ASSERT_EQ(message.intensities_._length, 40U) << points;
    EXPECT_FLOAT_EQ(message.angle_increment_, static_cast<float>(2 * kPi / 40)) << points;
    EXPECT_FLOAT_EQ(message.angle_min_, static_cast<float>(-kPi)) << points;
    EXPECT_FLOAT_EQ(message.angle_max_, static_cast<float>(kPi - 2 * kPi / 40)) << points;
    int known = 0;
    for (int i = 0; i < 40; ++i) known += std::isnan(message.ranges_._buffer[i]) ? 0 : 1;
    EXPECT_GE(known, std::min(points, 40));
    EXPECT_LE(known, 2 * points) << "one beside each";
  }
}

/// A turn of a scanner has as many beams as the message has angles, wherever the first one falls.
TEST_F(Messages, OfAScanHaveNoGapsBetweenItsBeams) {
  for (const double first : {0.0, 0.2, 0.4999, 0.5, 0.5001, 0.9}) {
    ScanTold told;
    told.name = "lidar";
    for (int i = 0; i < 450; ++i) {  // told with five decimals
      const double bearing_rad = -kPi + (i + first) * 2 * kPi / 450;
      told.points.push_back({std::round(bearing_rad * 1e5) / 1e5, 2.0 + i, 10});
    }
    told.points[100].range_m = 0;
    const auto message = laser_scan(told, {0.05, 12}, 450, arena);
    int unknown = 0;
    for (int i = 0; i < 450; ++i) {
      const float range = message.ranges_._buffer[i];
      unknown += std::isnan(range) ? 1 : 0;
      if (std::isnan(range)) continue;
      const double off = std::remainder(range - 2.0 + first - i, 450);
      EXPECT_LE(std::abs(off), 0.76) << i << " of " << first;
      EXPECT_EQ(message.intensities_._buffer[i], 10.0F);
    }
    EXPECT_LE(unknown, 1) << first << ": only where nothing came back";
    if (first < 0.25) {
      EXPECT_TRUE(std::isnan(message.ranges_._buffer[100])) << "not free";
    }
  }
}

TEST_F(Messages, OfDiagnosticsNameTheRobot) {
  const std::vector<DiagnosticTold> told{{"robot", 7, "why", {{"owner", "task"}}}};
  const auto message = diagnostics(kAt_ns, "field 1", told, arena);
  ASSERT_EQ(message.status_._length, 1U);
  const auto& status = message.status_._buffer[0];
  EXPECT_STREQ(status.name_, "drover: robot");
  EXPECT_STREQ(status.hardware_id_, "field 1");
  EXPECT_STREQ(status.message_, "why");
  EXPECT_EQ(status.level_, 2);
  ASSERT_EQ(status.values_._length, 1U);
  EXPECT_STREQ(status.values_._buffer[0].value_, "task");
}

TEST_F(Messages, OfTouchAreTheChannelsTwins) {
  const auto message = touch_state({kAt_ns, {{"bumper", true}, {"zone_far", false}}}, 3, arena);
  ASSERT_EQ(message.names_._length, 2U);
  ASSERT_EQ(message.states_._length, 2U);
  EXPECT_STREQ(message.names_._buffer[0], "bumper");
  ASSERT_EQ(message.states_._buffer[0].pressure_._length, 1U);
  EXPECT_EQ(message.states_._buffer[0].pressure_._buffer[0], 1);
  EXPECT_EQ(message.states_._buffer[1].pressure_._buffer[0], 0);
}

TEST_F(Messages, OfFixedFramesTurnYawFirst) {
  const std::vector<FixedFrame> told{{"lidar", 0.1, 0, 0.3, 0, 0, kPi / 2},
                                     {"camera", 0, 0, 1, 0.1, 0.2, 0.3}};
  const auto message = fixed_frames(kAt_ns, told, arena);
  ASSERT_EQ(message.transforms_._length, 2U);
  const auto& lidar = message.transforms_._buffer[0];
  EXPECT_STREQ(lidar.header_.frame_id_, "base_link");
  EXPECT_STREQ(lidar.child_frame_id_, "lidar");
  EXPECT_NEAR(yaw_of(lidar.transform_.rotation_), kPi / 2, 1e-12);
  const auto& q = message.transforms_._buffer[1].transform_.rotation_;
  EXPECT_NEAR(yaw_of(q), 0.3, 1e-12);
  EXPECT_NEAR(std::asin(2 * (q.w_ * q.y_ - q.z_ * q.x_)), 0.2, 1e-12);
  EXPECT_NEAR(std::atan2(2 * (q.w_ * q.x_ + q.y_ * q.z_), 1 - 2 * (q.x_ * q.x_ + q.y_ * q.y_)), 0.1,
              1e-12);
}

}  // namespace
}  // namespace drover::ros2
