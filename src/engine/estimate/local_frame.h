// Between geodetic coordinates and the local `map` frame (east, north about the origin).
#pragma once

#include <GeographicLib/LocalCartesian.hpp>

#include "drover/path.h"

namespace drover::engine::estimate {

class LocalFrame final {
 public:
  void set_origin(const GeodeticPoint& origin);
  bool has_origin() const { return has_origin_; }
  const GeodeticPoint& origin() const { return origin_; }
  /// An altitude that is absent or absurd counts as the origin's; at robot distances it hardly
  /// matters (10 m of it shift a point 1 km away by 1.6 mm). Absent numbers without an origin.
  PathPoint local(const GeodeticPoint& point) const;
  /// At `altitude_m` above the ellipsoid. Absent numbers without an origin.
  GeodeticPoint geodetic(const PathPoint& point, double altitude_m) const;

 private:
  GeographicLib::LocalCartesian frame_;
  GeodeticPoint origin_;
  bool has_origin_ = false;
};

}  // namespace drover::engine::estimate
