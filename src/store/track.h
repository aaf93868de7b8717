// A recorded track as the operator's program sent it.
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "drover/path.h"

namespace drover::store {

/// All numbers are kept as they came, whether they make sense or not (the protocol's own example
/// has a longitude of 188.2): what cannot be driven is refused at start.
struct TrackPoint {
  double longitude_deg = 0;
  double latitude_deg = 0;
  double angle_deg = 0;  ///< in the convention that was configured when it was recorded
  double x_m = 0;        ///< `map` frame of `Track::origin`
  double y_m = 0;
  double yaw_rad = 0;
  double z_m = 0;
};

struct Track {
  std::string name;  ///< any text, byte for byte
  std::vector<TrackPoint> points;
  std::optional<GeodeticPoint> origin;  ///< in force when it was saved; absent when there was none
};

inline constexpr std::size_t kMaxTracks = 1000;
inline constexpr std::size_t kMaxPointsPerTrack = 100'000;
/// Of all tracks together: 28 MB in memory.
inline constexpr std::size_t kMaxPoints = 500'000;

}  // namespace drover::store
