#include "scene/zone/ring.h"

#include <gtest/gtest.h>

#include <array>
#include <cstdlib>
#include <random>

namespace drover::scene {
namespace {

using Ring = std::vector<Point2>;

/// By whole numbers, each pair of edges, in no order.
struct Witness {
  std::vector<std::array<int, 4>> edges;  ///< x, y to x, y; none of no length

  explicit Witness(const Ring& ring) {
    for (std::size_t i = 0; i < ring.size(); ++i) {
      const Point2& a = ring[i];
      const Point2& b = ring[(i + 1) % ring.size()];
      const std::array<int, 4> edge = {static_cast<int>(a.x_m), static_cast<int>(a.y_m),
                                       static_cast<int>(b.x_m), static_cast<int>(b.y_m)};
      if (edge[0] != edge[2] || edge[1] != edge[3]) edges.push_back(edge);
    }
  }
  static int side(const std::array<int, 4>& e, int x, int y) {
    const int twice = (e[2] - e[0]) * (y - e[1]) - (e[3] - e[1]) * (x - e[0]);
    return (twice > 0) - (twice < 0);
  }
  static bool is_on(const std::array<int, 4>& e, int x, int y) {
    return side(e, x, y) == 0 && (x - e[0]) * (x - e[2]) <= 0 && (y - e[1]) * (y - e[3]) <= 0;
  }
  static bool meet(const std::array<int, 4>& e, const std::array<int, 4>& f) {
    return (side(e, f[0], f[1]) * side(e, f[2], f[3]) < 0 &&
            side(f, e[0], e[1]) * side(f, e[2], e[3]) < 0) ||
           is_on(e, f[0], f[1]) || is_on(e, f[2], f[3]) || is_on(f, e[0], e[1]) ||
           is_on(f, e[2], e[3]);
  }
  bool is_bad() const {
    const std::size_t n = edges.size();
    for (std::size_t i = 0; i < n; ++i) {
      const auto& e = edges[i];
      const auto& next = edges[(i + 1) % n];
      // Neighbours have their corner in common, and no other end.
      if (is_on(e, next[2], next[3]) || is_on(next, e[0], e[1])) return true;
      for (std::size_t j = i + 2; j < n; ++j)
        if ((j + 1) % n != i && meet(e, edges[j])) return true;
    }
    return false;
  }
};

TEST(Ring, CrossingsAreThoseOfAWitnessThatCountsInWholeNumbers) {
  std::mt19937 random(7);
  int good = 0;
  int bad = 0;
  for (int i = 0; i < 40'000; ++i) {
    Ring ring;
    const int points = 3 + static_cast<int>(random() % 6);
    for (int k = 0; k < points; ++k) {
      ring.push_back({static_cast<double>(random() % 7), static_cast<double>(random() % 7)});
      if (random() % 8 == 0) ring.push_back(ring.back());
    }
    const Witness witness(ring);
    if (witness.edges.size() < 3) continue;
    ASSERT_EQ(find_crossing({ring}).has_value(), witness.is_bad()) << i;
    ++(witness.is_bad() ? bad : good);
  }
  EXPECT_GT(good, 4'000);
  EXPECT_GT(bad, 4'000);
}
TEST(Ring, EdgesOfTwoRingsMayNotMeetAtAll) {
  const Ring outer = {{0, 0}, {10, 0}, {10, 10}, {0, 10}};
  EXPECT_FALSE(find_crossing({outer, {{1, 1}, {2, 1}, {2, 2}}}));
  const auto corner = find_crossing({outer, {{0, 0}, {2, 1}, {2, 2}}});
  ASSERT_TRUE(corner);
  EXPECT_EQ(corner->ring, 0U);
  EXPECT_EQ(corner->other_ring, 1U);
  EXPECT_TRUE(find_crossing({outer, {{10, 5}, {9, 4}, {9, 6}}}));
  EXPECT_TRUE(find_crossing({outer, outer}));
}
TEST(Ring, AreaIsPositiveCounterClockwise) {
  EXPECT_DOUBLE_EQ(signed_area_m2({{0, 0}, {2, 0}, {2, 3}}), 3);
  EXPECT_DOUBLE_EQ(signed_area_m2({{2, 3}, {2, 0}, {0, 0}}), -3);
}
TEST(Ring, ContainsWhatIsInsideAlsoWhenItIsConcave) {
  const Ring u = {{0, 0}, {3, 0}, {3, 3}, {2, 3}, {2, 1}, {1, 1}, {1, 3}, {0, 3}};
  EXPECT_TRUE(ring_contains({0.5, 2}, u));
  EXPECT_TRUE(ring_contains({2.5, 1}, u)) << "at the height of corners";
  EXPECT_FALSE(ring_contains({1.5, 2}, u));
  EXPECT_FALSE(ring_contains({-1, 1}, u));
  EXPECT_FALSE(ring_contains({4, 3}, u));
}
TEST(Ring, IsAsLargeInDegreesAsOnTheGround) {
  const GeoPoint zero{60, 10};
  const Point2 there = flat({60.001, 10.001}, zero);
  EXPECT_NEAR(there.y_m, 111.2, 0.1);
  EXPECT_NEAR(there.x_m, 55.6, 0.1);
}

}  // namespace
}  // namespace drover::scene
