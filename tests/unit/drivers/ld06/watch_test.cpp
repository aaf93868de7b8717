// Turns that a test counts out itself: shares of one sector among 24 that see.
#include "drivers/ld06/watch.h"

#include <gtest/gtest.h>

#include "drivers/ld06/codec.h"

namespace drover::ld06 {
namespace {

constexpr std::size_t kThis = 7;

struct Turns {
  explicit Turns(double least_share = 0.5)
      : watch([&] {
          Settings settings;
          settings.least_share = least_share;
          return settings;
        }()) {}

  /// Turns of which that share of this sector's beams come back; whether it was seen in the last.
  /// In it is a gap of this width.
  bool run(int count, double share, double gap_rad = 0) {
    Scan turn;
    turn.turn_Hz = kTurn_Hz;
    for (int i = 0; i < count; ++i) {
      TurnCounts counts;
      counts.beams = 450;
      for (std::size_t k = 0; k < 24; ++k)
        (void)counts.sectors.push_back(
            {.seen = static_cast<int>(std::lround(18.75 * (k == kThis ? share : 0.95))),
             .gap_rad = k == kThis ? gap_rad : 0});
      counts.returns = 400;
      watch.judge(counts, turn);
    }
    return turn.sectors[kThis] == SectorState::seen_free;
  }

  Watch watch;
};

TEST(Ld06Watch, BelievesAShareAtOnceWhenItBegins) {
  EXPECT_TRUE(Turns().run(1, 0.9));
  EXPECT_FALSE(Turns().run(1, 0.3));
  EXPECT_TRUE(Turns(0.2).run(1, 0.3));
}

TEST(Ld06Watch, IsBlindWhereLessComesBackThanUsual) {
  // Far above what is needed at least.
  Turns turns(0.1);
  ASSERT_TRUE(turns.run(50, 0.95));
  EXPECT_TRUE(turns.run(20, 0.7));
  EXPECT_FALSE(turns.run(20, 0.4));
  EXPECT_EQ(turns.watch.condition(), Condition::partly_blind);
  EXPECT_EQ(turns.watch.blind_sectors(), 1);
  EXPECT_NEAR(turns.watch.blind_bearing_rad(), to_rad((7.5 / 24 - 0.5) * 360), 1e-9);
}

TEST(Ld06Watch, GetsUsedToAnotherPlaceInMinutesAndToABetterOneInSeconds) {
  Turns turns(0.1);
  ASSERT_TRUE(turns.run(50, 0.95));
  EXPECT_FALSE(turns.run(600, 0.37)) << "a minute";
  EXPECT_TRUE(turns.run(2400, 0.37)) << "five minutes";
  ASSERT_TRUE(turns.run(60, 0.95));
  EXPECT_FALSE(turns.run(20, 0.37)) << "six seconds were enough to learn the better";
}

TEST(Ld06Watch, SeesNothingInATurnOfWhichNearlyNothingCame) {
  Turns turns;
  ASSERT_TRUE(turns.run(50, 0.95));
  EXPECT_FALSE(turns.run(1, 0.2)) << "though the mean of three is still well";
  EXPECT_TRUE(turns.run(1, 0.95));
}

TEST(Ld06Watch, DoesNotFlickerAtTheEdge) {
  Turns turns;
  ASSERT_FALSE(turns.run(3, 0.3));
  EXPECT_FALSE(turns.run(100, 0.55)) << "what was not seen needs a tenth more";
  EXPECT_TRUE(turns.run(20, 0.7));
  EXPECT_TRUE(turns.run(100, 0.55)) << "what was seen does not";
}

/// A turn whose ranges are always the same, told with these intensities.
Scan still(std::uint8_t intensity) {
  Scan scan;
  scan.turn_Hz = kTurn_Hz;
  for (int i = 0; i < 450; ++i)
    (void)scan.points.push_back({wrap_rad(-to_rad(0.8 * i)), 2 + 0.001 * i, intensity});
  return scan;
}

TEST(Ld06Watch, CallsATurnFrozenOnlyWhenRangeAndIntensityStand) {
  Turns trembles;
  Turns stands;
  for (int i = 0; i < 10; ++i) {
    trembles.watch.compare(still(static_cast<std::uint8_t>(100 + i)));
    stands.watch.compare(still(100));
    trembles.run(1, 0.95);
    stands.run(1, 0.95);
    EXPECT_EQ(stands.watch.condition(), i < kFrozenTurns ? Condition::well : Condition::frozen);
  }
  EXPECT_EQ(trembles.watch.condition(), Condition::well);
}

TEST(Ld06Watch, CallsATurnFrozenAlsoWhenEachLostAnotherPacket) {
  Turns turns;
  for (int i = 0; i < 10; ++i) {
    Scan scan;
    scan.turn_Hz = kTurn_Hz;
    const Scan whole = still(100);
    for (int k = 0; k < 450; ++k)
      if (k / 12 != 3 * i) (void)scan.points.push_back(whole.points[static_cast<std::size_t>(k)]);
    turns.watch.compare(scan);
    turns.run(1, 0.95);
  }
  EXPECT_EQ(turns.watch.condition(), Condition::frozen);
}

TEST(Ld06Watch, CallsATurnFrozenAlsoWhenItsAnglesCreep) {
  Turns turns;
  for (int i = 0; i < 10; ++i) {
    Scan scan = still(100);
    for (ScanPoint& point : scan.points) point.bearing_rad = wrap_rad(point.bearing_rad + 1e-3 * i);
    turns.watch.compare(scan);
    turns.run(1, 0.95);
  }
  EXPECT_EQ(turns.watch.condition(), Condition::frozen);
}

TEST(Ld06Watch, BelievesAHoleOfOneTurnTheTurnBefore) {
  // A packet that was lost: 12 beams.
  Turns turns;
  ASSERT_TRUE(turns.run(50, 0.95));
  EXPECT_TRUE(turns.run(1, 0.95, to_rad(10)));
  EXPECT_TRUE(turns.run(1, 0.95));
  EXPECT_TRUE(turns.run(1, 0.95, to_rad(10)));
  EXPECT_FALSE(turns.run(1, 0.95, to_rad(10)));
}

}  // namespace
}  // namespace drover::ld06
