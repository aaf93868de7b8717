// The AimRT channel of the daemon as it is shipped, seen from the broker.
#include <gmock/gmock.h>

#include "integration/robot_rig.h"
#include "support/protoc.h"

namespace drover::test {
namespace {

using testing::HasSubstr;
using testing::Not;

constexpr const char* kJoints = "/channel/%2Fjoint_state/pb%3Aaimrt.protocols.sensor.JointState";
constexpr const char* kTouch = "/channel/%2Ftouch_state/pb%3Aaimrt.protocols.sensor.TouchState";
constexpr const char* kCommand =
    "/channel/%2Fjoint_command/pb%3Aaimrt.protocols.sensor.JointCommand";
// AimRT 1.x's.
constexpr const char* kJointArray =
    "/channel/%2Fjoint_state/pb%3Aaimrt.protocols.sensor.JointStateArray";
constexpr const char* kTouchArray =
    "/channel/%2Ftouch_state/pb%3Aaimrt.protocols.sensor.TouchSensorStateArray";
constexpr const char* kCommandArray =
    "/channel/%2Fjoint_command/pb%3Aaimrt.protocols.sensor.JointCommandArray";

constexpr std::array kRobotJoints{"front_left", "rear_left", "front_right", "rear_right"};

/// One velocity for all joints, as the document's programs write it.
std::string in_protobuf(const std::string& velocity) {
  std::string text;
  for (const char* name : kRobotJoints)
    text += "joints { name: \"" + std::string(name) + "\" velocity: " + velocity + " } ";
  return std::string("\x02pb\0", 4) + protoc_encoded("JointCommand", text);
}

/// The same as AimRT 1.x writes it when it is told to write JSON.
std::string in_json(const std::string& velocity) {
  std::string text;
  for (const char* name : kRobotJoints)
    text += "joints { name: \"" + std::string(name) + "\" velocity: " + velocity + " } ";
  return std::string("\x04json\0", 6) +
         protobuf_json("JointCommandArray", protoc_encoded("JointCommandArray", text));
}

class AimrtChannel : public RobotRig {
 protected:
  /// The newest message of a topic, as protoc reads it.
  std::string decoded(const char* topic, const char* type) {
    return protoc_decoded(type, message_of_packet(client().last(topic)));
  }
  /// `text` as protoc reads it, like `joints { name: "front_left" velocity: 1 }`.
  void command(std::string_view text, bool retained = false) {
    const std::string start("\x02pb\0", 4);
    client().publish(kCommand, start + protoc_encoded("JointCommand", text), retained);
  }
  bool wait_for_log(std::string_view text) {
    return wait_until([&] { return daemon().output().find(text) != std::string::npos; });
  }
  void expect_nothing_moved() {
    stop_daemon();
    for (const auto& point : set_points_on_the_bus())
      ASSERT_EQ(point.velocity_turnps, 0) << "node " << point.node;
  }
};

TEST_F(AimrtChannel, ShowsJointsAndContactsInTheDocumentsFields) {
  ASSERT_NO_FATAL_FAILURE(start_all());
  ASSERT_TRUE(wait_until([&] { return !client().last(kTouch).empty(); }));
  // A joint that was not heard yet has no numbers.
  ASSERT_TRUE(
      wait_until([&] { return decoded(kJoints, "JointState").find("nan") == std::string::npos; }));
  const auto joints = decoded(kJoints, "JointState");
  for (const char* name : kRobotJoints)
    EXPECT_THAT(joints, HasSubstr("name: \"" + std::string(name) + "\"")) << joints;
  EXPECT_THAT(joints, HasSubstr("time_stamp: "));
  EXPECT_THAT(joints, Not(HasSubstr("nan"))) << joints;
  EXPECT_THAT(decoded(kTouch, "TouchState"),
              HasSubstr("names: \"bumper\"\nnames: \"zone_far\"\nnames: \"zone_near\"\n"
                        "states {\n  pressure: 0\n}\n"));
  EXPECT_EQ(sim({"bumper", "touch"}), "ok\n");
  EXPECT_TRUE(wait_until(
      [&] { return decoded(kTouch, "TouchState").find("pressure: 1") != std::string::npos; }));
}

TEST_F(AimrtChannel, FollowsNoCommandThatIsNotWhollyGood) {
  ASSERT_NO_FATAL_FAILURE(start_broker());
  // Lies there since some other day, and is not brought.
  command(R"(joints { name: "front_left" velocity: 1 })", true);
  ASSERT_NO_FATAL_FAILURE(start_sim());
  ASSERT_NO_FATAL_FAILURE(start_guard());
  start_daemon();
  ASSERT_TRUE(wait_for_locate());
  wait_until_believed();
  EXPECT_THAT(daemon().output(), Not(HasSubstr("joint command refused")));
  command(R"(joints { name: "front_left" velocity: 1 })", true);
  EXPECT_TRUE(wait_for_log("joint command refused: a retained message is never followed"));
  command(R"(joints { name: "front_left" velocity: 1 } joints { name: "wing" velocity: 1 })");
  EXPECT_TRUE(wait_for_log("joint command refused: joint 'wing': there is no such joint"));
  command(R"(joints { name: "front_left" velocity: nan })");
  EXPECT_TRUE(wait_for_log("joint command refused: joint 'front_left': velocity is NaN"));
  // The journal has its fill; these are refused in silence.
  command(R"(header { time_stamp: 1 } joints { name: "front_left" velocity: 1 })");
  command(R"(joints { name: "front_left" velocity: 1 stiffness: -1 })");
  client().publish(kCommand, "\x02pb");
  const double sent_s = now_s();
  (void)wait_until([&] { return now_s() > sent_s + 1; });  // long enough to move, if it would
  expect_nothing_moved();
}

TEST_F(AimrtChannel, FollowsAStreamOfCommandsUntilItFallsSilent) {
  ASSERT_NO_FATAL_FAILURE(start_all());
  const auto rest = in_protobuf("0");  // a stream begins at rest, for as long as it may be silent
  const auto slow = in_protobuf("1");  // rad/s: 0.165 m/s with this rig's wheels
  const double begun_s = now_s();
  EXPECT_TRUE(wait_until([&] {
    client().publish(kCommand, now_s() < begun_s + 2.5 ? rest : slow);
    return true_speed_mps() > 0.1;
  })) << daemon().output();
  EXPECT_TRUE(wait_until([this] { return at_rest(); })) << "nobody commands any more";
  EXPECT_EQ(status_text("nav", "status"), "NAV_FREE");
}

/// What is refused neither moves anything nor disturbs the stream that it comes in between.
TEST_F(AimrtChannel, GoesOnWithItsStreamAmidBadCommands) {
  ASSERT_NO_FATAL_FAILURE(start_all());
  const std::string start("\x02pb\0", 4);
  const auto encoded = [&](std::string_view text) {
    return start + protoc_encoded("JointCommand", text);
  };
  const std::string fast = R"(joints { name: "front_left" velocity: 9 } )";
  const std::vector<std::string> bad{
      encoded(fast + R"(joints { name: "wing" velocity: 9 })"),
      encoded(fast + fast),
      encoded(fast + R"(joints { velocity: 9 })"),
      encoded(R"(joints { name: "front_left" velocity: nan })"),
      encoded(R"(joints { name: "front_left" velocity: inf })"),
      encoded(R"(joints { name: "front_left" velocity: 1e30 })"),
      encoded(R"(joints { name: "front_left" velocity: 9 stiffness: 3 })"),
      encoded(R"(joints { name: "front_left" velocity: 9 damping: -1 })"),
      in_protobuf("9").substr(0, 40),
      start + "\xff\xff\xff\xff",
      "\x02pb",
      "",
      std::string(20'000, 'x'),
  };
  const auto rest = in_protobuf("0");
  const auto slow = in_protobuf("1");
  const double begun_s = now_s();
  std::size_t sent = 0;
  const auto stream = [&] {
    const bool begins = now_s() < begun_s + 2.5;
    client().publish(kCommand, begins ? rest : slow);
    if (!begins) client().publish(kCommand, bad[sent++ % bad.size()]);
  };
  EXPECT_TRUE(wait_until([&] {
    stream();
    return true_speed_mps() > 0.1 && sent > 2 * bad.size();
  })) << daemon().output();
  const double drove_from_s = now_s();
  double slowest_mps = 1;
  (void)wait_until([&] {
    stream();
    slowest_mps = std::min(slowest_mps, true_speed_mps());
    return now_s() > drove_from_s + 2;
  });
  EXPECT_GT(slowest_mps, 0.05) << "a bad command ended the stream";
  EXPECT_TRUE(wait_until([this] { return at_rest(); })) << "nobody commands any more";
  stop_daemon();
  for (const auto& point : set_points_on_the_bus())
    ASSERT_LT(std::abs(point.velocity_turnps), 1.01 / (2 * M_PI)) << "1 rad/s of a wheel, never 9";
}

TEST_F(AimrtChannel, SpeaksWithProgramsOfAimrt1x) {
  add_section(R"("aimrt": {"joint_state_names": "both", "joint_state_content": "json",
                           "touch_state_names": "aimrt_1x"})");
  ASSERT_NO_FATAL_FAILURE(start_all());
  const auto heard = [this](const char* topic) { return !client().last(topic).empty(); };
  ASSERT_TRUE(wait_until([&] { return heard(kJoints) && heard(kTouchArray); }));
  EXPECT_FALSE(heard(kTouch));
  const auto text = message_of_packet(client().last(kJointArray));
  const auto joints = protoc_decoded("JointStateArray", protobuf_of_json("JointStateArray", text));
  for (const char* name : kRobotJoints)
    EXPECT_THAT(joints, HasSubstr("name: \"" + std::string(name) + "\"")) << text;
  EXPECT_THAT(joints, HasSubstr("time_stamp: "));
  EXPECT_THAT(
      protoc_decoded("TouchSensorStateArray", message_of_packet(client().last(kTouchArray))),
      HasSubstr("names: \"bumper\"\nnames: \"zone_far\"\n"));

  OperatorClient second("second");
  ASSERT_TRUE(second.connect(port(), "nothing"));
  const auto rest = in_json("0");
  const auto slow = in_json("1");
  const auto fast = in_protobuf("9");
  const double begun_s = now_s();
  const auto command = [&] {
    client().publish(kCommandArray, now_s() < begun_s + 2.5 ? rest : slow);
  };
  EXPECT_TRUE(wait_until([&] {
    command();
    return true_speed_mps() > 0.1;
  })) << daemon().output();
  const std::string told =
      "two programs write joint commands: JointCommandArray (json) has the joints, JointCommand "
      "(pb) is refused";
  EXPECT_TRUE(wait_until([&] {
    command();
    second.publish(kCommand, fast);
    return client().last("base_status").find(told) != std::string::npos;
  })) << daemon().output();
  EXPECT_TRUE(wait_for_log("joint command refused: " + told));
  const auto status = drover({"status", "--json"}).text;
  EXPECT_THAT(status, HasSubstr("\"of_rivals\":"));
  EXPECT_THAT(status, Not(HasSubstr("\"of_rivals\":0")));
  EXPECT_THAT(drover({"status"}).text, HasSubstr("of a second program"));
  stop_daemon();
  double fastest_turnps = 0;
  for (const auto& point : set_points_on_the_bus())
    fastest_turnps = std::max<double>(fastest_turnps, std::abs(point.velocity_turnps));
  EXPECT_GT(fastest_turnps, 0.5 / (2 * M_PI));
  EXPECT_LT(fastest_turnps, 1.01 / (2 * M_PI)) << "1 rad/s of a wheel, never 9";
}

}  // namespace
}  // namespace drover::test
