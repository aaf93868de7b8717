#include "runtime/hold_ups.h"

#include <gtest/gtest.h>

namespace drover::runtime {
namespace {

using namespace std::chrono_literals;
using Kind = HoldUp::Kind;

/// The guard of this one takes over after 50 ms, and its cycles may take 30 ms more.
class AHoldUp : public testing::Test {
 protected:
  static constexpr Duration kCycle = 5ms;

  AHoldUp() { cycles(100, true); }
  void cycles(int count, bool moves) {
    for (int i = 0; i < count; ++i) EXPECT_EQ(after(kCycle, moves).kind, Kind::none);
  }
  /// What is found in the cycle that begins so long after the last one began.
  HoldUp after(Duration time, bool moves = true) {
    now_ += time;
    return hold_ups_.update(now_, asleep_, moves);
  }

  HoldUps hold_ups_{50ms};
  Time now_{100s};
  Duration asleep_ = 7s;  // earlier, since it booted
};

TEST_F(AHoldUp, IsNoneBelowTheGuardsLimitHoweverOften) {
  for (int i = 0; i < 50; ++i) EXPECT_EQ(after(50ms).kind, Kind::none);
}

TEST_F(AHoldUp, IsToldWhereTheGuardMayHaveTakenOver) {
  const HoldUp found = after(51ms);
  EXPECT_EQ(found.kind, Kind::told);
  EXPECT_EQ(found.lasted, 51ms);
  EXPECT_EQ(after(51ms).kind, Kind::none) << "once in ten seconds is enough";
}

TEST_F(AHoldUp, IsToldAgainAfterAWhile) {
  EXPECT_EQ(after(60ms).kind, Kind::told);
  cycles(1985, true);
  EXPECT_EQ(after(60ms).kind, Kind::none);
  EXPECT_EQ(after(60ms).kind, Kind::told);
}

TEST_F(AHoldUp, StopsWhatMovedWhereALivingGuardWouldHaveTakenOver) {
  EXPECT_EQ(after(80ms).kind, Kind::told);
  EXPECT_EQ(after(81ms).kind, Kind::stops);
  EXPECT_EQ(after(300ms).kind, Kind::stops) << "each of them";
  EXPECT_EQ(after(300ms).lasted, 300ms);
}

TEST_F(AHoldUp, OfARobotThatRestsIsNobodysMatter) {
  cycles(1, false);
  EXPECT_EQ(after(60ms, false).kind, Kind::none);
  EXPECT_EQ(after(900ms, false).kind, Kind::none);
}

TEST_F(AHoldUp, FollowsTheGuardsLimitOfTheConfiguration) {
  HoldUps wide(500ms);
  (void)wide.update(now_, {}, true);
  EXPECT_EQ(wide.update(now_ += 530ms, {}, true).kind, Kind::told);
  EXPECT_EQ(wide.update(now_ += 531ms, {}, true).kind, Kind::stops);
}

TEST_F(AHoldUp, CountsTheTimeInWhichTheMonotonicClockStoodStill) {
  asleep_ += 300ms;
  const HoldUp found = after(20ms);
  EXPECT_EQ(found.kind, Kind::stops);
  EXPECT_EQ(found.lasted, 320ms);
}

TEST_F(AHoldUp, BeyondASecondOfSleepIsASleepAlsoAtRest) {
  asleep_ += 2s;
  const HoldUp found = after(kCycle, false);
  EXPECT_EQ(found.kind, Kind::slept);
  EXPECT_EQ(found.lasted, 2s);
  EXPECT_EQ(after(kCycle).kind, Kind::none);
}

TEST_F(AHoldUp, IsNotWhatWasBeforeTheFirstCycle) {
  HoldUps fresh(50ms);
  EXPECT_EQ(fresh.update(now_, 3600s, true).kind, Kind::none);
}

}  // namespace
}  // namespace drover::runtime
