// Tracks in the frame of the origin that is in force now.
#pragma once

#include <optional>

#include "drover/heading.h"
#include "drover/path.h"
#include "store/track.h"

namespace drover::store {

/// Where the receiver's reference point is in base_link (REP 103: x ahead, y left), metres:
/// latitude and longitude of a recorded point are the antenna's, x and y are base_link's. `heading`
/// is how a point's angle counts.
struct AntennaOffset {
  double x_m = 0;
  double y_m = 0;
  HeadingConvention heading = HeadingConvention::clockwise_from_north;
};

/// True when x and y hold as they were saved: the track was saved under this very origin.
bool holds_under(const Track& track, const std::optional<GeodeticPoint>& origin);

/// The track with x and y for `origin`: as saved where they hold, otherwise of the place that is
/// driven (see Placing). yaw and z stay as saved. Without an origin the track is returned as saved.
Track derive(const Track& track, const std::optional<GeodeticPoint>& origin,
             const AntennaOffset& antenna = {});

}  // namespace drover::store
