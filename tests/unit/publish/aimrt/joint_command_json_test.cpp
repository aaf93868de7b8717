// Joint commands as JSON: what libprotobuf reads is read to the same values, the rest is refused.
#include <gtest/gtest.h>

#include <cmath>
#include <utility>

#include "publish/aimrt/joint_command.h"
#include "support/protoc.h"

namespace drover::publish::aimrt {
namespace {

using test::protobuf_json;
using test::protobuf_of_json;
using test::protoc_encoded;

std::string refusal(const std::string& text) {
  const auto message = decode_joint_command_json(text);
  if (message) return "read";
  const std::string_view why = message.error().view();
  constexpr std::string_view kStart = "the JSON is no JointCommand: ";
  EXPECT_TRUE(why.starts_with(kStart)) << why;
  return std::string(why.substr(std::min(kStart.size(), why.size())));
}

bool same(double a, double b) {
  return a == b || (std::isnan(a) && std::isnan(b));
}

void expect_same(const JointCommandMessage& a, const JointCommandMessage& b) {
  EXPECT_EQ(a.stamp_ns, b.stamp_ns);
  EXPECT_EQ(a.sequence, b.sequence);
  EXPECT_EQ(a.frame_id, b.frame_id);
  ASSERT_EQ(a.joints.size(), b.joints.size());
  for (std::size_t i = 0; i < a.joints.size(); ++i) {
    EXPECT_EQ(a.joints[i].name, b.joints[i].name);
    EXPECT_TRUE(same(a.joints[i].position_rad, b.joints[i].position_rad));
    EXPECT_TRUE(same(a.joints[i].velocity_radps, b.joints[i].velocity_radps));
    EXPECT_TRUE(same(a.joints[i].effort_Nm, b.joints[i].effort_Nm));
    EXPECT_TRUE(same(a.joints[i].stiffness, b.joints[i].stiffness));
    EXPECT_TRUE(same(a.joints[i].damping, b.joints[i].damping));
  }
}

TEST(AimrtJsonCommand, OfAimrtIsReadToTheSameValuesAsItsBytes) {
  const auto bytes = protoc_encoded(
      "JointCommandArray",
      "header { time_stamp: 1764000000000001000 frame_id: \"arm\" sequence_num: "
      "18446744073709551615 } joints { name: \"left\" position: 1 velocity: -0.1 effort: 3e-9 "
      "stiffness: 4 damping: 5 } joints { name: \"right\" velocity: nan }");
  const auto message = decode_joint_command_json(protobuf_json("JointCommandArray", bytes));
  ASSERT_TRUE(message) << message.error().view();
  expect_same(*message, *decode_joint_command(bytes));
  EXPECT_EQ(message->stamp_ns, 1764000000000001000U);
  EXPECT_TRUE(std::isnan(message->joints[1].velocity_radps));
}

TEST(AimrtJsonCommand, IsReadAsProtobufReadsIt) {
  for (const std::string text : {
           R"({})",
           R"({"header":null,"joints":null})",
           R"({"header":{"timeStamp":5,"frameId":"a","sequenceNum":"6"}})",
           R"({"header":{"time_stamp":1e3,"sequence_num":2.0}})",
           R"({"header":{"time_stamp":9223372036854775809}})",
           R"({"joints":[{"name":"left","velocity":"1.5","position":null}]})",
           R"({"joints":[{"name":"left","velocity":"-Infinity","damping":"NaN"}]})",
           R"( { "joints" : [ { "velocity" : 1e-3 , "name" : "\u5de6" } , {} ] } )",
       }) {
    const auto message = decode_joint_command_json(text);
    ASSERT_TRUE(message) << text << message.error().view();
    expect_same(*message, *decode_joint_command(protobuf_of_json("JointCommand", text)));
  }
}

TEST(AimrtJsonCommand, ThatProtobufRefusesIsRefusedAndSaysWhere) {
  const std::pair<const char*, const char*> cases[] = {
      {R"([])", "it is no object"},
      {R"({"joint":[]})", "joint is no field of it"},
      {R"({"header":[]})", "header is no object"},
      {R"({"header":{"stamp":1}})", "header.stamp is no field of it"},
      {R"({"header":{"time_stamp":-1}})", "header.time_stamp is no whole number"},
      {R"({"header":{"time_stamp":1.5}})", "header.time_stamp is no whole number"},
      {R"({"header":{"time_stamp":"now"}})", "header.time_stamp is no whole number"},
      {R"({"header":{"frame_id":1}})", "header.frame_id is no text"},
      {R"({"joints":[{},{"speed":1}]})", "joints[1].speed is no field of it"},
      {R"({"joints":[{"velocity":"fast"}]})", "joints[0].velocity is no number"},
      {R"({"joints":[{"velocity":true}]})", "joints[0].velocity is no number"},
      {R"({"joints":[{"velocity":"1e999"}]})", "joints[0].velocity is no number"},
      {R"({"joints":[{"name":7}]})", "joints[0].name is no text"},
  };
  for (const auto& [text, why] : cases) {
    EXPECT_EQ(refusal(text), why);
    EXPECT_THROW((void)protobuf_of_json("JointCommand", text), std::runtime_error) << text;
  }
  for (const char* text : {R"({"joints":[{"velocity":NaN}]})", R"({"joints":[{"velocity":1e999}]})",
                           R"({"joints":[)", "", "x"}) {
    EXPECT_EQ(refusal(text).substr(0, 6), "line 1") << text;
    EXPECT_THROW((void)protobuf_of_json("JointCommand", text), std::runtime_error) << text;
  }
}

TEST(AimrtJsonCommand, WithAFieldTwiceOrAJointWithoutListIsRefusedThoughProtobufReadsIt) {
  EXPECT_EQ(refusal(R"({"joints":{}})"), "joints is no list");
  EXPECT_EQ(refusal(R"({"joints":[null]})"), "joints[0] is no object");
  EXPECT_EQ(refusal(R"({"header":{"time_stamp":1,"timeStamp":2}})"), "time_stamp is there twice");
  EXPECT_NE(refusal(R"({"joints":[{"velocity":1,"velocity":0}]})").find("twice"),
            std::string::npos);
}

TEST(AimrtJsonCommand, ThatIsDeepLongOrWideIsNotRead) {
  EXPECT_NE(refusal(std::string(2000, '[')).find("nested deeper"), std::string::npos);
  std::string wide = R"({"joints":[{})";
  for (int i = 0; i < 2000; ++i) wide += ",{}";
  EXPECT_NE(refusal(wide + "]}").find("values"), std::string::npos);
  EXPECT_NE(refusal(std::string(kMaxCommandBytes + 1, ' ')).find("limit"), std::string::npos);
}

TEST(AimrtJsonCommand, RefusedShowsNoControlCharacterOfIt) {
  for (const char c : refusal("{\"a\\u0001\\u007f\":1}")) EXPECT_GE(c, ' ');
}

}  // namespace
}  // namespace drover::publish::aimrt
