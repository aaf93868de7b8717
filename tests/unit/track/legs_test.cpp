#include "track/legs.h"

#include <gtest/gtest.h>

#include "drover/angle.h"
#include "unit/track/tracks.h"

namespace drover::track {
namespace {

const double kSharp_rad = to_rad(60.0);

/// The corners of a whole route, by index; looked for so many metres at a time.
std::vector<std::size_t> corners(const Route& route, double stride_m) {
  const double end_m = whole_leg(route).last_m;
  std::vector<std::size_t> found;
  Leg leg = leg_to_target(route, 0, 0, end_m);
  CornerScan scan;
  for (double until_m = stride_m;;) {
    const Station corner = find_corner(route, leg, kSharp_rad, until_m, scan);
    if (corner.segment != 0) {
      found.push_back(corner.segment);
      leg = leg_to_target(route, corner.segment, corner.start_m, end_m);
    } else if (until_m > end_m) {
      return found;
    } else {
      until_m += stride_m;
    }
  }
}

TEST(TrueCorners, AreWhereARouteTurnsByMoreThanThePivotAngle) {
  Points points{{-2, 0}, {0, 0}, {}, {}};
  for (const double turn_deg : {-170.0, -61.0, -59.0, 0.0, 59.0, 61.0, 170.0}) {
    const Vector ahead{std::cos(to_rad(turn_deg)), std::sin(to_rad(turn_deg))};
    points[2] = {ahead.x, ahead.y};
    points[3] = {3 * ahead.x, 3 * ahead.y};
    const bool sharp = std::abs(turn_deg) > 60;
    EXPECT_EQ(corners(forwards_along(points), 50).size(), sharp ? 1U : 0U) << turn_deg;
  }
}

TEST(TrueCorners, OfPointsCloseTogetherAreTheSharpest) {
  const Points points{{0, 0}, {2.9, 0}, {2.97, 0.03}, {3, 0.1}, {3, 3}};
  const auto found = corners(forwards_along(points), 50);
  ASSERT_EQ(found.size(), 1U);
  EXPECT_EQ(found.front(), 2U);
}

TEST(TrueCorners, AreNotPassedOverForASharperOneFartherOn) {
  const Points points{{0, 0}, {4, 0}, {4.85, 1.81}, {1.95, 2.59}};  // 65 degrees, 2 m, 100 degrees
  EXPECT_EQ(corners(forwards_along(points), 50), (std::vector<std::size_t>{1, 2}));
}

TEST(TrueCorners, AreNoneWhereARecordingStepsBackALittle) {
  for (const double spacing_m : {0.05, 0.1, 0.2, 0.5}) {
    for (const double back_m : {0.03, 0.1, 0.15, 0.2, 0.25, 0.28}) {
      Points points;
      for (double x_m = 0; x_m < 3; x_m += spacing_m) points.push_back({x_m, 0});
      const double from_m = points.back().x_m;
      for (double gone_m = 0; gone_m < back_m;) {
        gone_m = std::min(back_m, gone_m + spacing_m);
        points.push_back({from_m - gone_m, 0.002});
      }
      for (double x_m = spacing_m; x_m < 3; x_m += spacing_m)
        points.push_back({from_m - back_m + x_m, 0});
      EXPECT_TRUE(corners(forwards_along(points), 50).empty()) << spacing_m << " " << back_m;
      EXPECT_TRUE(corners(forwards_along(points), 0.3).empty()) << spacing_m << " " << back_m;
    }
  }
}

TEST(TrueCorners, AreThereWhereARouteGoesBackAndAwayElsewhere) {
  const Points away{{0, 0}, {2, 0}, {1.8, 0}, {1.8, 3}};
  EXPECT_EQ(corners(forwards_along(away), 50), (std::vector<std::size_t>{1, 2})) << "to the left";
  const Points back{{0, 0}, {2, 0}, {1.8, 0}, {1.9, 0.05}, {0, 0.2}};
  EXPECT_EQ(corners(forwards_along(back), 50).size(), 1U) << "it goes home";
  const Points far{{0, 0}, {2, 0}, {1.4, 0}, {4, 0}};
  EXPECT_EQ(corners(forwards_along(far), 50), (std::vector<std::size_t>{1, 2})) << "that is meant";
}

TEST(TrueCorners, AreNeitherTheFirstNorTheLastPoint) {
  EXPECT_TRUE(corners(forwards_along({{0, 0}, {1, 0}}), 50).empty());
  const Points points{{0, 0}, {0, 0}, {1, 0}, {1, 0}};
  EXPECT_TRUE(corners(forwards_along(points), 50).empty());
}

TEST(TrueCorners, AreTheSameLookedForAtOnceAndBitByBit) {
  std::mt19937 random(5);
  std::size_t all = 0;
  for (int round = 0; round < 2000; ++round) {
    const Points points = any_walk(random);
    const Route route = forwards_along(points);
    const auto at_once = corners(route, 1e9);
    all += at_once.size();
    ASSERT_EQ(at_once, corners(route, 0.7)) << round;
  }
  EXPECT_GT(all, 2000U);
}

TEST(ALeg, EntersAndLeavesAlongItsEnds) {
  const Points points{{0, 0}, {3, 0}, {3, 4}};
  const Route route = forwards_along(points);
  CornerScan scan;
  const Leg whole = leg_to_target(route, 0, 0, 7);
  EXPECT_EQ(whole.last, 2U);
  EXPECT_EQ(whole.last_m, 7);
  EXPECT_EQ(whole.enter.x, 1);
  EXPECT_EQ(whole.leave.y, 1);
  const Station corner = find_corner(route, whole, kSharp_rad, 7, scan);
  ASSERT_EQ(corner.segment, 1U);
  const Leg leg = leg_to_corner(route, whole, corner);
  EXPECT_EQ(leg.last, 1U);
  EXPECT_EQ(leg.last_m, 3);
  EXPECT_EQ(leg.enter.x, 1);
  EXPECT_EQ(leg.leave.x, 1);
}

TEST(ALeg, TooShortForADirectionTakesThatOfTheWholeWay) {
  const Points points{{0, 0}, {0.06, 0.08}};
  const Leg leg = leg_to_target(forwards_along(points), 0, 0, 0.1);
  EXPECT_NEAR(leg.enter.x, 0.6, 1e-12);
  EXPECT_NEAR(leg.leave.y, 0.8, 1e-12);
}

}  // namespace
}  // namespace drover::track
