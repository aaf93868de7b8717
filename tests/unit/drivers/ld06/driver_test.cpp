#include "drivers/ld06/driver.h"

#include <gtest/gtest.h>

#include "unit/drivers/ld06/rig.h"

namespace drover::ld06 {
namespace {

using namespace std::chrono_literals;
using test::ld06_options;
using test::ScannerRig;

TEST(Ld06Driver, SeesTheRoomOfItsTwinTenTimesASecond) {
  ScannerRig rig;
  EXPECT_EQ(rig.health().state, SourceState::never_heard);
  EXPECT_EQ(rig.why(), "no data from the scanner");
  rig.run(10s);
  EXPECT_EQ(rig.health().state, SourceState::fresh);
  EXPECT_EQ(rig.why(), "");
  EXPECT_EQ(rig.health().bad, 0U);
  EXPECT_GT(rig.health().good, 3700U);
  EXPECT_NEAR(static_cast<double>(rig.scans.size()), 99, 1);
  EXPECT_EQ(rig.unknown_sectors(), 0U);
  ASSERT_EQ(rig.last().points.size(), 450U);
  for (const ScanPoint& point : rig.last().points)
    EXPECT_NEAR(point.range_m, test::room_m(point.bearing_rad), 0.06);
  EXPECT_LT(rig.now - rig.last().end, 110ms);
  EXPECT_EQ(rig.allocations, 0U);
}

TEST(Ld06Driver, SeesWhatIsOnTheLeftOnTheLeftAlsoWhenItHangs) {
  for (const bool upside_down : {false, true}) {
    ScannerRig rig(ld06_options().set("upside_down", upside_down));
    rig.world = [](double bearing_rad) { return bearing_rad > 1 && bearing_rad < 2 ? 1.0 : 5.0; };
    rig.run(1s);
    for (const ScanPoint& point : rig.last().points) {
      const double off_rad = std::abs(point.bearing_rad - 1.5);
      if (off_rad > 0.4 && off_rad < 0.6) continue;  // the edges
      EXPECT_NEAR(point.range_m, off_rad < 0.5 ? 1 : 5, 0.1);
    }
  }
}

TEST(Ld06Driver, IsStaleWhenSilentAndSaysSince) {
  ScannerRig rig;
  rig.run(2s);
  ASSERT_TRUE(rig.twin.set_state("silent", rig.now));
  rig.run(250ms);
  EXPECT_EQ(rig.health().state, SourceState::fresh);
  rig.run(750ms);
  EXPECT_EQ(rig.health().state, SourceState::stale);
  EXPECT_EQ(rig.why(), "the scanner is silent for 1.0 s");
  ASSERT_TRUE(rig.twin.set_state("", rig.now));
  rig.run(400ms);
  EXPECT_EQ(rig.health().state, SourceState::fresh);
}

TEST(Ld06Driver, PlacesATurnWhereItWasMeasured) {
  // The twin begins at 100.005 s, so zero is passed 0.1 s later for the first time. The packet of
  // its second turn is due 2.67 ms after that begins, and heard 2.33 ms later, with the next tick.
  ScannerRig rig;
  rig.run(1s);
  EXPECT_NEAR(to_s(rig.scans[1].begin), 100.205 + 0.00233, 0.0005);
  for (const Scan& scan : rig.scans) {
    EXPECT_NEAR(to_s(scan.end - scan.begin), 449 / 4500.0, 0.005);
    EXPECT_LT(scan.end, rig.now);
  }
}

TEST(Ld06Driver, BeginsAnewWithANewLink) {
  ScannerRig rig;
  rig.world = [](double bearing_rad) { return std::abs(bearing_rad) < 2 ? 3.0 : 0.0; };
  rig.run(2s);
  EXPECT_GT(rig.unknown_sectors(), 6U);
  // Somebody wiped the lens meanwhile: nothing of before is held against it.
  rig.world = test::room_m;
  rig.scans.clear();
  rig.driver.on_link_up(rig.now);
  rig.run(150ms);
  ASSERT_EQ(rig.scans.size(), 1U) << "the turn in which it began is not told";
  EXPECT_EQ(rig.last().points.size(), 450U);
  EXPECT_EQ(rig.unknown_sectors(), 0U);
  // A packet that was cut by the old link's end does not swallow the new link's first.
  const std::uint64_t bad = rig.health().bad;
  const std::array<std::uint8_t, 2> cut{kHeader, kKind};
  ScanOut out;
  rig.driver.on_bytes(cut, rig.now, out);
  rig.driver.on_link_up(rig.now);
  rig.run(100ms);
  EXPECT_EQ(rig.health().bad, bad);
}

struct Trouble {
  const char* state;
  const char* why;  ///< part of the reason
};

class Ld06Troubles : public ::testing::TestWithParam<Trouble> {};

TEST_P(Ld06Troubles, MakeItStaleWithEverySectorUnknown) {
  for (const Duration before : {Duration{0s}, Duration{5s}}) {
    ScannerRig rig;
    rig.run(before);
    ASSERT_TRUE(rig.twin.set_state(GetParam().state, rig.now));
    rig.run(700ms);
    EXPECT_NE(rig.why(), "");
    rig.run(2300ms);
    EXPECT_NE(rig.health().state, SourceState::fresh);
    EXPECT_NE(rig.why().find(GetParam().why), std::string::npos) << rig.why();
    if (!rig.scans.empty() && rig.now - rig.last().end < 1s) {
      EXPECT_EQ(rig.unknown_sectors(), 24U);
    }
    ASSERT_TRUE(rig.twin.set_state("", rig.now));
    rig.run(3s);
    EXPECT_EQ(rig.health().state, SourceState::fresh) << rig.why();
    EXPECT_EQ(rig.why(), "");
    EXPECT_EQ(rig.unknown_sectors(), 0U);
  }
}

/// The robot stops for the first turn in which nothing is seen, and nobody calls the scanner well
/// meanwhile.
TEST_P(Ld06Troubles, AreNeverFreshWithEverySectorUnknown) {
  ScannerRig rig;
  rig.run(5s);
  ASSERT_TRUE(rig.twin.set_state(GetParam().state, rig.now));
  for (int i = 0; i < 100; ++i) {
    rig.run(10ms);
    if (rig.unknown_sectors() == 24U) {
      ASSERT_EQ(rig.health().state, SourceState::stale) << i;
      ASSERT_NE(rig.why(), "");
    }
  }
}

INSTANTIATE_TEST_SUITE_P(
    Each, Ld06Troubles,
    ::testing::Values(Trouble{"covered", "lens is covered"}, Trouble{"dark", "nothing back"},
                      Trouble{"sun", "blind in 2"}, Trouble{"turn:7.5", "turns at 7.5 Hz"},
                      Trouble{"turn:13", "turns at 13.0 Hz"}, Trouble{"turn:2", "turns at 2.0 Hz"},
                      Trouble{"stuck", "does not turn"}),
    [](const auto& each) {
      std::string name = each.param.state;
      for (char& c : name)
        if (!std::isalnum(static_cast<unsigned char>(c))) c = '_';
      return name;
    });

TEST(Ld06Driver, NoticesATurnThatIsToldOverAndOverWithinASecond) {
  ScannerRig rig;
  rig.run(2s);
  ASSERT_TRUE(rig.twin.set_state("frozen", rig.now));
  rig.run(1100ms);
  EXPECT_EQ(rig.health().state, SourceState::stale);
  EXPECT_EQ(rig.why(), "the scanner tells the same turn over and over");
  EXPECT_EQ(rig.unknown_sectors(), 24U);
}

TEST(Ld06Driver, IsNotFrozenOrBlindInTenMinutesOfAQuietRoom) {
  ScannerRig rig;
  for (int i = 0; i < 60; ++i) {
    rig.run(10s);
    ASSERT_EQ(rig.health().state, SourceState::fresh) << rig.why();
    ASSERT_EQ(rig.why(), "");
    rig.scans.erase(rig.scans.begin(), rig.scans.end() - 1);
  }
}

TEST(Ld06Driver, StaysWellAtTheEdgesOfItsPace) {
  for (const char* state : {"turn:8.1", "turn:11.9"}) {
    ScannerRig rig;
    ASSERT_TRUE(rig.twin.set_state(state, rig.now));
    rig.run(3s);
    EXPECT_EQ(rig.health().state, SourceState::fresh) << rig.why();
    EXPECT_EQ(rig.unknown_sectors(), 0U);
  }
}

TEST(Ld06Driver, SaysWhereItSeesNothingAndStaysFreshWithTheRest) {
  ScannerRig rig(ld06_options().set("mount_yaw_deg", 90.0));
  rig.run(3s);
  // Black plastic before a fifth of the turn, to the right of the sensor: ahead of the robot. Four
  // sectors are full of it, and it reaches into two more.
  rig.world = [](double bearing_rad) {
    return std::abs(bearing_rad + kPi / 2) < 0.6 ? 0 : test::room_m(bearing_rad);
  };
  rig.run(1s);
  EXPECT_EQ(rig.health().state, SourceState::fresh);
  EXPECT_TRUE(rig.why().starts_with("the scanner is blind in 6 of 24 sectors, one at -3"))
      << rig.why();
  for (const double bearing_rad :
       {-kPi / 2 - 0.59, -kPi / 2 - 0.4, -kPi / 2 + 0.4, -kPi / 2 + 0.59})
    EXPECT_EQ(rig.last().sectors[sector_of(bearing_rad, 24)], SectorState::unknown);
  EXPECT_EQ(rig.last().sectors[sector_of(0, 24)], SectorState::seen_free);
}

TEST(Ld06Driver, NeverCallsOpenLandSeenUnlessItIsAllowedTo) {
  for (const bool allowed : {false, true}) {
    Options options = ld06_options();
    if (allowed) options.set("least_share", 0.0);
    ScannerRig rig(options);
    rig.world = [](double bearing_rad) { return std::abs(bearing_rad) < 0.3 ? 2.0 : 0.0; };
    rig.run(3s);
    EXPECT_EQ(rig.health().state, allowed ? SourceState::fresh : SourceState::never_heard);
    EXPECT_EQ(rig.unknown_sectors(), allowed ? 0U : 24U);
  }
}

TEST(Ld06Driver, CountsTheRobotItselfAsNoObstacleAndAsNothingSeen) {
  ScannerRig rig(
      ld06_options()
          .set("mount_x_m", 0.4)
          .set("self_filter", std::string("0.5 0.35, 0.5 -0.35, -0.5 -0.35, -0.5 0.35")));
  // A mast behind the scanner.
  rig.world = [](double bearing_rad) {
    return std::abs(wrap_rad(bearing_rad - kPi)) < 0.3 ? 0.5 : test::room_m(bearing_rad);
  };
  rig.run(2s);
  EXPECT_EQ(rig.health().state, SourceState::fresh);
  EXPECT_EQ(rig.why(), "") << "its own robot is no complaint";
  EXPECT_EQ(rig.last().sectors[0], SectorState::unknown);
  EXPECT_EQ(rig.last().sectors[12], SectorState::seen_free);
  for (const ScanPoint& point : rig.last().points)
    EXPECT_TRUE(point.range_m == 0 || point.range_m > 1.5) << point.range_m;
}

TEST(Ld06Driver, TellsOfDirtThatGrowsOnItsLens) {
  for (const char* outline : {"", "0.5 0.35, 0.5 -0.35, -0.5 -0.35, -0.5 0.35"}) {
    ScannerRig rig(ld06_options().set("self_filter", std::string(outline)));
    rig.run(5s);
    ASSERT_TRUE(rig.twin.set_state("dirty", rig.now));
    rig.run(2s);
    EXPECT_EQ(rig.health().state, SourceState::fresh);
    EXPECT_NE(rig.why().find("dirt on its lens"), std::string::npos) << rig.why();
    EXPECT_EQ(rig.last().sectors[sector_of(kPi / 2, 24)], SectorState::unknown);
    EXPECT_EQ(rig.last().sectors[sector_of(0, 24)], SectorState::seen_free);
  }
}

TEST(Ld06Driver, DrivesOnWithNoiseAndTellsItsPointsAsTheyAre) {
  ScannerRig rig;
  ASSERT_TRUE(rig.twin.set_state("noise", rig.now));
  rig.run(3s);
  EXPECT_EQ(rig.health().state, SourceState::fresh) << rig.why();
  std::size_t off = 0;
  for (const ScanPoint& point : rig.last().points)
    off += std::abs(point.range_m - test::room_m(point.bearing_rad)) > 0.1 ? 1U : 0U;
  EXPECT_GT(off, 5U);
  EXPECT_LT(off, 60U);
}

}  // namespace
}  // namespace drover::ld06
