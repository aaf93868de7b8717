// What protoc makes of our packets, and we of protoc's, with the document's field numbers.
#include <gtest/gtest.h>

#include "publish/aimrt/channel.h"
#include "support/protoc.h"

namespace drover::publish::aimrt {
namespace {

using test::message_of_packet;
using test::protoc_decoded;
using test::protoc_encoded;

Snapshot full_snapshot() {
  Snapshot snapshot;
  snapshot.time = Time(Duration(1000));
  AxisSnapshot axis;
  axis.joint = "front_left";
  axis.motion = {0, 12.25, -1.5, 0.75};
  axis.health = SourceState::fresh;
  axis.last_motion = Time(Duration(900));
  EXPECT_TRUE(snapshot.axes.push_back(axis));
  auto& imu = snapshot.imu;
  imu.configured = true;
  imu.health = SourceState::fresh;
  imu.time = Time(Duration(950));
  imu.sample.acceleration_mps2 = {0.25, -0.5, 9.8125};
  imu.sample.angular_velocity_radps = {0.125, 0.25, 0.5};
  imu.gyro_bias_radps = {0, 0, 0.25};
  imu.sample.has_orientation = true;
  imu.sample.orientation = {0.5, -0.5, 0.5, -0.5};  // w, x, y, z
  imu.angular_velocity_sigma_radps = 0.5;
  snapshot.line_configured[static_cast<std::size_t>(Line::bumper)] = true;
  snapshot.line_health[static_cast<std::size_t>(Line::bumper)] = SourceState::fresh;
  snapshot.line_active[static_cast<std::size_t>(Line::bumper)] = true;
  return snapshot;
}

std::string header(const std::string& time_stamp) {
  return "header {\n  time_stamp: " + time_stamp +
         "\n  frame_id: \"base_link\"\n  sequence_num: 1\n}\n";
}

std::string covariance(const std::string& name, const std::string& variance) {
  std::string lines;
  for (int i = 0; i < 9; ++i) lines += name + ": " + (i % 4 == 0 ? variance : "0") + "\n";
  return lines;
}

TEST(AimrtPackets, AreReadByProtocWithTheDocumentsFieldNumbers) {
  JointCommands commands({});
  const auto packets = Channel({}, commands).telemetry(full_snapshot(), Duration(1'000'000));
  ASSERT_EQ(packets.size(), 3U);
  EXPECT_EQ(protoc_decoded("JointState", message_of_packet(packets[0].payload)),
            header("1000900") +
                "joints {\n  name: \"front_left\"\n  position: 12.25\n  velocity: -1.5\n"
                "  effort: 0.75\n}\n");
  EXPECT_EQ(protoc_decoded("ImuState", message_of_packet(packets[1].payload)),
            header("1000950") + "orientation {\n  x: -0.5\n  y: 0.5\n  z: -0.5\n  w: 0.5\n}\n" +
                covariance("orientation_covariance", "0") +
                "angular_velocity {\n  x: 0.125\n  y: 0.25\n  z: 0.25\n}\n" +
                covariance("angular_velocity_covariance", "0.25") +
                "linear_acceleration {\n  x: 0.25\n  y: -0.5\n  z: 9.8125\n}\n" +
                covariance("linear_acceleration_covariance", "0"));
  EXPECT_EQ(protoc_decoded("TouchState", message_of_packet(packets[2].payload)),
            header("1001000") + "names: \"bumper\"\nstates {\n  pressure: 1\n}\n");
}

TEST(AimrtPackets, AreReadByProtocWithTheNamesOfAimrt1x) {
  ChannelConfig config;
  config.joint_state_wording.names = config.touch_state_wording.names = {Names::aimrt_1x};
  JointCommands commands({});
  const auto packets = Channel(config, commands).telemetry(full_snapshot(), Duration(1'000'000));
  ASSERT_EQ(packets.size(), 3U);
  EXPECT_EQ(protoc_decoded("JointStateArray", message_of_packet(packets[0].payload)),
            header("1000900") +
                "joints {\n  name: \"front_left\"\n  position: 12.25\n  velocity: -1.5\n"
                "  effort: 0.75\n}\n");
  EXPECT_EQ(protoc_decoded("TouchSensorStateArray", message_of_packet(packets[2].payload)),
            header("1001000") + "names: \"bumper\"\nstates {\n  pressure: 1\n}\n");
}

TEST(AimrtPackets, OfProtocAreRead) {
  const auto message = decode_joint_command(protoc_encoded(
      "JointCommand",
      "header { time_stamp: 7 frame_id: \"any\" sequence_num: 3 } "
      "joints { name: \"left\" position: 1 velocity: 2 effort: 3 stiffness: 4 damping: 5 }"
      "joints { name: \"right\" velocity: -0.5 }"));
  ASSERT_TRUE(message);
  EXPECT_EQ(message->stamp_ns, 7U);
  ASSERT_EQ(message->joints.size(), 2U);
  const auto& left = message->joints[0];
  EXPECT_EQ(left.name, "left");
  EXPECT_EQ(left.position_rad, 1);
  EXPECT_EQ(left.velocity_radps, 2);
  EXPECT_EQ(left.effort_Nm, 3);
  EXPECT_EQ(left.stiffness, 4);
  EXPECT_EQ(left.damping, 5);
  EXPECT_EQ(message->joints[1].name, "right");
  EXPECT_EQ(message->joints[1].velocity_radps, -0.5);
}

}  // namespace
}  // namespace drover::publish::aimrt
