#include "mission/scene_way.h"

#include <gtest/gtest.h>

#include <cmath>

namespace drover::mission {
namespace {

TEST(AWay, IsWalkedAlong) {
  const Way way({{0, 0}, {2, 0}, {2, 3}});
  EXPECT_EQ(way.length_m(), 5);
  EXPECT_NEAR(way.pose(1).x_m, 1, 1e-12);
  EXPECT_NEAR(way.pose(1).yaw_rad, 0, 1e-12);
  EXPECT_NEAR(way.pose(4).y_m, 2, 1e-12);
  EXPECT_NEAR(way.pose(4).yaw_rad, M_PI / 2, 1e-12);
  EXPECT_NEAR(way.pose(99).y_m, 3, 1e-12);
  EXPECT_NEAR(way.nearest_m({1.5, 0.3}, 0, 10), 1.5, 0.011);
  EXPECT_NEAR(way.nearest_m({1.5, 0.3}, 1.7, 10), 1.7, 0.011) << "never back";
}

TEST(AWay, EndsAtTheFirstContact) {
  const Way way({{0, 0}, {10, 0}});
  const Flat box{{{5, -0.2}, {5.4, -0.2}, {5.4, 0.2}, {5, 0.2}}, 0};
  EXPECT_NEAR(way_to_contact_m(way, 1, 10, 0, box).value(), 5 - 0.45 - 1, 0.011);
  EXPECT_FALSE(way_to_contact_m(way, 1, 4.5, 0, box)) << "the goal is before it";
  EXPECT_FALSE(way_to_contact_m(way, 1, 10, 0.6, box)) << "it drives beside the way";
  EXPECT_NEAR(nearest_on_way_m(way, 1, 10, 0.6, box), 0.05, 1e-9);
  EXPECT_LT(nearest_on_way_m(way, 1, 10, 0, box), 0);
}

}  // namespace
}  // namespace drover::mission
