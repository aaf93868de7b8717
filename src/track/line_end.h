// How a recorded line ends.
#pragma once

#include <cstddef>
#include <optional>

#include "track/path_geometry.h"

namespace drover::track {

struct LineEnd {
  Vector point;                ///< near the last point recorded
  Vector ahead{1, 0};          ///< direction of travel there
  double curvature_radpm = 0;  ///< there, counter-clockwise positive
};

/// From the longest last piece of the route, 1 to 4 m and after its point `first`, that is an arc
/// but for 1.4 cm (rms), else 3: the noise of recording turns a chord of a quarter of a metre by
/// degrees, and in a bend every chord is behind. None: there is no such piece. Costs a walk over
/// its points.
std::optional<LineEnd> line_end(const Route& route, std::size_t first);

}  // namespace drover::track
