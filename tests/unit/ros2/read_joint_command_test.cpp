// A message on /joint_command as droverd's own reader of joint commands reads it.
#include "ros2/read_joint_command.h"

#include <gmock/gmock.h>

#include <cmath>
#include <vector>

#include "publish/aimrt/joint_command.h"

namespace drover::ros2 {
namespace {

using publish::aimrt::decode_joint_command_json;
using testing::HasSubstr;

using JointOnTheWire = aimrt_msgs_msg_dds__JointCommand_;

char* text_on_the_wire(const char* text) {
  return const_cast<char*>(text);
}

class AJointCommand : public testing::Test {
 protected:
  Result<std::string, Reason> read(std::size_t robots_joints = 16) {
    aimrt_msgs_msg_dds__JointCommandArray_ message{};
    message.header_.stamp_ = stamp_;
    message.header_.frame_id_ = text_on_the_wire("base");
    message.joints_._buffer = joints_.data();
    message.joints_._length = static_cast<std::uint32_t>(joints_.size());
    return read_joint_command(message, robots_joints);
  }

  builtin_interfaces_msg_dds__Time_ stamp_{};
  std::vector<JointOnTheWire> joints_;
};

TEST_F(AJointCommand, ReachesDroverdWithAllItsValues) {
  stamp_ = {1'700'000'000, 123'456'789};
  joints_ = {{text_on_the_wire("elbow"), 0.1, -0.2, 0.3, 40, 1e-7},
             {text_on_the_wire("k\xc3\xbc\"\\"), 1, 2, 3, 4, 5}};
  const auto text = read();
  ASSERT_TRUE(text.ok());
  const auto message = decode_joint_command_json(*text);
  ASSERT_TRUE(message.ok()) << message.error().view();
  EXPECT_EQ(message->stamp_ns, 1'700'000'000'123'456'789U);
  ASSERT_EQ(message->joints.size(), 2U);
  EXPECT_EQ(message->joints[0].name, "elbow");
  EXPECT_EQ(message->joints[0].position_rad, 0.1);
  EXPECT_EQ(message->joints[0].velocity_radps, -0.2);
  EXPECT_EQ(message->joints[0].effort_Nm, 0.3);
  EXPECT_EQ(message->joints[0].stiffness, 40);
  EXPECT_EQ(message->joints[0].damping, 1e-7);
  EXPECT_EQ(message->joints[1].name, "k\xc3\xbc\"\\");
}

TEST_F(AJointCommand, ThatSaysWhatIsNoNumberSaysItToDroverd) {
  joints_ = {{text_on_the_wire("elbow"), NAN, INFINITY, -INFINITY, 0, 0}};
  const auto message = decode_joint_command_json(*read());
  ASSERT_TRUE(message.ok()) << message.error().view();
  EXPECT_TRUE(std::isnan(message->joints[0].position_rad));
  EXPECT_EQ(message->joints[0].velocity_radps, INFINITY);
  EXPECT_EQ(message->joints[0].effort_Nm, -INFINITY);
}

TEST_F(AJointCommand, WithoutAStampHasNone) {
  EXPECT_EQ(decode_joint_command_json(*read())->stamp_ns, 0U);
  stamp_ = {-1, 0};
  EXPECT_EQ(read().error().view(), "header.stamp is no time since 1970");
  stamp_ = {1, 1'000'000'000};
  EXPECT_EQ(read().error().view(), "header.stamp is no time since 1970");
}

TEST_F(AJointCommand, OfMoreThanTheRobotHasIsRefusedUnread) {
  joints_.resize(17);
  EXPECT_EQ(read().error().view(), "it names 17 joints, this robot has 16");
  joints_.resize(1);
  EXPECT_EQ(read(0).error().view(), "it names 1 joints, this robot has 0");
  const std::string endless(256, 'x');
  joints_ = {{text_on_the_wire(endless.c_str()), 0, 0, 0, 0, 0}};
  EXPECT_THAT(std::string(read().error().view()), HasSubstr("xxx...': there is no such joint"));
}

TEST_F(AJointCommand, OfTheLongestNamesIsReadByDroverd) {
  const std::string longest(255, '\x01');  // six bytes each in JSON
  joints_.assign(16,
                 {text_on_the_wire(longest.c_str()), -1.2345678901234567e-300, NAN, NAN, NAN, NAN});
  EXPECT_LE(read()->size(), 2 * publish::aimrt::kMaxCommandBytes);
}

}  // namespace
}  // namespace drover::ros2
