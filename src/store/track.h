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
  /// The points' numbers as they were spelled, as PointTexts reads them. Empty: as PointTexts
  /// spells them.
  std::string numbers{};
};

inline constexpr std::size_t kMaxTracks = 1000;
/// More than the largest command can carry.
inline constexpr std::size_t kMaxPointsPerTrack = 40'000;
/// Of all tracks together, as one list (trajectory_data). Broker and client need three times as
/// much memory to carry it, and an operator may ask for it at any time.
inline constexpr std::size_t kMaxListBytes = std::size_t{6} << 20;

}  // namespace drover::store
