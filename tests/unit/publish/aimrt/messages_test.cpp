// Bytes worked out by hand from the document's field numbers.
#include "publish/aimrt/messages.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstring>

#include "drover/angle.h"
#include "tests/unit/publish/aimrt/wire.h"

namespace drover::publish::aimrt {
namespace {

using test::hex;

constexpr Stamping kStamping{Duration(200), 7};
constexpr Time kAt{Duration(100)};
/// time_stamp 300, frame_id "base_link", sequence_num 7; and its key and length.
const std::string kHeader = hex("0a 10  08 ac02  12 09 62 61 73 65 5f 6c 69 6e 6b  18 07");

Snapshot snapshot_with_axis(double position, double velocity, double effort) {
  Snapshot snapshot;
  snapshot.time = kAt;
  AxisSnapshot axis;
  axis.joint = "a";
  axis.motion = {0, position, velocity, effort};
  axis.health = SourceState::fresh;
  axis.last_motion = kAt;
  EXPECT_TRUE(snapshot.axes.push_back(axis));
  return snapshot;
}

TEST(AimrtJointState, HasTheDocumentsFieldNumbers) {
  EXPECT_EQ(joint_state(snapshot_with_axis(1.5, -2, 0.5), kAt, kStamping),
            kHeader + hex("12 1e  0a 01 61  11 000000000000f83f  19 00000000000000c0"
                          "  21 000000000000e03f"));
}

TEST(AimrtJointState, SaysNotANumberForAJointThatIsNotHeard) {
  auto snapshot = snapshot_with_axis(1.5, -2, 0.5);
  snapshot.axes[0].health = SourceState::stale;
  const auto unknown = kHeader + hex("12 1e  0a 01 61  11 000000000000f87f  19 000000000000f87f"
                                     "  21 000000000000f87f");
  EXPECT_EQ(joint_state(snapshot, joint_time(snapshot), kStamping), unknown);
  snapshot.axes[0].health = SourceState::fresh;
  snapshot.axes[0].last_motion = kNever;
  EXPECT_EQ(joint_state(snapshot, joint_time(snapshot), kStamping), unknown);
}

TEST(AimrtJointState, IsStampedWithTheOldestJointThatIsHeard) {
  auto snapshot = snapshot_with_axis(0, 0, 0);
  snapshot.time = Time(Duration(500));
  AxisSnapshot lost = snapshot.axes[0];
  lost.health = SourceState::stale;
  lost.last_motion = Time(Duration(1));
  ASSERT_TRUE(snapshot.axes.push_back(lost));
  EXPECT_EQ(joint_state(snapshot, joint_time(snapshot), kStamping).substr(0, kHeader.size()),
            kHeader);
}

TEST(AimrtJointState, HasNoTimeBeforeTheEpoch) {
  const auto snapshot = snapshot_with_axis(0, 0, 0);
  EXPECT_EQ(joint_state(snapshot, kAt, {Duration(-1000), 0}).substr(0, 13),
            hex("0a 0b 12 09 62 61 73 65 5f 6c 69 6e 6b"));
}

Snapshot snapshot_with_imu() {
  Snapshot snapshot;
  snapshot.imu.configured = true;
  snapshot.imu.health = SourceState::fresh;
  snapshot.imu.time = kAt;
  snapshot.imu.sample.acceleration_mps2 = {1, 2, 4};
  snapshot.imu.sample.angular_velocity_radps = {1.5, 0.5, -2};
  snapshot.imu.gyro_bias_radps = {0.5, 0.5, 0};
  snapshot.imu.sample.has_orientation = true;
  snapshot.imu.sample.orientation = {0.5, -0.5, 0.5, -0.5};  // w, x, y, z
  snapshot.imu.orientation_sigma_rad = 2;
  snapshot.imu.angular_velocity_sigma_radps = 1;
  snapshot.imu.acceleration_sigma_mps2 = 0.5;
  return snapshot;
}

std::string diagonal(std::string_view variance, std::string_view last) {
  const std::string zeros(3 * 8, '\0');
  return hex("48") + hex(variance) + zeros + hex(variance) + zeros + hex(last);
}
std::string diagonal(std::string_view variance) {
  return diagonal(variance, variance);
}
constexpr std::string_view kPiSquared = "de45bec93cbd2340";

TEST(AimrtImuState, HasTheDocumentsFieldNumbersAndTheBiasTakenOff) {
  const std::string expected =
      kHeader +
      hex("12 24  09 000000000000e0bf  11 000000000000e03f  19 000000000000e0bf"
          "  21 000000000000e03f") +
      hex("1a") + diagonal("0000000000001040", kPiSquared) +    // 4, and a yaw from anywhere
      hex("22 12  09 000000000000f03f  19 00000000000000c0") +  // 1, 0, -2
      hex("2a") + diagonal("000000000000f03f") +                // 1
      hex("32 1b  09 000000000000f03f  11 0000000000000040  19 0000000000001040") + hex("3a") +
      diagonal("000000000000d03f");  // 0.25
  EXPECT_EQ(imu_state(snapshot_with_imu(), kStamping), expected);
}

TEST(AimrtImuState, HasTheRobotsOwnYawWhereItIsKnown) {
  auto snapshot = snapshot_with_imu();
  // The sensor's yaw is 105 degrees off; the robot looks north and turns left at 1 rad/s.
  snapshot.imu.sample.orientation = {std::cos(to_rad(97.5)), 0, 0, std::sin(to_rad(97.5))};
  snapshot.pose.time = kAt + std::chrono::milliseconds(10);
  snapshot.pose.yaw_rad = to_rad(90) + 0.01;
  snapshot.pose.wz_radps = 1;
  snapshot.pose.yaw_sigma_rad = 0.5;
  const auto message = imu_state(snapshot, kStamping);
  const auto number = [&](std::size_t at) {
    double value = 0;
    std::memcpy(&value, message.data() + at, sizeof value);
    return value;
  };
  // Key and length, then z and w with their keys: x and y are 0 and left out.
  const auto begin = kHeader.size() + 2;
  EXPECT_EQ(message.substr(kHeader.size(), 2), hex("12 12"));
  EXPECT_NEAR(std::abs(number(begin + 1)), std::sin(to_rad(45)), 1e-12);
  EXPECT_NEAR(number(begin + 10) / number(begin + 1), 1, 1e-12) << "90 degrees, as at the sample";
  EXPECT_NE(message.find(hex("1a") + diagonal("0000000000001040", "000000000000d03f")),
            std::string::npos)
      << "roll and pitch 4, yaw 0.25";
}

TEST(AimrtImuState, SaysMinusOneWhereThereIsNoOrientation) {
  auto snapshot = snapshot_with_imu();
  snapshot.imu.sample.has_orientation = false;
  snapshot.imu.orientation_sigma_rad = kAbsent;
  const std::string identity = hex("12 09  21 000000000000f03f");
  const std::string unknown = hex("1a 48 000000000000f0bf") + std::string(8 * 8, '\0');
  const auto message = imu_state(snapshot, kStamping);
  EXPECT_EQ(message.substr(kHeader.size(), identity.size() + unknown.size()), identity + unknown);
}

TEST(AimrtImuState, SaysZeroForACovarianceThatNobodyKnows) {
  auto snapshot = snapshot_with_imu();
  snapshot.imu.orientation_sigma_rad = kAbsent;
  snapshot.imu.angular_velocity_sigma_radps = kAbsent;
  snapshot.imu.acceleration_sigma_mps2 = kAbsent;
  const auto message = imu_state(snapshot, kStamping);
  for (const char* key : {"1a 48", "2a 48", "3a 48"})
    EXPECT_NE(message.find(hex(key) + std::string(72, '\0')), std::string::npos) << key;
}

TEST(AimrtImuState, KnowsNoCovarianceOfASaturatedSample) {
  auto snapshot = snapshot_with_imu();
  snapshot.imu.sample.saturated = true;
  const auto message = imu_state(snapshot, kStamping);
  for (const char* key : {"2a 48", "3a 48"})
    EXPECT_NE(message.find(hex(key) + std::string(72, '\0')), std::string::npos) << key;
  EXPECT_NE(message.find(hex("1a") + diagonal("0000000000001040", kPiSquared)), std::string::npos)
      << "the orientation's is its own";
  EXPECT_NE(message.find(hex("22 12  09 000000000000f03f  19 00000000000000c0")), std::string::npos)
      << "what was measured is told";
}

TEST(AimrtImuState, BeginsWithTheQuaternionWhoseScalarIsPositive) {
  auto snapshot = snapshot_with_imu();
  const auto told = imu_state(snapshot, kStamping);
  snapshot.imu.sample.orientation = {-0.5, 0.5, -0.5, 0.5};
  EXPECT_EQ(imu_state(snapshot, kStamping), told) << "the same rotation";
}

TEST(AimrtTouchState, NamesTheConfiguredContactsButNoEmergencyStop) {
  Snapshot snapshot;
  snapshot.time = kAt;
  for (const auto line : {Line::estop, Line::bumper, Line::zone_near}) {
    snapshot.line_configured[static_cast<std::size_t>(line)] = true;
    snapshot.line_health[static_cast<std::size_t>(line)] = SourceState::fresh;
  }
  snapshot.line_active[static_cast<std::size_t>(Line::zone_near)] = true;
  EXPECT_EQ(touch_state(snapshot, kStamping), kHeader + hex("12 06 62 75 6d 70 65 72") +
                                                  hex("12 09 7a 6f 6e 65 5f 6e 65 61 72") +
                                                  hex("1a 03 0a 01 00") + hex("1a 03 0a 01 01"));
}

TEST(AimrtTouchState, CountsALineThatCannotBeReadAsTouched) {
  Snapshot snapshot;
  snapshot.time = kAt;
  snapshot.line_configured[static_cast<std::size_t>(Line::bumper)] = true;
  for (const auto health : {SourceState::never_heard, SourceState::stale}) {
    snapshot.line_health[static_cast<std::size_t>(Line::bumper)] = health;
    EXPECT_EQ(touch_state(snapshot, kStamping),
              kHeader + hex("12 06 62 75 6d 70 65 72  1a 03 0a 01 01"));
  }
}

}  // namespace
}  // namespace drover::publish::aimrt
