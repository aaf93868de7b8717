// Who is told of the robot for ROS 2, and for how long.
#include "publish/ros2_outlet.h"

#include <gmock/gmock.h>

#include "json/located_json.h"

namespace drover::publish {
namespace {

using namespace std::chrono_literals;
using testing::HasSubstr;
using testing::IsEmpty;

constexpr Time kNow{100s};
constexpr const char* kFollow =
    R"({"cmd":"ros2_follow","mode":"localhost","reason":"","readers":3,"incompatible":1})";

class Ros2 : public testing::Test {
 protected:
  /// What that client is told at once; empty: nothing.
  std::string ask(ClientId client, Time now, std::string_view line = kFollow) {
    Actions out;
    EXPECT_TRUE(outlet_.on_line(client, line, now, out));
    return out.empty() ? "" : std::get<Reply>(out.at(0)).line;
  }
  /// Who is told of the robot now, and what.
  std::vector<Reply> told(Time now) {
    Snapshot seen;
    seen.time = now;
    Actions out;
    EXPECT_THAT(outlet_.on_snapshot(seen, {now, 0s}, out), IsEmpty()) << "nothing for the broker";
    std::vector<Reply> replies;
    for (const Action& action : out) replies.push_back(std::get<Reply>(action));
    return replies;
  }
  DaemonStatus status(Time now) const {
    DaemonStatus status;
    status.now = now;
    outlet_.count(status);
    return status;
  }

  Ros2Outlet outlet_{50, [] { return std::vector<const scene::sensor::SeenTurn*>(); }};
};

TEST_F(Ros2, HasItsOwnRateAndNeedsNoBroker) {
  EXPECT_EQ(outlet_.period(), 20ms);
  EXPECT_FALSE(outlet_.needs_broker());
}

TEST_F(Ros2, TellsNobodyWhoHasNotAsked) {
  EXPECT_THAT(told(kNow), IsEmpty());
  Actions out;
  EXPECT_FALSE(outlet_.on_line(7, R"({"cmd":"status"})", kNow, out));
  EXPECT_FALSE(outlet_.on_line(7, R"({"cmd":"traj_show","name":"ros2_follow"})", kNow, out));
  EXPECT_THAT(out, IsEmpty());
}

TEST_F(Ros2, TellsWhoFollowsALineEachTime) {
  EXPECT_EQ(ask(7, kNow), "");
  const auto replies = told(kNow);
  ASSERT_EQ(replies.size(), 1U);
  EXPECT_EQ(replies[0].client, 7U);
  const auto line = json::parse(replies[0].line);
  ASSERT_TRUE(line.ok()) << replies[0].line;
  EXPECT_NE(line->root.find("diagnostics"), nullptr);
}

TEST_F(Ros2, TellsNothingMoreToWhoIsSilent) {
  EXPECT_EQ(ask(7, kNow), "");
  EXPECT_EQ(told(kNow + 3s).size(), 1U);
  EXPECT_THAT(told(kNow + 3s + 1ns), IsEmpty()) << "it hangs, or is gone";
}

TEST_F(Ros2, TellsOneAtATime) {
  EXPECT_EQ(ask(7, kNow), "");
  EXPECT_THAT(ask(8, kNow + 1s), HasSubstr("another drover-ros2"));
  EXPECT_EQ(told(kNow + 1s).at(0).client, 7U);
  EXPECT_EQ(ask(8, kNow + 4s), "") << "the first is gone";
  EXPECT_THAT(told(kNow + 4s).at(0).line, HasSubstr("diagnostics")) << "all of it anew";
}

/// It may be the same program, whose line broke.
TEST_F(Ros2, TellsTheNextOneAtOnceWhenTheFirstIsGone) {
  EXPECT_EQ(ask(7, kNow), "");
  outlet_.on_gone(8);
  EXPECT_TRUE(status(kNow).ros2.connected);
  outlet_.on_gone(7);
  EXPECT_FALSE(status(kNow).ros2.connected);
  EXPECT_THAT(told(kNow), IsEmpty());
  EXPECT_EQ(ask(8, kNow + 10ms), "");
  EXPECT_EQ(told(kNow + 10ms).at(0).client, 8U);
  outlet_.on_gone(7);
  EXPECT_TRUE(status(kNow + 10ms).ros2.connected);
}

TEST_F(Ros2, TellsWhoAsksTooOftenToSlowDown) {
  for (int i = 0; i < 20; ++i) EXPECT_EQ(ask(7, kNow), "");
  EXPECT_THAT(ask(7, kNow), HasSubstr("slow down"));
}

TEST_F(Ros2, ShowsInTheStatusWhatTheProgramSays) {
  EXPECT_TRUE(status(kNow).ros2.configured);
  EXPECT_FALSE(status(kNow).ros2.connected);
  EXPECT_EQ(ask(7, kNow), "");
  EXPECT_TRUE(status(kNow).ros2.connected);
  EXPECT_EQ(status(kNow).ros2.mode, "localhost");
  EXPECT_EQ(status(kNow).ros2.network, "");
  EXPECT_EQ(status(kNow).ros2.readers, 3);
  EXPECT_EQ(status(kNow).ros2.incompatible, 1);
  EXPECT_FALSE(status(kNow + 4s).ros2.connected);
}

TEST_F(Ros2, ShowsInTheStatusWhichNetworkIsUsed) {
  Actions out;
  (void)outlet_.on_line(
      7,
      R"({"cmd":"ros2_follow","mode":"network","network":"one 10.9.1.1","unused":"two 10.9.2.1"})",
      kNow, out);
  EXPECT_EQ(status(kNow).ros2.network, "one 10.9.1.1");
  EXPECT_EQ(status(kNow).ros2.unused, "two 10.9.2.1");
}

class Ros2Twists : public Ros2 {
 protected:
  Ros2Twists() { EXPECT_EQ(ask(7, kNow), ""); }
  static std::string line(const std::string& at_ns = "99900000000") {
    return R"({"cmd":"cmd_vel","vx_mps":0.3,"wz_radps":-0.1,"at_ns":)" + at_ns + "}";
  }
  std::vector<Command> given(std::string_view line, ClientId client = 7, Time now = kNow) {
    Actions out;
    EXPECT_TRUE(open_.on_line(client, line, now, out)) << line;
    std::vector<Command> commands;
    for (const Action& action : out)
      if (const auto* command = std::get_if<Command>(&action)) commands.push_back(*command);
    return commands;
  }
  std::string refusal(std::string_view line, ClientId client = 7) {
    Actions out;
    EXPECT_TRUE(open_.on_line(client, line, kNow, out)) << line;
    return out.size() == 1 && std::holds_alternative<Reply>(out[0]) ? std::get<Reply>(out[0]).line
                                                                    : "";
  }
  void SetUp() override {
    Actions out;
    EXPECT_TRUE(open_.on_line(7, kFollow, kNow, out));
  }
  Ros2Outlet open_{
      50, [] { return std::vector<const scene::sensor::SeenTurn*>(); }, {.cmd_vel = true}};
};

TEST_F(Ros2Twists, GoToTheEngineWithTheInstantAtWhichTheyCame) {
  const auto commands = given(line());
  ASSERT_EQ(commands.size(), 1U);
  EXPECT_EQ(commands[0].received, kNow - 100ms);
  EXPECT_EQ(commands[0].id.source, RequestId::Source::ros2);
  const auto& twist = std::get<FollowTwist>(commands[0].body).twist;
  EXPECT_EQ(twist.vx_mps, 0.3);
  EXPECT_EQ(twist.wz_radps, -0.1);
  EXPECT_EQ(given(line("200000000000")).at(0).received, kNow) << "none is of tomorrow";
}

TEST_F(Ros2Twists, ToTheSideAreForABaseThatCan) {
  constexpr auto kAside =
      R"({"cmd":"cmd_vel","vx_mps":0,"wz_radps":0,"vy_mps":0.3,"at_ns":99900000000})";
  const auto refused = given(kAside);
  ASSERT_EQ(refused.size(), 1U);
  EXPECT_EQ(std::get<TwistRefused>(refused[0].body).reason.view(),
            "linear.y is 0.3: this base cannot go sideways");
  Ros2Outlet can{50,
                 [] { return std::vector<const scene::sensor::SeenTurn*>(); },
                 {.cmd_vel = true, .sideways = true}};
  Actions out;
  EXPECT_TRUE(can.on_line(7, kFollow, kNow, out));
  out.clear();
  EXPECT_TRUE(can.on_line(7, kAside, kNow, out));
  ASSERT_EQ(out.size(), 1U);
  const auto& command = std::get<Command>(out[0]);
  EXPECT_EQ(std::get<FollowTwist>(command.body).twist.vy_mps, 0.3);
}

TEST_F(Ros2Twists, ThatWereRefusedAreToldWithTheirReason) {
  const auto commands = given(R"({"cmd":"cmd_vel","refused":"linear.y is 0.3"})");
  ASSERT_EQ(commands.size(), 1U);
  EXPECT_EQ(std::get<TwistRefused>(commands[0].body).reason.view(), "linear.y is 0.3");
}

TEST_F(Ros2Twists, CarryWhetherMotionWasBeforeThemAndWhetherARefusalEndsThem) {
  const auto said =
      given(R"({"cmd":"cmd_vel","vx_mps":0,"wz_radps":0,"after_motion":true,"at_ns":99900000000})");
  ASSERT_EQ(said.size(), 1U);
  EXPECT_TRUE(std::get<FollowTwist>(said[0].body).after_motion);
  EXPECT_FALSE(std::get<FollowTwist>(given(line()).at(0).body).after_motion);
  const auto refused = given(R"({"cmd":"cmd_vel","refused":"two programs","ends":true})");
  ASSERT_EQ(refused.size(), 1U);
  EXPECT_TRUE(std::get<TwistRefused>(refused[0].body).ends);
}

TEST_F(Ros2Twists, AreRefusedWhereTheConfigurationDoesNotOpenThem) {
  EXPECT_THAT(ask(7, kNow, line()), HasSubstr("ros2.inputs.cmd_vel"));
}

TEST_F(Ros2Twists, AreTakenOfDroverRos2Only) {
  EXPECT_THAT(refusal(line(), 8), HasSubstr("only drover-ros2"));
  EXPECT_EQ(given(line(), 7, kNow + 3s).size(), 1U);
  EXPECT_EQ(given(line(), 7, kNow + 4s).size(), 0U)
      << "it has not said for so long that it is there";
}

TEST_F(Ros2Twists, ThatAreNotWholeMoveNothing) {
  for (const auto* bad : {R"({"cmd":"cmd_vel"})", R"({"cmd":"cmd_vel","vx_mps":0.3,"wz_radps":0})",
                          R"({"cmd":"cmd_vel","vx_mps":"0.3","wz_radps":0,"at_ns":1})",
                          R"({"cmd":"cmd_vel","vx_mps":0.3,"at_ns":1})",
                          R"({"cmd":"cmd_vel","vx_mps":0.3,"wz_radps":0,"at_ns":-1})"})
    EXPECT_THAT(refusal(bad), HasSubstr("is missing")) << bad;
}

TEST_F(Ros2Twists, OfAFloodAreBoundedBeforeTheyReachTheEngine) {
  std::size_t commands = 0;
  std::size_t told = 0;
  for (int i = 0; i < 10000; ++i)  // ten seconds of a thousand a second
    for (const auto& command : given(line(), 7, kNow + i * 200us)) {
      ++commands;
      told += std::holds_alternative<TwistRefused>(command.body) ? 1 : 0;
    }
  EXPECT_LE(commands, 50U + 2 * 150 + 3);
  EXPECT_LE(told, 3U);
  EXPECT_GE(told, 1U);
}

}  // namespace
}  // namespace drover::publish
