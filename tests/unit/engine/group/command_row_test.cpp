// A row of commands to one joint: when it is one, and when whoever sends it has paused.
#include "engine/group/command_row.h"

#include <gtest/gtest.h>

namespace drover::engine {
namespace {

using namespace std::chrono_literals;

constexpr Time kBegin = Time{} + 100s;

/// One command each 10 ms, the first at `begin`; when the last came.
Time send(CommandRow& row, Time begin, Duration lasting) {
  Time now = begin;
  for (; now + 10ms <= begin + lasting; now += 10ms) row.take({}, now);
  row.take({}, now);
  return now;
}

TEST(CommandRow, IsNoneBeforeAnythingWasSent) {
  CommandRow row(100ms);
  row.stop();
  EXPECT_FALSE(row.must_pause()) << "nobody is there who did not know";
  EXPECT_FALSE(row.goes_on(kBegin));
  EXPECT_FALSE(row.is_over(kBegin));
}

TEST(CommandRow, IsSteadyAfterATimeWithoutAGap) {
  CommandRow row(100ms);
  const Time early = send(row, kBegin, 290ms);
  EXPECT_FALSE(row.is_steady(early));
  row.take({}, early + 10ms);
  EXPECT_TRUE(row.is_steady(early + 10ms));
  EXPECT_FALSE(row.is_steady(early + 111ms)) << "it has ceased";
}

TEST(CommandRow, IsSteadyNoSoonerThanItsTimeOut) {
  CommandRow row(500ms);
  row.take({}, kBegin);
  row.take({}, kBegin + 400ms);
  EXPECT_FALSE(row.is_steady(kBegin + 400ms));
  row.take({}, kBegin + 500ms);
  EXPECT_TRUE(row.is_steady(kBegin + 500ms));
}

TEST(CommandRow, TellsTheGapThatMadeItBeginAnew) {
  CommandRow row(100ms);
  const Time last = send(row, kBegin, 200ms);
  EXPECT_EQ(row.gap(), Duration{});
  row.take({}, last + 150ms);
  EXPECT_EQ(row.gap(), Duration(150ms));
  EXPECT_FALSE(row.is_steady(last + 150ms));
  row.take({}, last + 1150ms);
  EXPECT_EQ(row.gap(), Duration{}) << "a second is a pause, and no gap";
}

TEST(CommandRow, TellsNoGapBehindARowThatWasSteadyNorBeforeAnothersFirst) {
  CommandRow row(100ms);
  const Time steady = send(row, kBegin, 400ms);
  row.take({}, steady + 150ms);
  EXPECT_EQ(row.gap(), Duration{}) << "it paused: that is not its pace";
  row.take({}, steady + 300ms);
  EXPECT_EQ(row.gap(), Duration(150ms));
  row.change_hands();
  EXPECT_EQ(row.gap(), Duration{});
  row.take({}, steady + 450ms);
  EXPECT_EQ(row.gap(), Duration{}) << "the other's silence";
  row.take({}, steady + 600ms);
  EXPECT_EQ(row.gap(), Duration(150ms));
}

TEST(CommandRow, ThatWasStoppedIsFollowedAfterAPauseAlone) {
  CommandRow row(100ms);
  const Time last = send(row, kBegin, 400ms);
  row.stop();
  row.take({}, last + 990ms);
  EXPECT_TRUE(row.must_pause());
  row.take({}, last + 1990ms);
  EXPECT_FALSE(row.must_pause());
}

/// They were sent: he who sends them does not know of the stop yet.
TEST(CommandRow, DoesNotPauseWhileItsCommandsAreRefusedOrAreOthers) {
  CommandRow row(100ms);
  const Time last = send(row, kBegin, 400ms);
  row.stop();
  row.refuse(last + 700ms);
  row.take({}, last + 1400ms);
  EXPECT_TRUE(row.must_pause());
  row.overhear(last + 2100ms);
  row.take({}, last + 2800ms);
  EXPECT_TRUE(row.must_pause());
}

/// What came and was refused shows no pause itself: it may have been held back.
TEST(CommandRow, HasNotPausedBeforeACommandIsTakenAfterIt) {
  CommandRow row(100ms);
  const Time last = send(row, kBegin, 400ms);
  row.stop();
  row.refuse(last + 1500ms);
  EXPECT_TRUE(row.must_pause());
  row.take({}, last + 1510ms);
  EXPECT_TRUE(row.must_pause());
}

TEST(CommandRow, IsOverASecondAfterTheLastThatWasTaken) {
  CommandRow row(100ms);
  row.refuse(kBegin);
  EXPECT_FALSE(row.is_over(kBegin + 990ms));
  EXPECT_TRUE(row.is_over(kBegin + 1s));
  row.take({}, kBegin + 2s);
  row.refuse(kBegin + 2500ms);
  EXPECT_FALSE(row.is_over(kBegin + 2990ms));
  EXPECT_TRUE(row.is_over(kBegin + 3s));
}

}  // namespace
}  // namespace drover::engine
