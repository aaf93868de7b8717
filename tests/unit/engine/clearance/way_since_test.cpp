#include "engine/clearance/way_since.h"

#include <gtest/gtest.h>

#include <cmath>

#include "engine/clearance/stop_chain.h"

namespace drover::engine {
namespace {

using namespace std::chrono_literals;

TEST(StopChain, PermitsTheSpeedThatCanStopOnTheWay) {
  const StopChain chain{0.28, 0.8};
  for (const double speed_mps : {0.05, 0.2, 0.5, 0.8, 1.5}) {
    const double way_m = stop_way(speed_mps, chain);
    EXPECT_NEAR(permitted_speed(way_m, chain), speed_mps, 1e-9);
  }
  EXPECT_NEAR(stop_way(0.8, chain), 0.62, 0.01);
}

TEST(StopChain, PermitsNothingWithoutAWay) {
  const StopChain chain{0.28, 0.8};
  for (const double way_m : {0.0, -1.0, double{NAN}}) EXPECT_EQ(permitted_speed(way_m, chain), 0);
}

TEST(WayMemory, CountsFromTheEarlierOfTwoMarks) {
  WayMemory ways;
  BodyMotion body{.twist = {-0.5, 0.2}, .known = true};
  Time now{10s};
  for (int i = 0; i <= 60; ++i, now += 5ms) ways.note(body, now);
  const WaySince since = ways.since(now - 5ms - 103ms);
  ASSERT_TRUE(since.known);
  EXPECT_NEAR(since.driven_m, 0.5 * 0.11, 1e-9);
  EXPECT_NEAR(since.turned_rad, 0.2 * 0.11, 1e-9);
}

TEST(WayMemory, KnowsNothingOfWhatItDidNotSee) {
  WayMemory ways;
  BodyMotion body{.twist = {0.5, 0}, .known = true};
  Time now{10s};
  EXPECT_FALSE(ways.since(now).known);
  for (int i = 0; i < 200; ++i, now += 5ms) ways.note(body, now);
  EXPECT_FALSE(ways.since(now - 900ms).known) << "too long ago";
  EXPECT_TRUE(ways.since(now - 300ms).known);
  body.known = false;  // a silent wheel
  ways.note(body, now);
  EXPECT_FALSE(ways.since(now - 100ms).known);
}

}  // namespace
}  // namespace drover::engine
