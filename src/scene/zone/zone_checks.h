// What a zone has to be, so that inside and outside are never in doubt.
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "scene/message/refusal.h"
#include "scene/zone/zone.h"

namespace drover::scene {

/// The first thing that is wrong with polygons, and where.
struct ZoneFault {
  std::optional<std::size_t> polygon{};
  std::optional<std::size_t> ring{};   ///< 0 the outer ring, then the holes
  std::optional<std::size_t> point{};  ///< of the ring
  std::string why;                     ///< what is wrong and what is allowed
  /// Like `polygons[0].holes[1].points[7]`.
  std::string path() const;
};

/// Nothing when they are good. Found: no number, out of range, fewer than three different points,
/// no area, edges that cross or touch (also of two rings of one polygon), a hole outside, too many
/// points, too large. Bounded: at most 50 million pairs of edges are looked at.
std::optional<ZoneFault> find_fault(const std::vector<GeoPolygon>& polygons);

/// As find_fault, and the name.
std::optional<Refusal> check_zone(const Zone& zone);

/// Nothing when `added` fits beside `stored`, of which one of the same name is replaced.
std::optional<Refusal> check_room(const std::vector<Zone>& stored, const Zone& added);

}  // namespace drover::scene
