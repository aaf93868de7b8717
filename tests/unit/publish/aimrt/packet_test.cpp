#include "publish/aimrt/packet.h"

#include <gtest/gtest.h>

#include <fstream>

#include "publish/aimrt/joint_command.h"
#include "publish/aimrt/topic.h"
#include "tests/unit/publish/aimrt/wire.h"

namespace drover::publish::aimrt {
namespace {

using test::hex;

TEST(AimrtPacket, RefusesEveryTruncationOfItsHeader) {
  // "pb", one pair: key "ab", value "c".
  const auto whole = hex("02 70 62  01  02 00 61 62  01 00 63");
  ASSERT_TRUE(decode_packet(whole).ok());
  for (std::size_t size = 0; size < whole.size(); ++size)
    EXPECT_FALSE(decode_packet(std::string_view(whole).substr(0, size)).ok()) << size;
}

TEST(AimrtPacket, SaysWhereItEnds) {
  EXPECT_EQ(decode_packet("").error(), PacketError::no_content_type);
  EXPECT_EQ(decode_packet(hex("03 70 62")).error(), PacketError::no_content_type);
  EXPECT_EQ(decode_packet(hex("02 70 62")).error(), PacketError::no_context);
  EXPECT_EQ(decode_packet(hex("02 70 62 01")).error(), PacketError::bad_context);
}

TEST(AimrtPacket, SaysWhatIsMissingBeforeBareJson) {
  const std::string bare = R"({"header":{},"joints":[{"name":"shoulder"}]})";
  ASSERT_EQ(decode_packet(bare).error(), PacketError::bare_json);
  EXPECT_EQ(decode_packet(bare + std::string(200, ' ')).error(), PacketError::bare_json);
  const std::string_view said = text(PacketError::bare_json);
  const auto from = said.find("04 6a");
  ASSERT_NE(from, std::string_view::npos) << said;
  const std::string missing = hex(said.substr(from, std::string_view("04 6a 73 6f 6e 00").size()));
  EXPECT_EQ(missing + bare, encode_packet(bare, Content::json));
}

TEST(AimrtPacket, RefusesAContextLongerThanThePacket) {
  EXPECT_EQ(decode_packet(hex("02 70 62 01 ff ff 61 62 01 00 63")).error(),
            PacketError::bad_context);
  EXPECT_EQ(decode_packet(hex("02 70 62 01 02 00 61 62 02 00 63")).error(),
            PacketError::bad_context);
  EXPECT_EQ(decode_packet(hex("02 70 62 ff 00 00 00 00")).error(), PacketError::bad_context);
}

TEST(AimrtPacket, GivesContentTypeContextAndMessage) {
  const std::string bytes = hex("04 6a 73 6f 6e  01  01 00 61  00 00  7b 7d");
  const auto packet = decode_packet(bytes);
  ASSERT_TRUE(packet.ok());
  EXPECT_EQ(packet->content_type, "json");
  EXPECT_EQ(packet->context, hex("01 00 61 00 00"));
  EXPECT_EQ(packet->message, "{}");
}

TEST(AimrtPacket, CountsALengthOfTwoBytesLittleEndian) {
  const std::string value(0x0102, 'v');
  const std::string bytes = hex("02 70 62 01 00 00 02 01") + value + "message";
  const auto packet = decode_packet(bytes);
  ASSERT_TRUE(packet.ok());
  EXPECT_EQ(packet->message, "message");
}

TEST(AimrtPacket, IsWrittenWithoutContext) {
  EXPECT_EQ(encode_packet(hex("08 01")), hex("02 70 62 00 08 01"));
  EXPECT_EQ(encode_packet(""), hex("02 70 62 00"));
}

TEST(AimrtPacket, TellsThatItsMessageIsJson) {
  EXPECT_EQ(encode_packet("{}", Content::json), hex("04 6a 73 6f 6e 00 7b 7d"));
}

/// Of the lines between ``` and ``` the bytes, which end at two blanks; behind them are words.
std::string bytes_of_readme() {
  std::ifstream file(std::string(DROVER_SOURCE_DIR) + "/src/publish/README.md");
  std::string digits;
  bool inside = false;
  for (std::string line; std::getline(file, line);) {
    if (line.starts_with("```"))
      inside = line == "```text";
    else if (inside)
      digits += line.substr(0, line.find("  "));
  }
  return hex(digits);
}

TEST(AimrtPacket, IsTheReadmesJointCommand) {
  const std::string readme = bytes_of_readme();
  EXPECT_EQ(readme, encode_packet(test::bytes_field(
                        2, test::bytes_field(1, "elbow") + test::double_field(2, 0.5) +
                               test::double_field(5, 40) + test::double_field(6, 1.5))));
  const auto packet = decode_packet(readme);
  ASSERT_TRUE(packet.ok());
  const auto command = decode_joint_command(packet->message);
  ASSERT_TRUE(command);
  ASSERT_EQ(command->joints.size(), 1U);
  EXPECT_EQ(command->joints[0].name, "elbow");
  EXPECT_EQ(command->joints[0].position_rad, 0.5);
  EXPECT_EQ(command->joints[0].stiffness, 40);
  EXPECT_EQ(command->joints[0].damping, 1.5);
}

TEST(AimrtTopic, IsTheDocumentsExample) {
  EXPECT_EQ(mqtt_topic("/joint_state", Role::joint_state, Names::aimrt_1x),
            "/channel/%2Fjoint_state/pb%3Aaimrt.protocols.sensor.JointStateArray");
}

TEST(AimrtTopic, HasTheNamesOfEitherFamily) {
  const auto name = [](Role role, Names names) { return std::string(type_name(role, names)); };
  EXPECT_EQ(name(Role::joint_state, Names::document), "JointState");
  EXPECT_EQ(name(Role::joint_command, Names::document), "JointCommand");
  EXPECT_EQ(name(Role::joint_command, Names::aimrt_1x), "JointCommandArray");
  EXPECT_EQ(name(Role::touch_state, Names::document), "TouchState");
  EXPECT_EQ(name(Role::touch_state, Names::aimrt_1x), "TouchSensorStateArray");
  EXPECT_EQ(name(Role::imu_state, Names::document), name(Role::imu_state, Names::aimrt_1x));
}

}  // namespace
}  // namespace drover::publish::aimrt
