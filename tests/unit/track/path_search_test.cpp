#include "track/path_search.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "drover/angle.h"
#include "unit/track/tracks.h"

namespace drover::track {
namespace {

TEST(AStart, IsThePointOfThePathThatIsNearest) {
  const Points points{{0, 0}, {5, 0}, {10, 0}};
  const PathStart start = find_start(points, 2, {7, 0.4}, 0.1);
  EXPECT_EQ(start.segment, 1U);
  EXPECT_NEAR(start.along_m, 2, 1e-12);
  EXPECT_NEAR(start.left_m, 3, 1e-12);
  EXPECT_TRUE(start.forwards);
  EXPECT_NEAR(start.turned_rad, 0.1, 1e-12);
}

TEST(AStart, LeadsBackAlongTheListToATargetThere) {
  const Points points{{0, 0}, {5, 0}, {10, 0}};
  const PathStart start = find_start(points, 0, {7, 0.4}, 0.1);
  EXPECT_EQ(start.segment, 1U);
  EXPECT_NEAR(start.along_m, 2, 1e-12) << "from the list's point all the same";
  EXPECT_NEAR(start.left_m, 7, 1e-12);
  EXPECT_FALSE(start.forwards);
  EXPECT_NEAR(start.turned_rad, kPi - 0.1, 1e-12);
}

TEST(AStart, IsOnTheLegThatTheRobotLooksAlong) {
  const Points points{{0, 0}, {10, 0}, {20, 0}, {10, 0}, {0, 0}};
  EXPECT_NEAR(find_start(points, 4, {4, 0.05}, 0).left_m, 36, 1e-9);
  EXPECT_NEAR(find_start(points, 4, {4, 0.05}, kPi).left_m, 4, 1e-9);
}

TEST(AStart, IsOnTheLegThatTheRobotDrivesAsItStands) {
  const Points points{{0, 0}, {10, 0}, {20, 0}, {10, 0}, {0, 0}};
  const std::vector<std::uint8_t> back{0, 0, 1, 1};
  const Gears gears{back};
  EXPECT_NEAR(find_start(points, 4, {4, 0.05}, kPi, gears).turned_rad, kPi, 0.1)
      << "both are for who looks east";
  EXPECT_NEAR(find_start(points, 4, {4, 0.05}, 0, gears).turned_rad, 0, 0.1);
  const Gears either{back, true};
  for (const double yaw_rad : {0.0, kPi}) {
    const PathStart start = find_start(points, 4, {4, 0.05}, yaw_rad, either);
    EXPECT_NEAR(start.turned_rad, 0, 0.1);
    EXPECT_EQ(start.flipped, yaw_rad != 0);
  }
}

TEST(AStart, IsOnAFartherLegOnlyWhenThatIsAboutAsNear) {
  const Points points{{0, 0}, {10, 0}, {10, 0.5}, {0, 0.5}};
  EXPECT_EQ(find_start(points, 3, {5, 0.15}, kPi).segment, 2U);
  EXPECT_EQ(find_start(points, 3, {5, 0.05}, kPi).segment, 0U);
}

TEST(AStart, OfALoopHasAllOfItAhead) {
  Points points = arc(5, 2 * kPi);
  points.back() = points.front();
  const PathStart start = find_start(points, points.size() - 1, {0.02, 0.01}, 0);
  EXPECT_NEAR(start.left_m, 2 * kPi * 5, 0.2);
}

TEST(AStart, IsNeverFartherThanTheNearestPlaceByMoreThanAThirdOfAMetre) {
  std::mt19937 random(7);
  std::uniform_real_distribution<> at_m(-6, 6);
  for (int round = 0; round < 2000; ++round) {
    const Points points = any_walk(random);
    const std::size_t target = random() % points.size();
    const Vector at{at_m(random), at_m(random)};
    const PathStart start = find_start(points, target, at, at_m(random));
    ASSERT_LT(start.segment + 1, points.size());
    ASSERT_EQ(start.forwards, start.segment < target);
    const Route route = forwards_along(points);
    double least_m = INFINITY;
    for (std::size_t k = 0; k + 1 < points.size(); ++k)
      for (double share = 0; share <= 1; share += 0.05)
        least_m = std::min(
            least_m, length(at - (route.point(k) + share * (route.point(k + 1) - route.point(k)))));
    const Vector along = route.point(start.segment + 1) - route.point(start.segment);
    const Vector there = route.point(start.segment) + start.along_m * unit(along, {});
    ASSERT_LE(length(at - there), least_m + 0.3 + 1e-9) << round;
    ASSERT_LE(start.along_m, length(along) + 1e-9);
    ASSERT_GE(start.turned_rad, 0);
    ASSERT_LE(start.turned_rad, kPi + 1e-12);
  }
}

TEST(APath, IsClosedWhenItEndsWhereItBegins) {
  EXPECT_TRUE(is_closed(Points{{0, 0}, {5, 0}, {0.2, 0.2}}));
  EXPECT_FALSE(is_closed(Points{{0, 0}, {5, 0}, {0.3, 0.2}}));
  EXPECT_FALSE(is_closed(Points{{0, 0}, {0.1, 0}})) << "two points are no loop";
}

TEST(ATarget, OfALoopIsReachedAhead) {
  const Points square{{0, 0}, {4, 0}, {4, 4}, {0, 4}, {0, 0}};
  // Towards the list's end the first point lies ahead, by the other index.
  EXPECT_EQ(target_ahead(square, 0, {2, 0}, 0), 4U);
  EXPECT_EQ(target_ahead(square, 0, {2, 0}, kPi), 0U);
  EXPECT_EQ(target_ahead(square, 4, {2, 0}, kPi), 0U);
  EXPECT_EQ(target_ahead(square, 2, {2, 0}, kPi), 2U) << "in its middle as it was asked";
  EXPECT_EQ(target_ahead(square, 0, {0.05, 0}, 0), 0U) << "it stands there already";
}

TEST(ATarget, OfAnOpenPathStaysWhatItIs) {
  const Points open{{0, 0}, {4, 0}, {4, 4}, {0, 4}};
  EXPECT_EQ(target_ahead(open, 0, {2, 0}, 0), 0U);
  EXPECT_EQ(target_ahead(open, 3, {2, 0}, kPi), 3U);
}

}  // namespace
}  // namespace drover::track
