// What a convex body with corners takes of the plane between two heights.
#pragma once

#include <array>
#include <cstddef>
#include <vector>

#include "drover/measurement.h"
#include "scene/plane/areas.h"

namespace drover::scene {

/// A convex body in `map`, metres: its corners and, by their indices, at least its edges.
struct Polyhedron {
  std::vector<Vector3> corners_m;
  std::vector<std::array<std::size_t, 2>> edges;
};

/// The interval is one: low < high. What is to be cut by another one takes everything.
bool is_interval(Heights heights);

/// A body between these two has nothing of the interval, or only touches it.
bool misses(double lowest_m, double highest_m, Heights heights);

/// Where an edge that crosses a height does so. The same to the bit for both directions of it.
Point2 crossing(const Vector3& a, const Vector3& b, double height_m);

/// Exact: all points of the body between the heights, seen from above, are the convex hull of its
/// corners there and of where its edges cross the two heights. Nothing: an empty area.
Area area_between(const Polyhedron& body, Heights heights);

}  // namespace drover::scene
