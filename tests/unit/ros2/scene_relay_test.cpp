// What becomes of the planning scene's lines when the way to droverd breaks.
#include "ros2/scene_relay.h"

#include <gtest/gtest.h>

namespace drover::ros2 {
namespace {

constexpr Time kNow{std::chrono::seconds(100)};
constexpr const char* kDone = R"({"scene_feedback":{"topic":"collision_object","result":"done"}})";

TEST(SceneRelay, CountsWhatWasNotAnsweredWhenTheWayIsLost) {
  SceneRelay relay;
  for (const char* line : {"a", "b", "c"}) relay.give(line);
  std::string sent;
  const auto send = [&sent](const std::string& line) {
    sent += line;
    return true;
  };
  relay.send(send);
  relay.send(send);
  EXPECT_EQ(sent, "ab");
  EXPECT_TRUE(relay.answered(kDone, kNow));
  EXPECT_EQ(relay.lost(), 0U);
  relay.way_lost();
  relay.way_lost();
  EXPECT_EQ(relay.lost(), 1U) << "b was under way, c waits";
  EXPECT_TRUE(relay.waits());
  relay.send(send);
  EXPECT_EQ(sent, "abc");
}

TEST(SceneRelay, CountsWhatTheWayDidNotTake) {
  SceneRelay relay;
  relay.give("a");
  relay.send([](const std::string&) { return false; });
  EXPECT_EQ(relay.lost(), 1U);
  EXPECT_FALSE(relay.waits());
}

TEST(SceneRelay, CountsWhatWasPassedOverOnce) {
  SceneRelay relay;
  relay.beat(3);
  relay.beat(3);
  EXPECT_EQ(relay.lost(), 3U);
  relay.beat(8);
  EXPECT_EQ(relay.lost(), 8U);
}

}  // namespace
}  // namespace drover::ros2
