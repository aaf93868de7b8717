#include "scene/plane/overlap.h"

#include <gtest/gtest.h>

#include <limits>
#include <random>

#include "drover/angle.h"
#include "tests/unit/scene/plane/shapes.h"

namespace drover::scene {
namespace {

constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();
constexpr double kHair_m = 1e-9;

TEST(Overlap, OfSquaresThatTouchIsOne) {
  const Piece square = piece_of({{0, 0}, {1, 0}, {1, 1}, {0, 1}});
  EXPECT_TRUE(overlaps(square, piece_of({{1, 0}, {2, 0}, {2, 1}, {1, 1}})));
  EXPECT_TRUE(overlaps(square, piece_of({{1, 1}, {2, 1}, {2, 2}, {1, 2}})));
  EXPECT_FALSE(overlaps(square, piece_of({{1 + kHair_m, 0}, {2, 0}, {2, 1}, {1 + kHair_m, 1}})));
}

TEST(Overlap, AtACornerIsJudgedByDistanceNotBySides) {
  const Piece square = piece_of({{0, 0}, {1, 0}, {1, 1}, {0, 1}}, 0.1);
  const double diagonal_m = 0.3 * std::sqrt(0.5);
  EXPECT_TRUE(overlaps(square, disc({1 + diagonal_m - kHair_m, 1 + diagonal_m}, 0.2)));
  EXPECT_FALSE(overlaps(square, disc({1 + diagonal_m + kHair_m, 1 + diagonal_m}, 0.2)));
}

TEST(Overlap, OfDiscsWallsAndPointsWithEachOther) {
  EXPECT_TRUE(overlaps(disc({0, 0}, 1), disc({2, 0}, 1)));
  EXPECT_FALSE(overlaps(disc({0, 0}, 1), disc({2 + kHair_m, 0}, 1)));
  EXPECT_TRUE(overlaps(disc({3, 3}, 0), disc({3, 3}, 0)));
  EXPECT_FALSE(overlaps(disc({3, 3}, 0), disc({3, 3 + kHair_m}, 0)));
  const Piece wall = piece_of({{-1, 0}, {1, 0}});
  EXPECT_TRUE(overlaps(wall, piece_of({{0, -1}, {0, 1}}))) << "crossing walls";
  EXPECT_FALSE(overlaps(wall, piece_of({{0, 1}, {0, kHair_m}})));
  EXPECT_TRUE(overlaps(wall, piece_of({{0.5, 0}, {3, 0}}))) << "one behind the other";
  EXPECT_FALSE(overlaps(wall, piece_of({{1 + kHair_m, 0}, {3, 0}})));
  EXPECT_TRUE(overlaps(wall, disc({1.5, 0}, 0.5)));
  EXPECT_FALSE(overlaps(wall, disc({1.5 + kHair_m, 0}, 0.5)));
}

TEST(Overlap, OfABoxThreeCentimetresBesideATrackAtEqualCentreHeightIsNone) {
  const Heights heights{0, 0.5};
  const double beside_m = 0.35 + 0.25 + 0.03;
  const Area area = area_of(box(0.5, 0.5, 0.5), pose(0, beside_m, 0.25), heights);
  EXPECT_FALSE(overlaps(footprint(0.0299), area));
  EXPECT_TRUE(overlaps(footprint(0.0301), area));
}

TEST(Overlap, IsTheSameFarFromTheOrigin) {
  for (const Point2 far : {Point2{322'100, -4.5e6}, Point2{-1e6, 1e6}}) {
    const Area area = area_of(box(1, 1, 1), pose(far.x_m, far.y_m, 0), kRobot);
    EXPECT_TRUE(overlaps(placed(footprint(), {far.x_m + 0.9499, far.y_m, 0}), area));
    EXPECT_FALSE(overlaps(placed(footprint(), {far.x_m + 0.9501, far.y_m, 0}), area));
  }
}

TEST(Overlap, WithNumbersThatAreNoneIsOne) {
  const Piece square = footprint();
  EXPECT_TRUE(overlaps(square, disc({kNaN, 0}, 1)));
  EXPECT_TRUE(overlaps(square, disc({100, 0}, kNaN)));
  EXPECT_TRUE(overlaps(square, disc({100, 0}, -1)));
  EXPECT_TRUE(overlaps(square, piece_of({})));
  EXPECT_TRUE(overlaps(square, piece_of({{9, 9}, {10, kNaN}, {9, 10}})));
  EXPECT_TRUE(overlaps(placed(square, {kNaN, 0, 0}), disc({9, 9}, 1)));
  EXPECT_TRUE(overlaps(placed(square, {0, 0, kNaN}), disc({9, 9}, 1)));
  EXPECT_TRUE(overlaps(square, area_of_rings({{{8, 8}, {9, 8}, {9, kNaN}}})));
  EXPECT_TRUE(overlaps(square, area_of({disc({kNaN, 0}, 1), disc({8, 8}, 1)})));
  EXPECT_TRUE(overlaps(placed(square, {1e300, 0, 0}), area_of_everything()));
}

TEST(Overlap, HullsForgetInnerAndRepeatedPoints) {
  const Piece hull =
      piece_of({{0, 0}, {2, 0}, {1, 1}, {2, 2}, {0, 2}, {0, 0}, {1, 0}, {2, 1}, {2, 2}});
  EXPECT_EQ(hull.corners, (std::vector<Point2>{{0, 0}, {2, 0}, {2, 2}, {0, 2}}));
  EXPECT_EQ(piece_of({{1, 1}, {0, 0}, {2, 2}}).corners, (std::vector<Point2>{{0, 0}, {2, 2}}));
}

/// 10 m, with a hole of 2 m in the middle.
std::vector<std::vector<Point2>> square_with_hole() {
  return {{{0, 0}, {10, 0}, {10, 10}, {0, 10}, {0, 0}}, {{4, 4}, {4, 6}, {6, 6}, {6, 4}, {4, 4}}};
}

TEST(Rings, AKeepOutIsSolidAndItsHoleIsNot) {
  const Area area = area_of_rings(square_with_hole());
  EXPECT_TRUE(overlaps(placed(footprint(), {2, 2, 1}), area));
  EXPECT_TRUE(overlaps(placed(footprint(), {0, -0.3, 0}), area));
  EXPECT_FALSE(overlaps(placed(footprint(), {5, 5, 1}), area));
  EXPECT_FALSE(overlaps(placed(footprint(), {-2, 5, 1}), area));
}

TEST(Rings, AKeepInHoldsTheWholeFootprint) {
  const Area area = area_of_rings(square_with_hole());
  EXPECT_TRUE(is_inside(area, placed(footprint(), {2, 2, 1})));
  EXPECT_FALSE(is_inside(area, placed(footprint(), {0.44, 2, 0}))) << "across the outer line";
  EXPECT_FALSE(is_inside(area, placed(footprint(), {5, 5, 0}))) << "in the hole";
  EXPECT_FALSE(is_inside(area, placed(footprint(), {4, 5, 0}))) << "across the hole";
  EXPECT_FALSE(is_inside(area, placed(footprint(), {20, 5, 0})));
  EXPECT_FALSE(is_inside(area, placed(footprint(), {kNaN, 5, 0})));
}

TEST(Rings, AKeepInWithAHoleThatIsSmallerThanTheRobotIsNotLeftOverIt) {
  const Area area = area_of_rings(
      {{{0, 0}, {10, 0}, {10, 10}, {0, 10}}, {{5, 5}, {5.1, 5}, {5.1, 5.1}, {5, 5.1}}});
  EXPECT_FALSE(is_inside(area, placed(footprint(), {5, 5, 0})));
}

TEST(Rings, AConcaveKeepInIsNotCutAcrossItsMouth) {
  const Area area =
      area_of_rings({{{0, 0}, {10, 0}, {10, 10}, {6, 10}, {6, 2}, {4, 2}, {4, 10}, {0, 10}}});
  EXPECT_TRUE(is_inside(area, placed(footprint(), {2, 8, 0})));
  EXPECT_FALSE(is_inside(area, placed(footprint(), {5, 8, 0})));
}

TEST(Widened, AnAreaIsAllThatIsWithinTheWidthOfIt) {
  const Area box_area = widened(area_of(box(2, 2, 1), pose(5, 0, 0.5), kRobot), 0.3);
  EXPECT_TRUE(covers(box_area, 3.71, 0));
  EXPECT_FALSE(covers(box_area, 3.69, 0));
  EXPECT_FALSE(covers(box_area, 3.75, 1.25)) << "its corners are round";
  const Area wall = widened(area_of(Plane{{1, 0, 0, -2}}, {}, kRobot), 0.3);
  EXPECT_TRUE(covers(wall, 1.71, 9));
  EXPECT_TRUE(covers(wall, 2.29, -9));
  EXPECT_FALSE(covers(wall, 1.69, 9));
  const Area ring = widened(area_of_rings(square_with_hole()), 0.3);
  EXPECT_TRUE(covers(ring, -0.29, 5));
  EXPECT_TRUE(covers(ring, 2, 2)) << "still solid";
  EXPECT_FALSE(covers(ring, -0.31, 5));
}

TEST(Widened, NothingStaysNothingAndNoWidthAtAllIsEverything) {
  EXPECT_TRUE(widened(Area{}, 0.3).empty());
  EXPECT_TRUE(covers(widened(area_of_everything(), 0.3), 1e6, 0));
  for (const double by_m : {kNaN, -0.1})
    EXPECT_TRUE(covers(widened(area_of(box(2, 2, 1), pose(5, 0, 0.5), kRobot), by_m), 90, 9));
  EXPECT_TRUE(overlaps(widened(disc({0, 0}, 1), kNaN), disc({90, 0}, 1)));
}

TEST(Nearest, IsOnTheEdgeOrThePointItself) {
  const Piece square = piece_of({{0, 0}, {1, 0}, {1, 1}, {0, 1}}, 0.5);
  EXPECT_EQ(nearest(square, {0.2, 0.3}), (Point2{0.2, 0.3}));
  EXPECT_EQ(nearest(square, {3, 0.5}), (Point2{1.5, 0.5}));
  const Area strip = area_of(Plane{{1, 0, 0, -2}}, {}, kRobot);
  EXPECT_EQ(nearest(strip, {0, 7}), (Point2{2, 7}));
}

}  // namespace
}  // namespace drover::scene
