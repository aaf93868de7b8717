#include "scene/zone/union_area.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "scene/zone/ring.h"

namespace drover::scene {
namespace {

MapPolygon rectangle(double x_m, double y_m, double width_m, double height_m) {
  return {
      {{x_m, y_m}, {x_m + width_m, y_m}, {x_m + width_m, y_m + height_m}, {x_m, y_m + height_m}},
      {}};
}
MapRing reversed(MapRing ring) {
  return {ring.rbegin(), ring.rend()};
}

TEST(UnitedArea, OfOneOrOfNoneThatOverlapIsTheirSum) {
  EXPECT_EQ(united_area_m2({}), 0);
  EXPECT_DOUBLE_EQ(united_area_m2({rectangle(0, 0, 4, 5)}), 20);
  EXPECT_NEAR(united_area_m2({rectangle(0, 0, 4, 5), rectangle(4, 0, 1, 5)}), 25, 1e-9);
}
TEST(UnitedArea, CountsOnceWhatSeveralTake) {
  EXPECT_NEAR(united_area_m2({rectangle(0, 0, 4, 4), rectangle(2, 2, 4, 4)}), 28, 1e-9);
  EXPECT_NEAR(united_area_m2({rectangle(0, 0, 4, 4), rectangle(1, 1, 2, 2)}), 16, 1e-9);
  EXPECT_NEAR(united_area_m2({rectangle(0, 0, 4, 4), rectangle(0, 0, 4, 4)}), 16, 1e-9);
  // Two triangles that cross as a star does.
  const MapPolygon up{{{0, 0}, {6, 0}, {3, 6}}, {}};
  const MapPolygon down{{{0, 4}, {3, -2}, {6, 4}}, {}};
  EXPECT_NEAR(united_area_m2({up, down}), 24, 1e-9);
}
TEST(UnitedArea, FillsAHoleOnlyWhereAnotherLies) {
  MapPolygon ring = rectangle(0, 0, 10, 10);
  ring.holes = {reversed(rectangle(2, 2, 6, 6).outer)};
  EXPECT_NEAR(united_area_m2({ring, rectangle(4, 4, 2, 20)}), 100 - 36 + 2 * 4 + 2 * 14, 1e-9);
}
TEST(UnitedArea, IsWhatCountedPointsSay) {
  std::mt19937 random(7);
  std::uniform_real_distribution<double> place(0, 10);
  std::uniform_real_distribution<double> radius(0.5, 4);
  for (int round = 0; round < 20; ++round) {
    std::vector<MapPolygon> polygons;
    for (int i = 0; i < 6; ++i) {
      MapPolygon star;  // about its middle, so that its edges do not cross
      const Point2 middle{place(random), place(random)};
      for (int k = 0; k < 9; ++k) {
        const double r_m = radius(random);
        star.outer.push_back(
            {middle.x_m + r_m * std::cos(k * 0.698), middle.y_m + r_m * std::sin(k * 0.698)});
      }
      polygons.push_back(star);
    }
    int inside = 0;
    for (int x = -80; x < 280; ++x)
      for (int y = -80; y < 280; ++y)
        inside += std::any_of(polygons.begin(), polygons.end(), [&](const MapPolygon& each) {
          return ring_contains({(x + 0.5) * 0.05, (y + 0.5) * 0.05}, each.outer);
        });
    EXPECT_NEAR(united_area_m2(polygons), inside * 0.0025, 0.6) << "round " << round;
  }
}
/// Ten thousand edges side by side: the import must not hold up who waits for it.
TEST(UnitedArea, OfTooManyEdgesSideBySideIsTheirSum) {
  MapPolygon comb{{}, {}};
  for (int i = 0; i < 4900; ++i) {
    comb.outer.push_back({i * 1.0, 0});
    comb.outer.push_back({i * 1.0 + 0.5, 100});
  }
  comb.outer.push_back({4900, -1});
  comb.outer.push_back({0, -1});
  const double alone_m2 = united_area_m2({comb});
  EXPECT_DOUBLE_EQ(united_area_m2({comb, rectangle(0, 0, 10, 10)}), alone_m2 + 100);
}

}  // namespace
}  // namespace drover::scene
