// Joint commands of ROS 2 users, as drover-ros2 hands them on.
#include <gmock/gmock.h>

#include <algorithm>
#include <map>

#include "json/json_text.h"
#include "publish/ros2_outlet.h"

namespace drover::publish {
namespace {

using namespace std::chrono_literals;
using testing::HasSubstr;

constexpr const char* kTheyFollow = R"({"cmd":"ros2_follow","mode":"localhost"})";
constexpr const char* kWheels =
    R"({"joints":[{"name":"left","velocity":0},{"name":"right","velocity":0}]})";

class Ros2Joints : public testing::Test {
 protected:
  Ros2Joints() {
    Actions out;
    EXPECT_TRUE(open_.on_line(7, kTheyFollow, now_, out));
    EXPECT_TRUE(closed_.on_line(7, kTheyFollow, now_, out));
    now_ += kJustCame;
  }
  static aimrt::JointCommandsConfig config() {
    aimrt::JointCommandsConfig config;
    config.rules.joints = {{"left"},
                           {"right"},
                           {"elbow", JointFollows::impedance, 1},
                           {"wrist", JointFollows::impedance, 1}};
    config.just_came = kJustCame;
    return config;
  }
  std::string line(const std::string& message, const std::string& writer = "01.0a",
                   Duration waited = 0s) const {
    json::JsonText text;
    text.open('{').key("cmd").text("joint_command").key("writer").text(writer);
    text.key("at_ns").integer((now_ - waited).time_since_epoch().count());
    return text.key("message").text(message).close('}').take();
  }
  /// What the engine is told; empty: followed.
  std::string refusal(const std::string& line) {
    Actions out;
    EXPECT_TRUE(open_.on_line(7, line, now_, out)) << line;
    for (const Action& action : out) {
      const auto* command = std::get_if<Command>(&action);
      if (command == nullptr) continue;
      EXPECT_EQ(command->id.source, RequestId::Source::ros2);
      if (const auto* refused = std::get_if<JointTargetsRefused>(&command->body)) {
        was_there_ = refused->was_there;
        return std::string(refused->reason.view());
      }
      followed_ = std::get<JointTargets>(command->body);
      return "";
    }
    return "nothing for the engine";
  }
  std::string reply(Ros2Outlet& outlet, ClientId client) {
    Actions out;
    EXPECT_TRUE(outlet.on_line(client, line(kWheels), now_, out));
    return out.size() == 1 && std::holds_alternative<Reply>(out[0]) ? std::get<Reply>(out[0]).line
                                                                    : "";
  }

  static std::vector<const scene::sensor::SeenTurn*> no_turns() { return {}; }
  Time now_{100s};
  aimrt::JointCommands commands_{config()};
  Ros2Outlet open_{50, no_turns, {.joint_commands = &commands_}};
  Ros2Outlet closed_{50, no_turns};
  JointTargets followed_;
  bool was_there_ = false;  ///< who was refused last
};

TEST_F(Ros2Joints, GoToTheEngineAsThoseOfTheBroker) {
  EXPECT_EQ(refusal(line(R"({"joints":[{"name":"elbow","position":0.5,"stiffness":20}]})")), "");
  ASSERT_EQ(followed_.joints.size(), 1U);
  EXPECT_EQ(followed_.joints[0].axis, 2U);
  EXPECT_EQ(followed_.joints[0].position_rad, 0.5);
  EXPECT_EQ(followed_.joints[0].stiffness_Nmprad, 20);
}

/// Of a stream that may be slow the first message comes late.
TEST_F(Ros2Joints, AreRefusedForAsLongAsTheyMayBeApart) {
  aimrt::JointCommandsConfig slow = config();
  slow.just_came = 1s;
  aimrt::JointCommands commands(slow);
  Ros2Outlet outlet{50, no_turns, {.joint_commands = &commands}};
  Actions out;
  EXPECT_TRUE(outlet.on_line(7, kTheyFollow, now_, out));
  const auto refused = [&] {
    out.clear();
    EXPECT_TRUE(outlet.on_line(7, line(kWheels), now_, out));
    return std::any_of(out.begin(), out.end(), [](const Action& action) {
      const auto* command = std::get_if<Command>(&action);
      return command != nullptr && std::holds_alternative<JointTargetsRefused>(command->body);
    });
  };
  now_ += 999ms;
  EXPECT_TRUE(refused());
  now_ += 1ms;
  EXPECT_FALSE(refused());
}

/// A stream that was there before droverd: refused, it has to pause.
TEST_F(Ros2Joints, AreRefusedForAMomentWhenTheirProgramHasJustCome) {
  now_ += Ros2Outlet::kLease + 1ms;
  Actions out;
  EXPECT_TRUE(open_.on_line(7, kTheyFollow, now_, out));
  EXPECT_EQ(refusal(line(kWheels)),
            "droverd has only just come, and nobody's commands are followed yet");
  EXPECT_TRUE(was_there_);
  now_ += kJustCame;
  EXPECT_NE(refusal(line("no JSON")), "");
  EXPECT_FALSE(was_there_);
  EXPECT_EQ(refusal(line(kWheels)), "");
  EXPECT_TRUE(open_.on_line(7, kTheyFollow, now_, out));
  EXPECT_EQ(refusal(line(kWheels)), "") << "it was here";
  open_.on_gone(7);
  EXPECT_TRUE(open_.on_line(8, kTheyFollow, now_, out));
  EXPECT_EQ(reply(open_, 7), R"({"ok":false,"reason":"only drover-ros2 hands joint commands on"})");
}

TEST_F(Ros2Joints, AreRefusedByJointAndField) {
  EXPECT_EQ(refusal(line(R"({"joints":[{"name":"left","velocity":"NaN"}]})")),
            "joint 'left': velocity is NaN");
  EXPECT_EQ(refusal(line(R"({"joints":[{"name":"left","effort":1}]})")),
            "joint 'left': effort is 1, but this drive follows velocity only: 0");
  EXPECT_EQ(refusal(R"({"cmd":"joint_command","refused":"it names 300 joints"})"),
            "it names 300 joints");
  EXPECT_THAT(refusal(R"({"cmd":"joint_command"})"), HasSubstr("writer or at_ns is missing"));
  EXPECT_THAT(refusal(line("no JSON")), HasSubstr("no JointCommand"));
}

TEST_F(Ros2Joints, ThatWaitedAreRefused) {
  EXPECT_EQ(refusal(line(kWheels, "01.0a", 250ms)), "");
  EXPECT_EQ(refusal(line(kWheels, "01.0a", 251ms)),
            "it waited for 251 ms on this computer, 250 ms are allowed");
}

TEST_F(Ros2Joints, HaveTheirTimeStampJudgedByTheRobotsClock) {
  constexpr Duration kWall = std::chrono::hours(400'000);
  Actions out;
  (void)open_.on_snapshot({}, {now_, kWall}, out);
  const auto stamped = [&](Duration age) {
    return line(R"({"header":{"time_stamp":)" +
                std::to_string((now_.time_since_epoch() + kWall - age).count()) +
                R"(},"joints":[{"name":"left"}]})");
  };
  EXPECT_EQ(refusal(stamped(10ms)), "");
  EXPECT_EQ(refusal(stamped(10ms)), "time_stamp is not newer than the last accepted one");
  EXPECT_THAT(refusal(stamped(300ms)), HasSubstr("time_stamp is 300 ms old"));
  EXPECT_THAT(refusal(stamped(-2s)), HasSubstr("ahead of the robot's clock"));
}

TEST_F(Ros2Joints, OfTwoWritersAreToldApartByTheirGuid) {
  EXPECT_EQ(refusal(line(kWheels)), "");
  now_ += 20ms;
  EXPECT_EQ(refusal(line(kWheels, "01.0b")),
            "two programs write joint commands: 01.0a has the joints, 01.0b is refused");
  EXPECT_THAT(std::string(commands_.rivals(now_)), HasSubstr("01.0b is refused"));
  EXPECT_EQ(refusal(line(kWheels)), "");
  EXPECT_EQ(refusal(line(R"({"joints":[{"name":"elbow"}]})", "01.0b")), "")
      << "the arm has an owner of its own";
  now_ += 101ms;
  EXPECT_EQ(refusal(line(kWheels, "01.0b")), "") << "the first is silent";
}

TEST_F(Ros2Joints, OfTwoWritersWhoNameOtherJointsOfAnArmHaveOneOwner) {
  const char* const elbow = R"({"joints":[{"name":"elbow"}]})";
  const char* const wrist = R"({"joints":[{"name":"wrist"}]})";
  for (int i = 0; i < 20; ++i, now_ += 20ms) {
    EXPECT_EQ(refusal(line(elbow)), "");
    EXPECT_EQ(refusal(line(wrist, "01.0b")),
              "two programs write joint commands: 01.0a has the joints, 01.0b is refused");
    EXPECT_EQ(refusal(line(wrist)), "") << "who has the arm may name its joints in turn";
  }
}

TEST_F(Ros2Joints, OfOneWriterMayJumpAsTheyLike) {
  for (int i = 0; i < 50; ++i, now_ += 10ms)
    EXPECT_EQ(refusal(line(i % 2 == 0 ? kWheels : R"({"joints":[{"name":"left","velocity":3}]})")),
              "");
}

TEST_F(Ros2Joints, AndTheBrokersHaveOneOwner) {
  aimrt::JointCommandHeard of_broker{{}, {}};
  of_broker.message.joints.push_back({.name = "left"});
  Actions out;
  commands_.take(
      RequestId::Source::aimrt, [&] { return of_broker; }, now_, 0s, out);
  EXPECT_THAT(refusal(line(kWheels)), HasSubstr("JointCommand (pb) has the joints"));
}

TEST_F(Ros2Joints, AreTakenOfDroverRos2OnlyAndWhereTheConfigurationOpensThem) {
  EXPECT_THAT(reply(closed_, 7), HasSubstr("ros2.inputs.joint_command"));
  EXPECT_THAT(reply(open_, 8), HasSubstr("only drover-ros2"));
  now_ += 4s;
  EXPECT_THAT(reply(open_, 7), HasSubstr("only drover-ros2"))
      << "it has not said for so long that it is there";
}

TEST_F(Ros2Joints, OfAFloodAreBoundedBeforeTheyReachTheEngine) {
  std::size_t told = 0;
  for (int i = 0; i < 1000; ++i) {
    Actions out;
    EXPECT_TRUE(open_.on_line(7, line(kWheels), now_, out));
    for (const Action& action : out) told += std::holds_alternative<Command>(action) ? 1 : 0;
  }
  EXPECT_LE(told, 51U);
  EXPECT_GT(commands_.unread(), 900U);
}

/// A good stream by one way for two seconds, a hundred a second, and a flood by the other.
class JointFlood : public Ros2Joints {
 protected:
  using Source = RequestId::Source;

  void write(Source source) {
    if (source == Source::ros2) {
      EXPECT_TRUE(open_.on_line(7, line(kWheels), now_, actions_));
    } else {
      aimrt::JointCommandHeard heard{{}, {}};
      heard.message.joints.push_back({.name = "left"});
      commands_.take(
          source, [&] { return heard; }, now_, 0s, actions_);
    }
  }
  void stream_beside_flood(Source good, Source flood) {
    for (int i = 0; i < 20'000; ++i, now_ += 100us) {
      if (i % 100 == 0) write(good);
      write(flood);
      take_actions();
    }
  }
  void take_actions() {
    for (const Action& action : actions_) {
      if (const auto* command = std::get_if<Command>(&action)) {
        ++(std::holds_alternative<JointTargets>(command->body) ? followed
                                                               : refused)[command->id.source];
      }
    }
    actions_.clear();
  }
  /// What of a message that is no command gets into the journal.
  bool is_told(Source source) {
    if (source == Source::ros2) {
      EXPECT_TRUE(open_.on_line(7, line("no JSON"), now_, actions_));
    } else {
      commands_.take(
          source, [] { return JointTargetsRefused{"no packet"}; }, now_, 0s, actions_);
    }
    return std::any_of(actions_.begin(), actions_.end(), [](const Action& action) {
      return std::holds_alternative<LogLine>(action);
    });
  }

  Actions actions_;
  std::map<Source, int> followed, refused;
};

TEST_F(JointFlood, ByRos2TakesNothingOfTheBrokers) {
  stream_beside_flood(Source::aimrt, Source::ros2);
  EXPECT_EQ(followed[Source::aimrt], 200);
  EXPECT_EQ(refused[Source::aimrt], 0);
  EXPECT_EQ(followed[Source::ros2], 0) << "the first one has the joints";
  EXPECT_GT(commands_.unread(), 19'000U);
  EXPECT_TRUE(is_told(Source::aimrt));
}

TEST_F(JointFlood, ByTheBrokerTakesNothingOfRos2s) {
  stream_beside_flood(Source::ros2, Source::aimrt);
  EXPECT_EQ(followed[Source::ros2], 200);
  EXPECT_EQ(refused[Source::ros2], 0);
  EXPECT_EQ(followed[Source::aimrt], 0) << "the first one has the joints";
  EXPECT_GT(commands_.unread(), 19'000U);
  EXPECT_TRUE(is_told(Source::ros2));
}

TEST_F(JointFlood, ByBothWaysIsToldOfEach) {
  for (int i = 0; i < 10'000; ++i, now_ += 100us) {
    write(Source::ros2);
    write(Source::aimrt);
  }
  std::map<Source, int> told;
  for (const Action& action : actions_) {
    const auto* command = std::get_if<Command>(&action);
    const auto* body =
        command == nullptr ? nullptr : std::get_if<JointTargetsRefused>(&command->body);
    if (body != nullptr &&
        body->reason.view() == "slow down: 250 messages a second are taken, and 50 at once")
      ++told[command->id.source];
  }
  EXPECT_THAT(told, testing::UnorderedElementsAre(testing::Pair(Source::ros2, testing::Ge(1)),
                                                  testing::Pair(Source::aimrt, testing::Ge(1))));
}

}  // namespace
}  // namespace drover::publish
