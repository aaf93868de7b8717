// Tracks in the frame of the origin that is in force now.
#pragma once

#include <memory>
#include <optional>

#include "drover/path.h"
#include "store/track.h"

namespace drover::store {

/// Where the receiver's reference point is in base_link (REP 103: x ahead, y left), metres:
/// latitude and longitude of a recorded point are the antenna's, x and y are base_link's.
struct AntennaOffset {
  double x_m = 0;
  double y_m = 0;
};

/// True when x and y hold as they were saved: the track was saved under this very origin.
bool holds_under(const Track& track, const std::optional<GeodeticPoint>& origin);

/// The track with x and y for `origin`: as saved where they hold, otherwise from latitude and
/// longitude (and yaw, for the antenna's offset). yaw and z stay as saved. Without an origin the
/// track is returned as saved. Impossible latitudes give NaN.
Track derive(const Track& track, const std::optional<GeodeticPoint>& origin,
             const AntennaOffset& antenna = {});

/// The polyline to drive, in the frame of `origin`. It shares nothing with the track.
std::unique_ptr<Path> build_path(const Track& track, const GeodeticPoint& origin,
                                 const AntennaOffset& antenna = {});

}  // namespace drover::store
