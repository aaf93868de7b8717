// The judge's geometry is judged: by numbers made by hand, and by points sampled in both shapes.
#include "mission/flat.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

namespace drover::mission {
namespace {

TrueSolid solid(const char* kind, double x_m, double y_m, std::vector<double> sizes,
                double yaw_rad = 0, double z_m = 0.5) {
  return {"thing", kind, x_m, y_m, z_m, yaw_rad, std::move(sizes)};
}
double gap_of_robot_m(const TrueSolid& thing, double x_m = 0, double y_m = 0, double yaw_rad = 0) {
  return gap_m(outline(x_m, y_m, yaw_rad), flat(thing).value());
}

TEST(TheJudge, MeasuresTheGapToABox) {
  EXPECT_NEAR(gap_of_robot_m(solid("box", 2, 0, {1, 1, 1})), 2 - 0.5 - 0.45, 1e-12);
  EXPECT_NEAR(gap_of_robot_m(solid("box", -2, 0, {1, 1, 1})), 2 - 0.5 - 0.415, 1e-12);
  EXPECT_NEAR(gap_of_robot_m(solid("box", 0, 1, {1, 1, 1})), 1 - 0.5 - 0.35, 1e-12);
  EXPECT_NEAR(gap_of_robot_m(solid("box", 1.95, 1.85, {1, 1, 1})), std::hypot(1.0, 1.0), 1e-12)
      << "corner to corner";
  EXPECT_NEAR(gap_of_robot_m(solid("box", 2, 0, {1, 1, 1}, M_PI / 4)), 2 - std::sqrt(0.5) - 0.45,
              1e-12);
  EXPECT_NEAR(gap_of_robot_m(solid("box", 0, 2, {1, 1, 1}), 0, 0, M_PI / 2), 2 - 0.5 - 0.45, 1e-12);
}

TEST(TheJudge, MeasuresTheGapToRoundThings) {
  EXPECT_NEAR(gap_of_robot_m(solid("cylinder", 1, 0, {0.01, 1})), 0.54, 1e-12);
  EXPECT_NEAR(gap_of_robot_m(solid("cylinder", 1.45, 1.35, {0.3, 1})), std::sqrt(2.0) - 0.3, 1e-12);
  EXPECT_NEAR(gap_of_robot_m(solid("cylinder", 0.40, 0, {0.3, 1})), -0.35, 1e-12) << "inside";
  EXPECT_NEAR(gap_of_robot_m(solid("cylinder", 0.70, 0, {0.3, 1})), -0.05, 1e-12);
}

TEST(TheJudge, KnowsWhatIsAtTheRobotsHeights) {
  EXPECT_FALSE(flat(solid("box", 0, 0, {1, 1, 0.04}, 0, 0.02))) << "driven over";
  EXPECT_FALSE(flat(solid("box", 0, 0, {1, 1, 1}, 0, 1.51))) << "driven under";
  EXPECT_TRUE(flat(solid("box", 0, 0, {1, 1, 1}, 0, 1.49)));
  EXPECT_FALSE(flat(solid("cylinder", 0, 0, {1, 0.04}, 0, 0.02)));
  EXPECT_NEAR(flat(solid("sphere", 0, 0, {0.5}, 0, 0.5)).value().radius_m, 0.5, 1e-12);
  EXPECT_NEAR(flat(solid("sphere", 0, 0, {0.5}, 0, 1.3)).value().radius_m, 0.4, 1e-12);
  EXPECT_FALSE(flat(solid("sphere", 0, 0, {0.5}, 0, 1.51)));
  EXPECT_NEAR(flat(solid("cone", 0, 0, {0.3, 0.8}, 0, 0.4)).value().radius_m,
              0.3 * (1 - 0.05 / 0.8), 1e-12);
  EXPECT_NEAR(flat(solid("cone", 0, 0, {0.3, 0.8}, 0, 1.3)).value().radius_m, 0.3, 1e-12);
}

TEST(TheJudge, TakesAPrismsCornersAboutItsPlace) {
  const auto wedge = solid("prism", 2, 1, {1, 0, 0, 1, -1, 1, 1}, M_PI);
  EXPECT_NEAR(gap_of_robot_m(wedge, 0, 1), 1 - 0.45, 1e-12) << "its back is towards the robot";
  EXPECT_NEAR(gap_of_robot_m(solid("prism", 2, 1, {1, 0, 0, 1, -1, 1, 1}), 0, 1), 2 - 0.45, 1e-12);
}

// A grid of points of each shape: where one of `a` lies inside `b`, they overlap; and no pair of
// points is nearer than the gap.
TEST(TheJudge, AgreesWithPointsSampledOfBothShapes) {
  std::mt19937_64 random(11);
  std::uniform_real_distribution<double> place(-2, 2);
  std::uniform_real_distribution<double> size(0.05, 1.5);
  std::uniform_real_distribution<double> angle(-M_PI, M_PI);
  std::size_t overlaps = 0;
  for (int i = 0; i < 2000; ++i) {
    const TrueSolid box =
        solid("box", place(random), place(random), {size(random), size(random), 1}, angle(random));
    const double yaw_rad = angle(random);
    const double gap = gap_of_robot_m(box, 0, 0, yaw_rad);
    double least_m = 1e9;
    bool inside = false;
    constexpr int kGrid = 24;
    for (int u = 0; u <= kGrid; ++u)
      for (int v = 0; v <= kGrid; ++v) {
        const double bx = (u / double{kGrid} - 0.5) * box.sizes[0];
        const double by = (v / double{kGrid} - 0.5) * box.sizes[1];
        const double x = box.x_m + std::cos(box.yaw_rad) * bx - std::sin(box.yaw_rad) * by;
        const double y = box.y_m + std::sin(box.yaw_rad) * bx + std::cos(box.yaw_rad) * by;
        const double rx = std::cos(yaw_rad) * x + std::sin(yaw_rad) * y;
        const double ry = -std::sin(yaw_rad) * x + std::cos(yaw_rad) * y;
        const double dx = std::max({rx - 0.45, -0.415 - rx, 0.0});
        const double dy = std::max({ry - 0.35, -0.35 - ry, 0.0});
        least_m = std::min(least_m, std::hypot(dx, dy));
        inside = inside || (rx < 0.45 && rx > -0.415 && std::abs(ry) < 0.35);
      }
    const double step_m = std::hypot(box.sizes[0], box.sizes[1]) / kGrid;
    if (inside) {
      ++overlaps;
      EXPECT_LT(gap, 0) << i;
    } else if (gap < 0) {
      EXPECT_LT(least_m, step_m) << i;  // between the points of the grid
    } else {
      EXPECT_LE(gap, least_m + 1e-9) << i;
      EXPECT_GT(gap, least_m - step_m) << i;
    }
  }
  EXPECT_GT(overlaps, 200U);
}

}  // namespace
}  // namespace drover::mission
