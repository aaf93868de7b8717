// Our JSON and AimRT's, which is that of libprotobuf with AimRT's options.
#include <gtest/gtest.h>

#include <limits>

#include "publish/aimrt/channel.h"
#include "publish/aimrt/messages.h"
#include "support/protoc.h"

namespace drover::publish::aimrt {
namespace {

using test::protobuf_json;
using test::protobuf_of_json;

constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();
constexpr double kInfinity = std::numeric_limits<double>::infinity();
constexpr Stamping kStamping{std::chrono::hours(490'000), 7};

Snapshot snapshot_with_axis(double position, double velocity, double effort) {
  Snapshot snapshot;
  snapshot.time = Time(Duration(1'000));
  AxisSnapshot axis;
  axis.joint = "front_left";
  axis.motion = {0, position, velocity, effort};
  axis.health = SourceState::fresh;
  axis.last_motion = snapshot.time;
  EXPECT_TRUE(snapshot.axes.push_back(axis));
  return snapshot;
}

std::string joints(const Snapshot& snapshot, Content content) {
  return joint_state(snapshot, snapshot.time, kStamping, content);
}

TEST(AimrtJson, OfJointsIsWhatAimrtWrites) {
  const auto snapshot = snapshot_with_axis(12.25, 0, -1.5e-7);
  const auto text = joints(snapshot, Content::json);
  EXPECT_EQ(text, R"({"header":{"time_stamp":"1764000000000001000","frame_id":"base_link",)"
                  R"("sequence_num":"7"},"joints":[{"name":"front_left","position":12.25,)"
                  R"("velocity":0,"effort":-1.5e-07}]})");
  EXPECT_EQ(text, protobuf_json("JointState", joints(snapshot, Content::pb)));
  EXPECT_EQ(text, protobuf_json("JointStateArray", joints(snapshot, Content::pb)));
}

TEST(AimrtJson, SaysWhatIsNoNumberAsText) {
  const auto snapshot = snapshot_with_axis(kNaN, kInfinity, -kInfinity);
  const auto text = joints(snapshot, Content::json);
  EXPECT_NE(text.find(R"("position":"NaN","velocity":"Infinity","effort":"-Infinity")"),
            std::string::npos)
      << text;
  EXPECT_EQ(text, protobuf_json("JointState", joints(snapshot, Content::pb)));
}

TEST(AimrtJson, OfAnyNumberIsReadByAimrtToTheBit) {
  for (const double value :
       {0.1 + 0.2, 1e-4, 1e300, 5e-324, 123456789.125, 1.0 / 3, 1e18, 1e19, 4e9}) {
    const auto snapshot = snapshot_with_axis(value, -value, value / 3);
    EXPECT_EQ(protobuf_of_json("JointState", joints(snapshot, Content::json)),
              joints(snapshot, Content::pb))
        << value;
  }
}

TEST(AimrtJson, KeepsAnyNameReadable) {
  auto snapshot = snapshot_with_axis(1, 2, 3);
  for (const char* name : {"vorne \"links\"", "back\\slash", "\xe5\xb7\xa6", "tab\there", "<&>"}) {
    snapshot.axes[0].joint = name;
    EXPECT_EQ(protobuf_of_json("JointState", joints(snapshot, Content::json)),
              joints(snapshot, Content::pb))
        << name;
  }
}

TEST(AimrtJson, OfTheInertialSensorIsWhatAimrtWrites) {
  Snapshot snapshot;
  auto& imu = snapshot.imu;
  imu.time = Time(Duration(2'000));
  imu.sample.acceleration_mps2 = {0.25, -0.5, 9.8125};
  imu.sample.angular_velocity_radps = {0.125, 0.25, 0.5};
  imu.sample.has_orientation = true;
  imu.sample.orientation = {0.5, -0.5, 0.5, -0.5};
  imu.angular_velocity_sigma_radps = 0.5;
  const auto text = imu_state(snapshot, kStamping, Content::json);
  EXPECT_EQ(text, protobuf_json("ImuState", imu_state(snapshot, kStamping)));
  EXPECT_EQ(protobuf_of_json("ImuState", text), imu_state(snapshot, kStamping));
}

TEST(AimrtJson, OfASaturatedSampleSaysThatNothingIsKnownOfItsErrors) {
  Snapshot snapshot;
  auto& imu = snapshot.imu;
  imu.sample.saturated = true;
  imu.angular_velocity_sigma_radps = imu.acceleration_sigma_mps2 = 0.5;
  const auto text = imu_state(snapshot, kStamping, Content::json);
  for (const char* key : {"angular_velocity_covariance", "linear_acceleration_covariance"})
    EXPECT_NE(text.find("\"" + std::string(key) + "\":[0,0,0,0,0,0,0,0,0]"), std::string::npos)
        << text;
}

TEST(AimrtJson, OfTouchIsWhatAimrtWrites) {
  Snapshot snapshot;
  snapshot.time = Time(Duration(3'000));
  for (const auto line : {Line::bumper, Line::zone_near}) {
    snapshot.line_configured[static_cast<std::size_t>(line)] = true;
    snapshot.line_health[static_cast<std::size_t>(line)] = SourceState::fresh;
  }
  snapshot.line_active[static_cast<std::size_t>(Line::zone_near)] = true;
  const auto text = touch_state(snapshot, kStamping, Content::json);
  EXPECT_NE(text.find(R"("names":["bumper","zone_near"],"states":[{"pressure":[0]},)"
                      R"({"pressure":[1]}]})"),
            std::string::npos)
      << text;
  for (const char* type : {"TouchState", "TouchSensorStateArray"})
    EXPECT_EQ(text, protobuf_json(type, touch_state(snapshot, kStamping))) << type;
}

TEST(AimrtJson, GoesOutInThePacketThatNamesIt) {
  ChannelConfig config;
  config.joint_state_wording.content = Content::json;
  JointCommands commands({});
  Channel channel(config, commands);
  const auto packets =
      channel.telemetry(snapshot_with_axis(1, 2, 3), kStamping.wall_minus_monotonic);
  ASSERT_EQ(packets.size(), 1U);
  EXPECT_EQ(*packets[0].topic, "/channel/%2Fjoint_state/pb%3Aaimrt.protocols.sensor.JointState");
  EXPECT_EQ(packets[0].payload.substr(0, 8), std::string("\x04json\0{\"", 8));
}

}  // namespace
}  // namespace drover::publish::aimrt
