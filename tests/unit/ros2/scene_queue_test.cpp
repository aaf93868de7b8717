// What waits of the planning scene is bounded in bytes, and nothing of it vanishes without a count.
#include "ros2/scene_queue.h"

#include <gtest/gtest.h>

namespace drover::ros2 {
namespace {

class TheSceneQueue : public ::testing::Test {
 protected:
  void put(std::int64_t said_ns, std::size_t bytes) {
    queue->put(nullptr, Duration{said_ns}, bytes);
  }
  std::int64_t next_ns() {
    const auto waiting = queue->pop();
    return waiting ? waiting->said.count() : -1;
  }
  std::atomic<std::uint64_t> lost{0};
  std::optional<SceneQueue> queue{std::in_place, lost};
};

TEST_F(TheSceneQueue, GivesInTheirOrder) {
  for (int i = 0; i < 3; ++i) put(i, 100);
  for (int i = 0; i < 3; ++i) EXPECT_EQ(next_ns(), i);
  EXPECT_EQ(next_ns(), -1);
}

TEST_F(TheSceneQueue, CountsWhatFindsNoRoomAndHasRoomAgain) {
  constexpr std::size_t kLarge = 60'000;
  constexpr auto kMost = SceneQueue::kMostBytes / (kLarge + SceneQueue::kBytesBeside);
  for (std::size_t i = 0; i < kMost + 5; ++i) put(static_cast<std::int64_t>(i), kLarge);
  EXPECT_EQ(lost, 5U);
  put(1000, 100);
  EXPECT_EQ(lost, 5U) << "a short one still fits";
  EXPECT_EQ(next_ns(), 0);
  put(1001, kLarge);
  EXPECT_EQ(lost, 5U);
  put(1002, kLarge);
  EXPECT_EQ(lost, 6U);
}

TEST_F(TheSceneQueue, IsBoundedForEmptyMessagesToo) {
  for (std::size_t i = 0; i < SceneQueue::kMost + 5; ++i) put(0, 0);
  EXPECT_EQ(lost, 5U);
  for (std::size_t i = 0; i < SceneQueue::kMost; ++i) ASSERT_EQ(next_ns(), 0);
  EXPECT_EQ(next_ns(), -1);
}

TEST_F(TheSceneQueue, CountsWhatStillWaitsWhenItsDomainEnds) {
  for (int i = 0; i < 3; ++i) put(i, 100);
  (void)next_ns();
  queue.reset();
  EXPECT_EQ(lost, 2U);
}

}  // namespace
}  // namespace drover::ros2
