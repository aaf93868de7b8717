// Rings as plane figures: in degrees that are scaled to metres.
#pragma once

#include <cstddef>
#include <optional>
#include <vector>

#include "scene/plane/point.h"
#include "scene/zone/zone.h"

namespace drover::scene {

/// One degree of latitude on a sphere of the earth's mean radius (6371008.8 m): for sizes, never
/// for places.
inline constexpr double kMetresPerDegree = 111'195.08;

/// About `zero`, east and north. Straight edges in degrees stay straight.
Point2 flat(const GeoPoint& point, const GeoPoint& zero);
std::vector<Point2> flat(const GeoRing& ring, const GeoPoint& zero);

/// Positive when counter-clockwise.
double signed_area_m2(const std::vector<Point2>& ring);

/// Even-odd; for a point on an edge either answer.
bool ring_contains(const Point2& point, const std::vector<Point2>& ring);

/// Two edges that have a point in common though they are no neighbours, or that fold back; the one
/// that comes first in its file is first.
struct Crossing {
  std::size_t ring = 0;  ///< 0 the outer ring, then the holes
  std::size_t point = 0;
  std::size_t other_ring = 0;
  std::size_t other_point = 0;
};

/// Each edge begins at the point that names it. Repeated points are passed over. Pairs are looked
/// at in the order of x: n^2 / 2 at worst.
std::optional<Crossing> find_crossing(const std::vector<std::vector<Point2>>& rings);

}  // namespace drover::scene
