// A track prepared for driving: points in the local frame.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace drover {

/// `map` frame (ENU about the origin), metres.
struct PathPoint {
  double x_m = 0;
  double y_m = 0;
};

/// Which way the robot looks along a track.
enum class TrackDrive : std::uint8_t {
  ahead,     ///< where it drives; it turns round at a cusp
  recorded,  ///< backwards where the angles of the points say that it was recorded so
  either,    ///< as it stands at the start; at a cusp it goes on the other way, and does not turn
};

/// Built outside the control thread, read-only inside it, given back through an event.
struct Path {
  std::uint64_t number = 0;  ///< of this run, from 1: recordings name it
  std::string name;
  std::vector<PathPoint> points;  ///< in the order of the track, ids 1..N
  /// Of each segment, from its point to the next: not 0 where it is driven backwards, whichever way
  /// through the list. Empty: nowhere.
  std::vector<std::uint8_t> backwards;
  /// A robot whose back is turned to the way at the start drives all of it the other way round.
  bool either = false;
};

struct GeodeticPoint {
  double latitude_deg = 0;
  double longitude_deg = 0;
  double altitude_m = 0;  ///< above the ellipsoid
};

}  // namespace drover
