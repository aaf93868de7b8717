#include "scene/sensor/field.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <random>

namespace drover::scene::sensor {
namespace {

/// A scanner that sees everything, and nothing is there.
Scan free_scan(std::size_t sectors = 24) {
  Scan scan;
  for (std::size_t i = 0; i < sectors; ++i) (void)scan.sectors.push_back(SectorState::seen_free);
  return scan;
}

/// The point (x, y) of base_link, as a scanner there sees it.
void put(Scan& scan, const ScanMount& mount, double x_m, double y_m) {
  const double dx_m = x_m - mount.x_m;
  const double dy_m = y_m - mount.y_m;
  (void)scan.points.push_back(
      {wrap_rad(std::atan2(dy_m, dx_m) - mount.yaw_rad), std::hypot(dx_m, dy_m), 100});
}

const ScanMount kFront{0.45, 0, 0.25, 0};
const SensorField kField{.from_x_m = 0.46, .ahead_m = 2, .beside_m = 0.4};

TEST(SensorField, IsFreeWhenAllIsSeenAndNothingIsThere) {
  const FieldState state = look(free_scan(), kFront, kField);
  EXPECT_FALSE(state.blocked);
  EXPECT_FALSE(state.unknown);
  EXPECT_DOUBLE_EQ(state.free_m, 2);
}

TEST(SensorField, TellsThePointWithTheLeastWayAhead) {
  Scan scan = free_scan();
  put(scan, kFront, 1.9, 0.05);
  put(scan, kFront, 1.5, -0.39);
  put(scan, kFront, 0.9, 0.41);     // beside
  put(scan, kFront, 2.47, 0);       // beyond
  put(scan, kFront, -1, 0);         // behind
  (void)scan.points.push_back({});  // nothing came back
  const FieldState state = look(scan, kFront, kField);
  EXPECT_TRUE(state.blocked);
  EXPECT_EQ(state.points, 2U);
  EXPECT_NEAR(state.nearest.x_m, 1.5, 1e-9);
  EXPECT_NEAR(state.nearest.y_m, -0.39, 1e-9);
  EXPECT_NEAR(state.free_m, 1.04, 1e-9);
  EXPECT_FALSE(state.unknown);
}

TEST(SensorField, FindsAPointWhereverTheScannerIsMounted) {
  for (const double yaw_deg : {-180.0, -90.0, 0.0, 37.0, 179.0}) {
    for (const double y_m : {-0.3, 0.0, 0.3}) {
      const ScanMount mount{0.2, y_m, 0.25, to_rad(yaw_deg)};
      Scan scan = free_scan();
      put(scan, mount, 1.2, 0.1);
      const FieldState state = look(scan, mount, kField);
      ASSERT_TRUE(state.blocked) << yaw_deg;
      EXPECT_NEAR(state.nearest.x_m, 1.2, 1e-9);
      EXPECT_NEAR(state.nearest.y_m, 0.1, 1e-9);
    }
  }
}

TEST(SensorField, IsUnknownWithoutSectors) {
  EXPECT_TRUE(look(Scan{}, kFront, kField).unknown);
}

/// Against points strewn over the field: a sector matters when one of them lies in it.
TEST(SensorField, IsUnknownWhenASectorAcrossItIs) {
  std::mt19937 random(1);
  std::uniform_real_distribution<double> unit(0, 1);
  for (int round = 0; round < 200; ++round) {
    const ScanMount mount{unit(random), 1.6 * unit(random) - 0.8, 0.2, 7 * unit(random)};
    const std::size_t sectors = 8 + random() % 65;
    std::vector<bool> crosses(sectors, false);
    for (int i = 0; i < 2000; ++i) {
      Scan one;
      put(one, mount, kField.from_x_m + kField.ahead_m * unit(random),
          kField.beside_m * (2 * unit(random) - 1));
      crosses[sector_of(one.points[0].bearing_rad, sectors)] = true;
    }
    for (std::size_t i = 0; i < sectors; ++i) {
      Scan scan = free_scan(sectors);
      scan.sectors[i] = SectorState::unknown;
      // What is strewn may miss a sliver of a sector; what it hits must be asked for.
      if (!crosses[i]) continue;
      EXPECT_TRUE(look(scan, mount, kField).unknown) << round << " " << i;
    }
  }
}

TEST(SensorField, IsUnknownWhenItLiesWithinOneSectorThatIs) {
  const SensorField far_away{.from_x_m = 8, .ahead_m = 0.2, .beside_m = 0.1};
  Scan scan = free_scan(8);
  const ScanMount turned{0, 0, 0.2, to_rad(-22.5)};  // the sector from 0 to 45 degrees looks ahead
  scan.sectors[4] = SectorState::unknown;
  EXPECT_TRUE(look(scan, turned, far_away).unknown);
  scan.sectors[4] = SectorState::seen_free;
  scan.sectors[3] = scan.sectors[5] = SectorState::unknown;
  EXPECT_FALSE(look(scan, turned, far_away).unknown);
}

TEST(SensorField, DoesNotAskForWhatIsBehindTheScanner) {
  Scan scan = free_scan();
  for (const std::size_t behind : {0U, 1U, 2U, 3U, 20U, 21U, 22U, 23U})
    scan.sectors[behind] = SectorState::unknown;
  EXPECT_FALSE(look(scan, kFront, kField).unknown);
  scan.sectors[12] = SectorState::unknown;
  EXPECT_TRUE(look(scan, kFront, kField).unknown);
}

TEST(SensorField, IsUnknownBehindWhatStandsBetweenItAndTheScanner) {
  const ScanMount behind{-0.4, 0, 0.5, 0};
  Scan scan = free_scan();
  put(scan, behind, 0.2, 0.05);
  const FieldState state = look(scan, behind, kField);
  EXPECT_FALSE(state.blocked);
  EXPECT_TRUE(state.unknown);
}

TEST(SensorField, ThatIsNoRectangleIsNeverFree) {
  const double nan = std::nan("");
  for (const SensorField& field :
       {SensorField{nan, 2, 0.4}, SensorField{0, nan, 0.4}, SensorField{0, 2, nan},
        SensorField{0, -1, 0.4}, SensorField{0, 2, -0.4},
        SensorField{0, std::numeric_limits<double>::infinity(), 0.4}}) {
    const FieldState state = look(free_scan(), kFront, field);
    EXPECT_TRUE(state.blocked && state.unknown);
    EXPECT_EQ(state.free_m, 0);
  }
}

TEST(SensorField, OfAScannerThatIsNowhereIsNeverFree) {
  const double nan = std::nan("");
  for (const ScanMount& mount :
       {ScanMount{nan, 0, 0.2, 0}, ScanMount{0, nan, 0.2, 0}, ScanMount{0, 0, 0.2, nan},
        ScanMount{0, std::numeric_limits<double>::infinity(), 0.2, 0}})
    EXPECT_TRUE(look(free_scan(), mount, kField).unknown);
}

TEST(SensorField, MeetsARampAtItsBeamsHeightBySlope) {
  EXPECT_DOUBLE_EQ(ramp_distance_m(0.3, 0.15), 2.0);
  EXPECT_DOUBLE_EQ(ramp_distance_m(0.15, 0.15), 1.0);
  EXPECT_TRUE(std::isinf(ramp_distance_m(0.3, 0)));
  EXPECT_TRUE(std::isinf(ramp_distance_m(0.3, -0.15)));
  EXPECT_TRUE(std::isinf(ramp_distance_m(0.3, std::nan(""))));
}

}  // namespace
}  // namespace drover::scene::sensor
