#include "sim/scenario/command_stream.h"

#include <gtest/gtest.h>

#include <cmath>

#include "support/protoc.h"

namespace drover::sim {
namespace {

using namespace std::chrono_literals;

constexpr Time kBegin{5s};

TEST(AJointCommandPacket, SaysWhatWasMeant) {
  const std::string long_name(200, 'x');
  const auto bytes = joint_command_packet({{"front_left", -1.5}, {long_name, NAN}});
  EXPECT_EQ(bytes.substr(0, 4), std::string("\x02pb\0", 4));
  EXPECT_EQ(test::protoc_decoded("JointCommand", test::message_of_packet(bytes)),
            "joints {\n  name: \"front_left\"\n  velocity: -1.5\n}\n"
            "joints {\n  name: \"" +
                long_name + "\"\n  velocity: nan\n}\n");
}

TEST(AJointCommandPacket, SaysTheSameInJson) {
  const std::vector<JointSent> joints{{"front_left", -1.5}, {"rear_left", NAN}};
  const auto bytes = joint_command_json_packet(joints);
  EXPECT_EQ(bytes.substr(0, 6), std::string("\x04json\0", 6));
  EXPECT_EQ(test::protobuf_of_json("JointCommandArray", test::message_of_packet(bytes)),
            test::message_of_packet(joint_command_packet(joints)));
}

TEST(ACommandStream, GoesToTheTopicOfItsForm) {
  CommandStream stream;
  const std::string topic = "/channel/%2Fjoint_command/pb%3Aaimrt.protocols.sensor.JointCommand";
  stream.begin({{{"a", 1}}, 50, 1s, {}}, kBegin);
  EXPECT_EQ(stream.topic(), topic);
  EXPECT_EQ(stream.due(kBegin)->substr(0, 3), "\x02pb");
  stream.begin({{{"a", 1}}, 50, 1s, {.aimrt_1x = true, .json = true}}, kBegin);
  EXPECT_EQ(stream.topic(), topic + "Array");
  EXPECT_EQ(stream.due(kBegin)->substr(0, 5), "\x04json");
}

TEST(ACommandStream, SendsAtItsRateUntilItsTimeIsOver) {
  CommandStream stream;
  EXPECT_EQ(stream.next(), Time::max());
  EXPECT_FALSE(stream.due(kBegin));
  EXPECT_FALSE(stream.ends(kBegin));
  stream.begin({{{"a", 1}}, 50, 1s}, kBegin);
  int sent = 0;
  Time now = kBegin;
  for (; !stream.ends(now); now = stream.next())
    if (stream.due(now)) ++sent;
  EXPECT_EQ(sent, 50);
  EXPECT_EQ(now, kBegin + 1s);
  EXPECT_EQ(stream.next(), Time::max());
}

TEST(ACommandStream, SendsNoBurstWhenItWasNotAskedInTime) {
  CommandStream stream;
  stream.begin({{{"a", 1}}, 50, 1s}, kBegin);
  EXPECT_TRUE(stream.due(kBegin + 500ms));
  EXPECT_EQ(stream.next(), kBegin + 500ms);
  EXPECT_TRUE(stream.due(kBegin + 500ms));
  EXPECT_FALSE(stream.due(kBegin + 510ms));
}

}  // namespace
}  // namespace drover::sim
