// The scanner's free distance: exact for boxes that are turned, beside, behind or astride.
#include "sim/plant/zones.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>

#include "drover/angle.h"

namespace drover::sim {
namespace {

double free_m(const Footprint& box) {
  return free_distance_m(std::array{box}, 0.45, 0.8);
}

TEST(Zones, AreFreeWithoutBoxes) {
  EXPECT_TRUE(std::isinf(free_distance_m({}, 0.45, 0.8)));
}

TEST(Zones, IgnoreABoxBehindTheBumper) {
  EXPECT_TRUE(std::isinf(free_m({-1.0, 0, 0, 0.2, 0.2})));
}

TEST(Zones, IgnoreABoxBesideTheCorridor) {
  EXPECT_TRUE(std::isinf(free_m({2.0, 0.61, 0, 0.2, 0.2})));
  EXPECT_TRUE(std::isinf(free_m({2.0, -0.61, 0, 0.2, 0.2})));
}

TEST(Zones, SeeABoxThatReachesIntoTheCorridorByACentimetre) {
  EXPECT_NEAR(free_m({2.0, 0.59, 0, 0.2, 0.2}), 2.0 - 0.2 - 0.45, 1e-12);
}

TEST(Zones, MeasureToTheNearestCornerOfATurnedBox) {
  EXPECT_NEAR(free_m({2.0, 0, to_rad(45), 0.2, 0.2}), 2.0 - 0.2 * std::sqrt(2.0) - 0.45, 1e-12);
}

TEST(Zones, MeasureToTheEdgeWhenTheNearestCornerIsOutsideTheCorridor) {
  // A wall at 45 degrees whose face x - y = 2 - 0.1 * sqrt(2) meets the corridor's edge y = -0.4.
  EXPECT_NEAR(free_m({2.0, 0, to_rad(45), 3.0, 0.1}), 2.0 - 0.1 * std::sqrt(2.0) - 0.4 - 0.45,
              1e-12);
}

TEST(Zones, AreZeroAheadWhenABoxReachesOverTheBumper) {
  EXPECT_EQ(free_m({0.5, 0, 0, 0.2, 0.2}), 0.0);
}

TEST(Zones, TakeTheNearestOfSeveralBoxes) {
  const std::array boxes{Footprint{3, 0, 0, 0.1, 0.1}, Footprint{1.55, 0.1, 0, 0.1, 0.1},
                         Footprint{1, 2, 0, 0.1, 0.1}};
  EXPECT_NEAR(free_distance_m(boxes, 0.45, 0.8), 1.0, 1e-12);
}

}  // namespace
}  // namespace drover::sim
