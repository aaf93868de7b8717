#include "publish/aimrt/joint_command.h"

#include <gtest/gtest.h>

#include <limits>

#include "tests/unit/publish/aimrt/wire.h"

namespace drover::publish::aimrt {
namespace {

using test::hex;
using test::joint_entry;
using test::stamp;

constexpr std::uint64_t kMs = 1'000'000;
constexpr std::uint64_t kNow_ns = 1'700'000'000'000 * kMs;
constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();
constexpr double kInfinity = std::numeric_limits<double>::infinity();

Result<JointTargets, Reason> judge(const std::string& bytes, std::uint64_t last_stamp_ns = 0,
                                   std::uint64_t now_ns = kNow_ns) {
  const auto message = decode_joint_command(bytes);
  if (!message) return Reason("not decodable");
  const JointCommandRules rules{{"left", "right"}, std::chrono::milliseconds(250)};
  return accept_joint_command(*message, rules, Duration(now_ns), last_stamp_ns);
}

std::string refusal(const std::string& bytes, std::uint64_t last_stamp_ns = 0) {
  const auto result = judge(bytes, last_stamp_ns);
  return result ? "accepted" : std::string(result.error().view());
}

TEST(AimrtJointCommand, RefusesBytesThatAreNone) {
  EXPECT_FALSE(decode_joint_command(hex("ff")));
  EXPECT_FALSE(decode_joint_command(hex("12 05 0a 01 61")));     // ends inside a joint
  EXPECT_FALSE(decode_joint_command(hex("12 03 0a 01 ff")));     // a name that is no UTF-8
  EXPECT_FALSE(decode_joint_command(hex("0a 02 0a 01")));        // a header that is none
  EXPECT_FALSE(decode_joint_command(std::string(200, '\x0b')));  // groups in groups
  const auto whole = stamp(kNow_ns) + joint_entry("left", 0, 1);
  for (std::size_t size = 1; size < whole.size(); ++size) {
    if (size == stamp(kNow_ns).size()) continue;  // a header alone is a message
    EXPECT_FALSE(decode_joint_command(whole.substr(0, size))) << size;
  }
}

// Protobuf would pass such a field over, and the joint would be told 0 in its place.
TEST(AimrtJointCommand, RefusesAFieldOfAnotherWireTypeAndNamesIt) {
  const auto entry = [](const std::string& fields) { return test::bytes_field(2, fields); };
  const auto name = test::bytes_field(1, "left");
  const auto said = [](const std::string& bytes) {
    const auto message = decode_joint_command(bytes);
    return message ? "taken" : std::string(message.error().view());
  };
  EXPECT_EQ(said(entry(name + test::varint_field(2, 5))), "joints[0].position is no double");
  EXPECT_EQ(said(entry(name + test::varint_field(3, 5))), "joints[0].velocity is no double");
  EXPECT_EQ(said(entry(name + hex("25 00 00 80 3f"))), "joints[0].effort is no double");  // a float
  EXPECT_EQ(said(entry(name + test::bytes_field(5, test::little_endian(1)))),
            "joints[0].stiffness is no double");
  EXPECT_EQ(said(joint_entry("left", 0, 0) + entry(name + test::varint_field(6, 1))),
            "joints[1].damping is no double");
  EXPECT_EQ(said(entry(test::varint_field(1, 7))), "joints[0].name is no string");
  EXPECT_EQ(said(test::bytes_field(1, test::double_field(1, 0.5))),
            "header.time_stamp is no uint64");
  EXPECT_EQ(said(test::bytes_field(1, test::varint_field(2, 7))), "header.frame_id is no string");
  EXPECT_EQ(said(test::bytes_field(1, test::bytes_field(3, "12"))),
            "header.sequence_num is no uint64");
  EXPECT_EQ(said(test::varint_field(1, 7)), "header is no message");
  EXPECT_EQ(said(test::varint_field(2, 7)), "joints is no message");
  EXPECT_EQ(said(hex("13 14")), "joints is no message");  // a group
  // It does not count where it stands, nor what stands beside it.
  EXPECT_EQ(said(entry(test::double_field(2, 0.5) + name + test::bytes_field(9, "later edition") +
                       test::varint_field(2, 5))),
            "joints[0].position is no double");
}

TEST(AimrtJointCommand, PassesOverFieldsOfALaterEdition) {
  const auto bytes = test::bytes_field(1, test::varint_field(4, 7)) + test::varint_field(3, 1) +
                     hex("7b 08 01 7c") +  // a group of 15
                     test::bytes_field(2, test::bytes_field(1, "left") + test::double_field(7, 1));
  const auto message = decode_joint_command(bytes);
  ASSERT_TRUE(message);
  ASSERT_EQ(message->joints.size(), 1U);
  EXPECT_EQ(message->joints[0].name, "left");
}

TEST(AimrtJointCommand, RefusesAMessageThatIsTooLongToLookAt) {
  const auto padding = [](std::size_t size) {
    return test::bytes_field(15, std::string(size, 'x'));  // an unknown field
  };
  EXPECT_TRUE(decode_joint_command(padding(kMaxCommandBytes - 4)));
  EXPECT_FALSE(decode_joint_command(padding(kMaxCommandBytes)));
}

TEST(AimrtJointCommand, NamesTheUnitOfAStampThatIsNoneOfNanoseconds) {
  const auto said = [](std::uint64_t time_stamp) {
    return refusal(stamp(time_stamp) + joint_entry("left", 0, 1));
  };
  EXPECT_EQ(said(kNow_ns / 1'000'000'000),
            "time_stamp 1700000000 is in seconds: nanoseconds since 1970 are wanted");
  EXPECT_EQ(said(kNow_ns / kMs - 3'600'000),
            "time_stamp 1699996400000 is in milliseconds: nanoseconds since 1970 are wanted");
  EXPECT_EQ(said(kNow_ns / 1000 + 7),
            "time_stamp 1700000000000007 is in microseconds: nanoseconds since 1970 are wanted");
  EXPECT_EQ(said(1234), "time_stamp is 1700000000000 ms old, 250 ms are allowed");
  EXPECT_EQ(said(kNow_ns), "accepted");
}

TEST(AimrtJointCommand, RefusesTheWholeMessageAndNamesJointAndField) {
  const std::string good = joint_entry("left", 0, 1);
  EXPECT_EQ(refusal(""), "it names no joint");
  EXPECT_EQ(refusal(good + joint_entry("middle", 0, 1)), "joint 'middle': there is no such joint");
  EXPECT_EQ(refusal(joint_entry("", 0, 1)), "joint '': there is no such joint");
  EXPECT_EQ(refusal(good + good), "joint 'left': it is named twice");
  EXPECT_EQ(refusal(good + good + good), "it names 3 joints, this robot has 2");
  EXPECT_EQ(refusal(good + joint_entry("right", kNaN, 1)), "joint 'right': position is NaN");
  EXPECT_EQ(refusal(good + joint_entry("right", 0, kNaN)), "joint 'right': velocity is NaN");
  EXPECT_EQ(refusal(joint_entry("left", 0, -kInfinity)), "joint 'left': velocity is infinite");
  EXPECT_EQ(refusal(joint_entry("left", 0, 1, kNaN)), "joint 'left': effort is NaN");
  EXPECT_EQ(refusal(joint_entry("left", 0, 1, 0, kInfinity)),
            "joint 'left': stiffness is infinite");
  EXPECT_EQ(refusal(joint_entry("left", 0, 1, 0, 0, kNaN)), "joint 'left': damping is NaN");
  EXPECT_EQ(refusal(joint_entry("left", 1e6, 1)),
            "joint 'left': position 1e+06 is beyond the limit of 100000");
  EXPECT_EQ(refusal(joint_entry("left", 0, -1e6)),
            "joint 'left': velocity -1e+06 is beyond the limit of 100000");
  EXPECT_EQ(refusal(joint_entry("left", 0, 1, 0, -1)),
            "joint 'left': stiffness is -1, but this drive follows velocity only: 0");
  EXPECT_EQ(refusal(joint_entry("left", 0, 1, 2.5)),
            "joint 'left': effort is 2.5, but this drive follows velocity only: 0");
  EXPECT_EQ(refusal(joint_entry("left", 0, 1, 0, 0, -0.5)),
            "joint 'left': damping -0.5 is negative");
}

TEST(AimrtJointCommand, ForgesNoLineWithTheNameOfAJoint) {
  EXPECT_EQ(refusal(joint_entry("a\nb", 0, 1)), "joint 'a?b': there is no such joint");
  EXPECT_LT(refusal(joint_entry(std::string(4000, 'x'), 0, 1)).size(), 100U);
}

TEST(AimrtJointCommand, RefusesAnOldStamp) {
  const auto at = [](std::uint64_t ns) { return stamp(ns) + joint_entry("left", 0, 1); };
  EXPECT_EQ(refusal(at(kNow_ns - 250 * kMs)), "accepted");
  EXPECT_EQ(refusal(at(kNow_ns - 251 * kMs)), "time_stamp is 251 ms old, 250 ms are allowed");
  EXPECT_NE(refusal(at(1)), "accepted");
}

TEST(AimrtJointCommand, RefusesAStampOfTheFuture) {
  const auto at = [](std::uint64_t ns) { return stamp(ns) + joint_entry("left", 0, 1); };
  EXPECT_EQ(refusal(at(kNow_ns + 1000 * kMs)), "accepted");
  EXPECT_EQ(refusal(at(kNow_ns + 1001 * kMs)), "time_stamp is 1001 ms ahead of the robot's clock");
  EXPECT_NE(refusal(at(UINT64_MAX)), "accepted");
}

TEST(AimrtJointCommand, RefusesAStampThatIsNotNewerThanTheLast) {
  const auto message = stamp(kNow_ns) + joint_entry("left", 0, 1);
  EXPECT_EQ(refusal(message, kNow_ns - 1), "accepted");
  EXPECT_EQ(refusal(message, kNow_ns), "time_stamp is not newer than the last accepted one");
  EXPECT_EQ(refusal(message, kNow_ns + kMs), "time_stamp is not newer than the last accepted one");
}

TEST(AimrtJointCommand, ForgetsALastStampFromBeforeTheClockWasSetBack) {
  EXPECT_EQ(refusal(stamp(kNow_ns) + joint_entry("left", 0, 1), kNow_ns + 3600'000 * kMs),
            "accepted");
}

TEST(AimrtJointCommand, TakesAMessageWithoutAStampAtAnyTime) {
  EXPECT_TRUE(judge(joint_entry("left", 0, 1), kNow_ns).ok());
  EXPECT_TRUE(judge(stamp(0) + joint_entry("left", 0, 1), kNow_ns).ok());
}

TEST(AimrtJointCommand, GivesTheVelocitiesOfTheNamedJoints) {
  const auto targets =
      judge(stamp(kNow_ns) + joint_entry("right", 99, -2.5, 0, 0, 3) + joint_entry("left", 0, 1e4));
  ASSERT_TRUE(targets.ok());
  ASSERT_EQ(targets->joints.size(), 2U);
  EXPECT_EQ(targets->joints[0].axis, 1);
  EXPECT_EQ(targets->joints[0].velocity_radps, -2.5);
  EXPECT_EQ(targets->joints[1].axis, 0);
  EXPECT_EQ(targets->joints[1].velocity_radps, 1e4) << "clamping is the gate's";
}

TEST(AimrtJointCommand, DecodesBytesWorkedOutByHand) {
  // header{time_stamp 300}, joints{name "a", position 1, velocity 2, effort 4, stiffness -1,
  // damping 0.5}
  const auto message = decode_joint_command(
      hex("0a 03 08 ac02  12 30 0a 01 61  11 000000000000f03f  19 0000000000000040"
          "  21 0000000000001040  29 000000000000f0bf  31 000000000000e03f"));
  ASSERT_TRUE(message);
  EXPECT_EQ(message->stamp_ns, 300U);
  ASSERT_EQ(message->joints.size(), 1U);
  const auto& joint = message->joints[0];
  EXPECT_EQ(joint.name, "a");
  EXPECT_EQ(joint.position_rad, 1);
  EXPECT_EQ(joint.velocity_radps, 2);
  EXPECT_EQ(joint.effort_Nm, 4);
  EXPECT_EQ(joint.stiffness, -1);
  EXPECT_EQ(joint.damping, 0.5);
}

/// A joint of each kind outside the base.
JointCommandRules arm_rules() {
  JointCommandRules rules;
  rules.joints = {{"left"},
                  {"shoulder", JointFollows::impedance, 1},
                  {"elbow", JointFollows::position, 1},
                  {"roll", JointFollows::velocity, 1},
                  {"grip", JointFollows::effort, 2}};
  return rules;
}

std::string arm_refusal(const std::string& bytes) {
  const auto result =
      accept_joint_command(*decode_joint_command(bytes), arm_rules(), Duration(kNow_ns), 0);
  return result ? "" : std::string(result.error().view());
}

TEST(AimrtJointCommand, HandsOnAllFiveValues) {
  const auto targets =
      accept_joint_command(*decode_joint_command(joint_entry("shoulder", 0.5, -0.25, 1.5, 40, 2)),
                           arm_rules(), Duration(kNow_ns), 0);
  ASSERT_TRUE(targets);
  ASSERT_EQ(targets->joints.size(), 1u);
  const JointTarget& joint = targets->joints[0];
  EXPECT_EQ(joint.axis, 1);
  EXPECT_EQ(joint.position_rad, 0.5);
  EXPECT_EQ(joint.velocity_radps, -0.25);
  EXPECT_EQ(joint.effort_Nm, 1.5);
  EXPECT_EQ(joint.stiffness_Nmprad, 40);
  EXPECT_EQ(joint.damping_Nmsprad, 2);
}

/// As a position alone does.
TEST(AimrtJointCommand, LetsNoJointFallThatCarriesAWeight) {
  auto rules = arm_rules();
  rules.joints[1].carries_weight = true;
  const auto why = [&](double effort_Nm, double stiffness, double damping) {
    const auto message =
        decode_joint_command(joint_entry("shoulder", 0.5, 0, effort_Nm, stiffness, damping));
    const auto result = accept_joint_command(*message, rules, Duration(kNow_ns), 0);
    return result ? "" : std::string(result.error().view());
  };
  EXPECT_EQ(why(0, 0, 0),
            "joint 'shoulder': stiffness, damping and effort are 0: it carries a weight, and would "
            "fall");
  EXPECT_EQ(why(0, 40, 0), "");
  EXPECT_EQ(why(0, 0, 2), "") << "it is let down slowly";
  EXPECT_EQ(why(1.5, 0, 0), "") << "it is balanced by its program";
  EXPECT_EQ(arm_refusal(joint_entry("shoulder", 0.5, 0)), "") << "nothing pulls at it";
  const auto zeros = decode_joint_command(joint_entry("shoulder", 0, 0));
  EXPECT_TRUE(accept_joint_command(*zeros, rules, Duration(kNow_ns), 0))
      << "an effort that passes 0";
}

TEST(AimrtJointCommand, RefusesByNameWhatAJointDoesNotFollow) {
  EXPECT_EQ(arm_refusal(joint_entry("elbow", 0.5, 0.1)), "");
  EXPECT_EQ(arm_refusal(joint_entry("elbow", 0.5, 0.1, 0, 40)),
            "joint 'elbow': stiffness is 40, but it follows a position, as stiffly as is "
            "configured: 0");
  EXPECT_EQ(arm_refusal(joint_entry("elbow", 0.5, 0.1, 2)),
            "joint 'elbow': effort is 2, but it follows a position, as stiffly as is configured: "
            "0");
  EXPECT_EQ(arm_refusal(joint_entry("roll", 0, 1)), "");
  EXPECT_EQ(arm_refusal(joint_entry("roll", 0, 1, 0.5)),
            "joint 'roll': effort is 0.5, but it follows a velocity: 0");
  EXPECT_EQ(arm_refusal(joint_entry("grip", 0, 0, 3, 0, 0.1)), "");
  EXPECT_EQ(arm_refusal(joint_entry("grip", 0, 1, 3)),
            "joint 'grip': velocity is 1, but it follows an effort: 0");
  EXPECT_EQ(arm_refusal(joint_entry("shoulder", 0, 0, 0, -5)),
            "joint 'shoulder': stiffness -5 is negative");
  EXPECT_EQ(arm_refusal(joint_entry("shoulder", 0, 0, 0, 5, -1)),
            "joint 'shoulder': damping -1 is negative");
  EXPECT_EQ(arm_refusal(joint_entry("shoulder", 0, 0, 1e7)),
            "joint 'shoulder': effort 1e+07 is beyond the limit of 100000");
  EXPECT_EQ(arm_refusal(joint_entry("left", 0, 1, 0, 3)),
            "joint 'left': stiffness is 3, but this drive follows velocity only: 0");
}

}  // namespace
}  // namespace drover::publish::aimrt
