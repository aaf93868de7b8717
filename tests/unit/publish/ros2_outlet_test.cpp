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
  EXPECT_EQ(status(kNow).ros2.readers, 3);
  EXPECT_EQ(status(kNow).ros2.incompatible, 1);
  EXPECT_FALSE(status(kNow + 4s).ros2.connected);
}

}  // namespace
}  // namespace drover::publish
