// What is black, wet or tilted gives nothing back: a hole in the turn, wherever it lies.
#include <gtest/gtest.h>

#include <random>

#include "unit/drivers/ld06/rig.h"

namespace drover::ld06 {
namespace {

using namespace std::chrono_literals;
using test::ld06_options;
using test::ScannerRig;

/// The room, and in it something black of this width.
RangeOf black(double middle_deg, double width_deg) {
  return [=](double bearing_rad) {
    const double off_rad = wrap_rad(bearing_rad - to_rad(middle_deg));
    return std::abs(off_rad) < to_rad(width_deg) / 2 ? 0.0 : test::room_m(bearing_rad);
  };
}

SectorState state_at(const Scan& scan, double bearing_deg) {
  return scan.sectors[sector_of(wrap_rad(to_rad(bearing_deg)), scan.sectors.size())];
}

TEST(Ld06Gaps, AThingThatGivesNothingBackIsNotFreeWhereSectorsMeet) {
  // Six degrees in each of two sectors: of neither a half is missing.
  ScannerRig rig;
  rig.run(2s);
  ASSERT_EQ(state_at(rig.last(), 5), SectorState::seen_free);
  rig.world = black(0, 12);
  rig.run(350ms);
  EXPECT_EQ(state_at(rig.last(), -5), SectorState::unknown);
  EXPECT_EQ(state_at(rig.last(), 5), SectorState::unknown);
  EXPECT_EQ(rig.health().state, SourceState::fresh);
  EXPECT_TRUE(rig.why().starts_with("the scanner is blind in 2 of 24 sectors")) << rig.why();
  rig.world = test::room_m;
  rig.run(1s);
  EXPECT_EQ(rig.unknown_sectors(), 0U);
}

TEST(Ld06Gaps, AreFoundAtEveryBearingAlsoWhenItHangs) {
  for (const bool upside_down : {false, true}) {
    ScannerRig rig(ld06_options().set("upside_down", upside_down));
    rig.run(500ms);
    for (int middle_deg = -180; middle_deg < 180; middle_deg += 7) {
      rig.world = black(middle_deg, 12);
      rig.run(350ms);
      for (const double off_deg : {-4.5, 0.0, 4.5})
        EXPECT_EQ(state_at(rig.last(), middle_deg + off_deg), SectorState::unknown)
            << middle_deg << " " << off_deg;
      EXPECT_LE(rig.unknown_sectors(), 3U) << middle_deg;
    }
  }
}

TEST(Ld06Gaps, AreFoundInTheVeryFirstTurn) {
  ScannerRig rig;
  rig.world = black(0, 12);
  rig.run(250ms);
  ASSERT_EQ(rig.scans.size(), 1U);
  EXPECT_EQ(state_at(rig.last(), -5), SectorState::unknown);
  EXPECT_EQ(state_at(rig.last(), 5), SectorState::unknown);
}

TEST(Ld06Gaps, BeamsThatFailOneByOneAreNone) {
  std::mt19937 random(1);
  ScannerRig rig;
  rig.world = [&](double bearing_rad) {
    return random() % 10 == 0 ? 0.0 : test::room_m(bearing_rad);
  };
  for (int second = 0; second < 60; ++second) {
    rig.run(1s);
    for (const Scan& scan : rig.scans)
      for (const SectorState state : scan.sectors) ASSERT_EQ(state, SectorState::seen_free);
    rig.scans.erase(rig.scans.begin(), rig.scans.end() - 1);
  }
}

TEST(Ld06Gaps, MayBeWiderWhereLessHasToComeBack) {
  for (const bool patient : {false, true}) {
    Options options = ld06_options();
    if (patient) options.set("least_share", 0.25);
    ScannerRig rig(options);
    rig.run(500ms);
    rig.world = black(0, 8);
    rig.run(350ms);
    EXPECT_EQ(state_at(rig.last(), 2), patient ? SectorState::seen_free : SectorState::unknown);
    rig.world = black(0, 12);
    rig.run(350ms);
    EXPECT_EQ(state_at(rig.last(), 2), SectorState::unknown);
  }
}

TEST(Ld06Gaps, OfTheRobotItselfAreUnknownAndNoComplaint) {
  ScannerRig rig(ld06_options().set("self_filter", std::string("0.5 0.3, 0.5 -0.3, -0.5 0")));
  // A post of six degrees.
  rig.world = [](double bearing_rad) {
    return std::abs(bearing_rad) < to_rad(3) ? 0.4 : test::room_m(bearing_rad);
  };
  rig.run(2s);
  EXPECT_EQ(state_at(rig.last(), -2), SectorState::unknown);
  EXPECT_EQ(state_at(rig.last(), 2), SectorState::unknown);
  EXPECT_EQ(rig.unknown_sectors(), 2U);
  EXPECT_EQ(rig.health().state, SourceState::fresh);
  EXPECT_EQ(rig.why(), "");
}

TEST(Ld06Driver, SeesNothingWhenEverythingIsTheRobotItself) {
  // A sack over a scanner whose outline is wide: farther than a cap, and inside.
  ScannerRig rig(ld06_options().set("self_filter", std::string("1 1, 1 -1, -1 -1, -1 1")));
  rig.run(2s);
  ASSERT_EQ(rig.health().state, SourceState::fresh);
  rig.world = [](double) { return 0.5; };
  rig.run(1s);
  EXPECT_EQ(rig.health().state, SourceState::stale);
  EXPECT_EQ(rig.why(),
            "the scanner sees nothing but the robot itself: covered, or self_filter is too wide");
  EXPECT_EQ(rig.unknown_sectors(), 24U);
}

/// What a mean of 30 % leaves, drawn anew for each seed.
TEST(Ld06Driver, InTheSunNeverCallsASectorFreeLongerThanATurn) {
  for (std::uint32_t seed = 1; seed <= 20; ++seed) {
    std::mt19937 random(seed);
    ScannerRig rig;
    rig.run(2s);
    rig.world = [&](double bearing_rad) {
      return random() % 10 < 3 ? test::room_m(bearing_rad) : 0.0;
    };
    rig.run(500ms);
    rig.scans.clear();
    rig.run(5s);
    EXPECT_NE(rig.health().state, SourceState::fresh);
    for (const Scan& scan : rig.scans)
      for (const SectorState state : scan.sectors) ASSERT_EQ(state, SectorState::unknown) << seed;
  }
}

}  // namespace
}  // namespace drover::ld06
