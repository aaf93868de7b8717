// Where a route is too tight for a robot that steers: it turns on curves only.
#pragma once

#include <cstddef>
#include <cstdint>

#include "track/path_geometry.h"

namespace drover::track {

struct Tight {
  enum class Kind : std::uint8_t {
    none,
    corner,  ///< it turns by `turn_rad` at once
    curve    ///< of that radius
  };
  Kind kind = Kind::none;
  std::size_t point = 0;  ///< index in the list of points
  double turn_rad = 0;
  double radius_m = 0;
};

/// The first such place after point `first` of the route. A corner by more than `sharp_rad` is one,
/// but where the robot goes on the other way and need not turn for it. A curve is seen over a
/// metre to each side, in which points that lie 1 cm beside their track do not matter; a bend that
/// is turned within is as if it were an arc of that. O(points), nothing allocates.
Tight find_tight(const Route& route, std::size_t first, double sharp_rad, double radius_m);

}  // namespace drover::track
