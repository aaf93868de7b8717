// Of a path the part about a place on it, in the order of travel.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

#include "drover/path.h"
#include "drover/viewpoint.h"
#include "scene/plane/point.h"

namespace drover::scene {

inline Point2 point_of(const Path& path, std::size_t i) {
  return {path.points[i].x_m, path.points[i].y_m};
}

struct WayLine {
  std::vector<Point2> points;
  std::vector<std::uint8_t> backwards;  ///< of each segment: it is driven so; empty: none is
  double from_m = 0;                    ///< the place, as arc length of these points
  bool ends = true;                     ///< the last one is the target
  WayLeft way;                          ///< of the place
  std::size_t first = 0;                ///< index in the path of the first one

  Point2 place() const;
  /// The same way, so much farther along it; not beyond its last point.
  WayLeft farther(double by_m) const;
};

/// Some way behind the place, for what bends the line there, and at least `ahead_m` ahead of it.
/// Nothing when there is no such place on the path.
std::optional<WayLine> line_about(const Path& path, const WayLeft& way, double ahead_m);

}  // namespace drover::scene
