// Metres between two positions of a receiver that lie close together.
#pragma once

#include <cmath>

#include "drover/angle.h"
#include "drover/measurement.h"
#include "drover/path.h"

namespace drover::engine {

/// x east, y north. On a sphere: right to half a percent, for ways of metres.
inline PathPoint ground_way(const GnssPosition& from, const GnssPosition& to) {
  constexpr double kMetresPerRadian = 6371000.0;
  const double north_rad = to_rad(to.latitude_deg - from.latitude_deg);
  const double east_rad = wrap_rad(to_rad(to.longitude_deg - from.longitude_deg));
  return {east_rad * kMetresPerRadian * std::cos(to_rad(to.latitude_deg)),
          north_rad * kMetresPerRadian};
}

}  // namespace drover::engine
