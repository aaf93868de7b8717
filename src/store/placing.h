// Where a track's points are in the frame of the origin that is in force.
#pragma once

#include <optional>

#include "store/map_frame.h"

namespace drover::store {

/// Points come from latitude and longitude; from x and y where those are absent, have no angle to
/// take the antenna's arm off by, or are coarser than 2 cm.
class Placing final {
 public:
  /// `track` must outlive it.
  Placing(const Track& track, const GeodeticPoint& origin, const AntennaOffset& antenna);

  /// base_link's place. Nothing: it has no latitude and longitude, and x, y are of no known origin.
  std::optional<Local> at(const TrackPoint& point) const;
  /// How the base looked there; not a number when the point does not tell.
  double yaw_rad(const TrackPoint& point) const;

 private:
  MapFrame now_;
  std::optional<MapFrame> then_;  ///< that the track was saved under
  bool same_;                     ///< both are
  bool coarse_;
  AntennaOffset antenna_;
};

}  // namespace drover::store
