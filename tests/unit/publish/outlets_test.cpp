#include <gmock/gmock.h>
#include <algorithm>

#include "json/located_json.h"
#include "publish/aimrt_outlet.h"
#include "publish/cli_outlet.h"
#include "publish/rtk_outlet.h"

namespace drover::publish {
namespace {

using namespace std::chrono_literals;
using testing::IsEmpty;

constexpr Moment kMoment{Time{100s}, 400'000h};

Snapshot standing() {
  Snapshot s;
  s.time = kMoment.now;
  AxisSnapshot axis;
  axis.joint = "left";
  axis.last_motion = kMoment.now;
  EXPECT_TRUE(s.axes.push_back(axis));
  return s;
}

class Outlets : public testing::Test {
 protected:
  static aimrt::JointCommandsConfig commands_config() {
    aimrt::JointCommandsConfig config;
    config.rules.joints = {"left"};
    return config;
  }
  CommandService service_{{}, {}};
  RtkOutlet rtk_{{}, service_};
  aimrt::JointCommands commands_{commands_config()};
  AimrtOutlet aimrt_{{}, commands_, 50, true};
  CliOutlet cli_{service_, [](Time) { return std::string(R"({"robot":"field"})"); }};
  Actions actions_;

  /// What a client of the command line is told at once; empty: nothing yet.
  std::string reply_to(std::string_view line) {
    actions_.clear();
    EXPECT_TRUE(cli_.on_line(7, line, kMoment.now, actions_));
    for (const Action& action : actions_)
      if (const auto* reply = std::get_if<Reply>(&action)) return reply->line;
    return {};
  }
};

TEST_F(Outlets, WantTheirOwnTopicsOnly) {
  ASSERT_EQ(rtk_.wants().size(), 1U);
  EXPECT_EQ(rtk_.wants()[0].name, "mqtt_control");
  EXPECT_EQ(rtk_.wants()[0].qos, 1);
  ASSERT_FALSE(aimrt_.wants().empty());
  for (const auto& topic : aimrt_.wants()) {
    EXPECT_EQ(topic.qos, 0) << "what did not arrive is not worth sending twice";
    EXPECT_FALSE(rtk_.on_message(topic.name, "{}", {}, kMoment.now, actions_));
    EXPECT_TRUE(aimrt_.on_message(topic.name, "{}", {}, kMoment.now, actions_));
  }
  EXPECT_FALSE(aimrt_.on_message("mqtt_control", "{}", {}, kMoment.now, actions_));
}

TEST_F(Outlets, OfAimrtHearNothingWhereJointCommandsAreSwitchedOff) {
  EXPECT_THAT(AimrtOutlet({}, commands_, 50, false).wants(), IsEmpty());
}

TEST_F(Outlets, HaveRatesOfTheirOwn) {
  EXPECT_EQ(rtk_.period(), 100ms);
  EXPECT_EQ(aimrt_.period(), 20ms);
  EXPECT_FALSE(rtk_.needs_broker()) << "the command line's requests look at the robot, too";
  EXPECT_TRUE(aimrt_.needs_broker());
  EXPECT_EQ(cli_.period(), 0ms) << "it is asked";
}

TEST_F(Outlets, TellTheRobotsStateOnTheirTopics) {
  const auto told = rtk_.on_snapshot(standing(), kMoment, actions_);
  ASSERT_EQ(told.size(), 1U);
  EXPECT_STREQ(told[0].topic, "base_status");
  EXPECT_TRUE(json::parse(told[0].payload).ok());
  const auto joints = aimrt_.on_snapshot(standing(), kMoment, actions_);
  ASSERT_EQ(joints.size(), 1U);
  EXPECT_EQ(std::string(joints[0].topic).rfind("/channel/%2Fjoint_state/", 0), 0U);
  EXPECT_THAT(aimrt_.on_snapshot(standing(), kMoment, actions_), IsEmpty())
      << "one message for a control cycle";
}

TEST_F(Outlets, OfTheCommandLineAnswerQuestionsAtOnce) {
  EXPECT_EQ(reply_to(R"({"cmd":"status"})"), R"({"ok":true,"status":{"robot":"field"}})");
  EXPECT_EQ(reply_to(R"({"cmd":"traj_list"})"), R"({"ok":true,"tracks":[]})");
  EXPECT_THAT(reply_to(R"({"cmd":"traj_show","name":"a"})"), testing::HasSubstr("no track named"));
  EXPECT_THAT(reply_to(R"({"cmd":"dance"})"), testing::HasSubstr("unknown request \\\"dance"));
  EXPECT_THAT(reply_to("{}"), testing::HasSubstr("'cmd' is missing"));
  EXPECT_THAT(reply_to("[]"), testing::HasSubstr("a request is an object like"));
  EXPECT_THAT(reply_to("[]"), testing::HasSubstr("not a list"));
  EXPECT_THAT(reply_to(R"({"cmd":5})"), testing::HasSubstr("'cmd' must be a text, not an integer"));
  EXPECT_THAT(reply_to("{"), testing::HasSubstr("not understood"));
  EXPECT_THAT(reply_to(R"({"cmd":"task_start","name":"a","id":1})"),
              testing::HasSubstr("speed is missing"));
}

/// drover-ros2 has other answers on the same line.
TEST_F(Outlets, OfTheCommandLineNameAStopThatWasNotDone) {
  EXPECT_EQ(reply_to(R"({"cmd":"stop"})"), "");
  Actions out;
  for (const Action& action : actions_)
    if (const auto* stop = std::get_if<Command>(&action)) {
      EXPECT_TRUE(cli_.on_answer({stop->id, false, "no answer"}, out));
    }
  ASSERT_EQ(out.size(), 1U);
  EXPECT_EQ(std::get<Reply>(out.front()).line, R"({"ok":false,"cmd":"stop","reason":"no answer"})");
}

/// drover-ros2 tells it again on a new connection, when the answer was lost with the old one.
TEST_F(Outlets, OfTheCommandLineDoAStopOnceHoweverOftenItIsTold) {
  constexpr auto kFirst = R"({"cmd":"stop","from":"1-2","number":1})";
  const auto asked = [this] {
    std::vector<RequestId> stops;
    for (const Action& action : actions_)
      if (const auto* stop = std::get_if<Command>(&action)) stops.push_back(stop->id);
    return stops;
  };
  const auto answer = [this](RequestId id, bool ok) {
    Actions out;
    EXPECT_TRUE(cli_.on_answer({id, ok, ok ? "" : "no answer"}, out));
    return out.empty() ? Reply{} : std::get<Reply>(out.front());
  };
  EXPECT_EQ(reply_to(kFirst), "");
  const auto first = asked();
  ASSERT_EQ(first.size(), 1U);
  actions_.clear();
  EXPECT_TRUE(cli_.on_line(8, kFirst, kMoment.now, actions_));
  EXPECT_THAT(actions_, IsEmpty()) << "it is not done yet";
  EXPECT_EQ(answer(first[0], true).client, 8U) << "who told it last hears of it";
  EXPECT_THAT(reply_to(kFirst), testing::HasSubstr(R"("ok":true)"));
  EXPECT_THAT(asked(), IsEmpty()) << "a person may have reset it";

  EXPECT_EQ(reply_to(R"({"cmd":"stop","from":"1-2","number":2})"), "") << "another one";
  ASSERT_EQ(asked().size(), 1U);
  EXPECT_THAT(answer(asked()[0], false).line, testing::HasSubstr("no answer"));
  EXPECT_EQ(reply_to(R"({"cmd":"stop","from":"1-2","number":2})"), "") << "it was refused";
  EXPECT_EQ(asked().size(), 1U);
  EXPECT_TRUE(answer(asked()[0], true).line.starts_with(R"({"ok":true)"));
  EXPECT_EQ(reply_to(R"({"cmd":"stop","from":"3-4","number":2})"), "") << "another program's";
  EXPECT_EQ(asked().size(), 1U);
  for (int i = 0; i < 2; ++i) {
    EXPECT_EQ(reply_to(R"({"cmd":"stop"})"), "");
    EXPECT_EQ(asked().size(), 1U) << "a person's is done each time";
  }
}

TEST(LinesOfTheCommandLine, ThatStopAreKnown) {
  EXPECT_TRUE(is_stop_line(R"({"cmd":"stop"})"));
  EXPECT_TRUE(is_stop_line(R"({"cmd": "stop", "from":"1-2","number":1})"));
  EXPECT_TRUE(is_stop_line(R"({"cmd":"task_cancel"})"));
  for (const auto* other :
       {R"({"cmd":"reset"})", R"({"cmd":"traj_show","name":"stop"})", R"("stop")", R"(["stop"])",
        R"({"cmd":"status"})", R"({"cmd":"traj_show","name":"task_cancel"})", "{\"stop\"", ""})
    EXPECT_FALSE(is_stop_line(other)) << other;
}

TEST_F(Outlets, OfTheCommandLineTellTheClientWhatBecameOfItsRequest) {
  EXPECT_EQ(reply_to(R"({"cmd":"task_cancel"})"), "") << "the engine has not decided yet";
  const Command* command = nullptr;
  for (const Action& action : actions_)
    if (const auto* it = std::get_if<Command>(&action)) command = it;
  ASSERT_NE(command, nullptr);
  Actions out;
  const Answer answer{command->id, false, "no task is under way"};
  EXPECT_TRUE(cli_.on_answer(answer, out));
  ASSERT_EQ(out.size(), 1U);
  const auto* reply = std::get_if<Reply>(out.data());
  ASSERT_NE(reply, nullptr);
  EXPECT_EQ(reply->client, 7U);
  EXPECT_EQ(reply->line, R"({"ok":false,"reason":"no task is under way"})");
  EXPECT_FALSE(cli_.on_answer(answer, out)) << "once";
  EXPECT_FALSE(rtk_.on_line(7, R"({"cmd":"status"})", kMoment.now, out));
}

TEST_F(Outlets, OfTheCommandLineTakeAPersonsWordForThePosition) {
  EXPECT_EQ(reply_to(R"({"cmd":"position_accept"})"), "");
  const auto accepts = [](const Action& action) {
    const auto* command = std::get_if<Command>(&action);
    return command != nullptr && std::holds_alternative<AcceptPosition>(command->body);
  };
  EXPECT_EQ(std::count_if(actions_.begin(), actions_.end(), accepts), 1);
}

TEST_F(Outlets, OfTheCommandLineTakeAPersonsWordThatWhatWasLearnedIsForgotten) {
  EXPECT_EQ(reply_to(R"({"cmd":"learned_forget"})"), "");
  const auto forgets = [](const Action& action) {
    const auto* command = std::get_if<Command>(&action);
    return command != nullptr && std::holds_alternative<ForgetLearned>(command->body);
  };
  EXPECT_EQ(std::count_if(actions_.begin(), actions_.end(), forgets), 1);
}

TEST_F(Outlets, CountWhatTheyDoNotLookAt) {
  const auto topic = aimrt_.wants().front().name;
  for (int i = 0; i < 80; ++i) (void)aimrt_.on_message(topic, "x", {}, kMoment.now, actions_);
  EXPECT_GT(commands_.unread(), 20U) << "of a flood most are not looked at";
  EXPECT_TRUE(commands_.rivals(kMoment.now).empty());
}

}  // namespace
}  // namespace drover::publish
