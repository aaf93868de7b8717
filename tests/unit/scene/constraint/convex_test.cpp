// Whether bodies meet, against a judge of another kind: separating axes, all of them tried.
#include "scene/constraint/convex.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>

#include "drover/rotation.h"
#include "scene/constraint/region.h"
#include "unit/scene/world/yard.h"

namespace drover::scene {
namespace {

using Meeting = Separation::Meeting;
using Points = std::vector<Vector3>;

Convex hull(const Points& points, const Pose& pose = {}) {
  return {std::span<const Vector3>(points), pose};
}

/// How far the two are apart along this axis; negative: they overlap by it.
double gap_m(const Points& a, const Points& b, const Vector3& axis) {
  const double n = length(axis);
  if (n < 1e-9) return -1e9;
  const auto along = [&](const Vector3& p) { return dot(p, axis) / n; };
  const auto [a_low, a_high] = std::ranges::minmax(a, {}, along);
  const auto [b_low, b_high] = std::ranges::minmax(b, {}, along);
  return std::max(along(b_low) - along(a_high), along(a_low) - along(b_high));
}

/// Exact for bodies with a volume: a plane between two polytopes leans on a face of one or on an
/// edge of each.
double widest_gap_m(const Points& a, const Points& b) {
  double widest_m = -1e9;
  const auto try_axis = [&](const Vector3& axis) {
    widest_m = std::max(widest_m, gap_m(a, b, axis));
  };
  const auto edges_of = [](const Points& points) {
    Points edges;
    for (std::size_t i = 0; i < points.size(); ++i)
      for (std::size_t j = 0; j < i; ++j) edges.push_back(points[i] - points[j]);
    return edges;
  };
  const Points of_a = edges_of(a);
  const Points of_b = edges_of(b);
  for (const Points* edges : {&of_a, &of_b})
    for (const Vector3& e : *edges)
      for (const Vector3& f : *edges) try_axis(cross(e, f));
  for (const Vector3& e : of_a)
    for (const Vector3& f : of_b) try_axis(cross(e, f));
  return widest_m;
}

Points random_points(std::mt19937& random, double at_m, bool on_grid) {
  std::uniform_real_distribution<double> within(-1, 1);
  Points points(5);
  for (Vector3& p : points) {
    p = {within(random), within(random), within(random)};
    if (on_grid) p = {std::round(p.x * 2) / 2, std::round(p.y * 2) / 2, std::round(p.z * 2) / 2};
    p.x += at_m;
  }
  return points;
}

TEST(Convex, IsNeverTakenForApartWhenItMeetsAndNeverForTogetherWhenItDoesNot) {
  std::mt19937 random(7);
  int together = 0;
  int apart = 0;
  int undecided = 0;
  for (int i = 0; i < 3000; ++i) {
    const bool on_grid = i % 3 == 0;
    const Points a = random_points(random, 0, on_grid);
    const Points b = random_points(random, (i % 7) * 0.25, on_grid);
    const double widest_m = widest_gap_m(a, b);
    const Separation found = separation(hull(a), hull(b));
    together += found.meeting == Meeting::together ? 1 : 0;
    apart += found.meeting == Meeting::apart ? 1 : 0;
    undecided += found.meeting == Meeting::undecided ? 1 : 0;
    // Flat ones have no faces all around: only the first holds for them.
    if (widest_m > 1e-5) {
      EXPECT_NE(found.meeting, Meeting::together) << i;
    }
    if (!on_grid && widest_m > 1e-5) {
      EXPECT_EQ(found.meeting, Meeting::apart) << i;
      EXPECT_LE(found.at_least_m, widest_m * 1.8 + 1e-9) << i;  // a corner to a corner is farther
      EXPECT_GE(found.at_least_m, 0.985 * widest_m) << i;
    }
    if (!on_grid && widest_m < -1e-5) {
      EXPECT_EQ(found.meeting, Meeting::together) << i;
    }
  }
  EXPECT_GT(together, 500);
  EXPECT_GT(apart, 500);
  EXPECT_LT(undecided, 30);
}

TEST(Convex, FarFromTheOriginTheSameIsFound) {
  std::mt19937 random(8);
  for (int i = 0; i < 500; ++i) {
    Points a = random_points(random, 0, false);
    Points b = random_points(random, 1.2, false);
    const double widest_m = widest_gap_m(a, b);
    if (std::abs(widest_m) < 1e-4) continue;
    for (Points* points : {&a, &b})
      for (Vector3& p : *points) p = p + Vector3{80'000, -90'000, 3};
    EXPECT_EQ(separation(hull(a), hull(b)).meeting,
              widest_m > 0 ? Meeting::apart : Meeting::together)
        << i << " " << widest_m;
  }
}

TEST(Convex, APointIsAsFarFromAShapeAsTheFormulaSays) {
  std::mt19937 random(9);
  std::uniform_real_distribution<double> within(-2, 2);
  for (const auto& [type, dimensions] :
       {std::pair{SolidPrimitive::BOX, std::vector<double>{1, 2, 3}},
        {SolidPrimitive::SPHERE, {0.9}},
        {SolidPrimitive::CYLINDER, {1.5, 0.6}},
        {SolidPrimitive::CONE, {1.5, 0.8}}}) {
    SolidPrimitive shape;
    shape.type = type;
    shape.dimensions = dimensions;
    int inside = 0;
    for (int i = 0; i < 1000; ++i) {
      const Points point{{within(random), within(random), within(random)}};
      const double expected_m = outside_m(shape, point[0]);
      const Separation found = separation({&shape, {}}, hull(point));
      if (expected_m == 0) {
        ++inside;
        EXPECT_NE(found.meeting, Meeting::apart) << int(type);
      } else if (expected_m > 1e-5) {
        EXPECT_EQ(found.meeting, Meeting::apart) << int(type);
        EXPECT_LE(found.at_least_m, expected_m * (1 + 1e-9));
        EXPECT_GE(found.at_least_m, expected_m * 0.985) << int(type);
      }
    }
    EXPECT_GT(inside, 10) << int(type);
  }
}

TEST(Convex, OfWhatIsNoNumberNothingIsDecided) {
  const Points point{{0, 0, 0}};
  SolidPrimitive shape;
  shape.type = SolidPrimitive::SPHERE;
  for (const std::vector<double>& dimensions :
       {std::vector<double>{}, std::vector<double>{kAbsent}}) {
    shape.dimensions = dimensions;
    EXPECT_EQ(separation({&shape, {}}, hull(point)).meeting, Meeting::undecided);
  }
  shape.type = 77;
  EXPECT_EQ(separation({&shape, {}}, hull(point)).meeting, Meeting::undecided);
  EXPECT_EQ(separation(hull({}), hull(point)).meeting, Meeting::undecided);
  const Points bad{{1, 1, 1}, {1, kAbsent, 0}, {2, 1, 1}};
  EXPECT_EQ(separation(hull(bad), hull(point)).meeting, Meeting::undecided);
}

}  // namespace
}  // namespace drover::scene
