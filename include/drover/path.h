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

/// Built outside the control thread, read-only inside it, given back through an event.
struct Path {
  std::uint64_t number = 0;  ///< of this run, from 1: recordings name it
  std::string name;
  std::vector<PathPoint> points;  ///< in the order of the track, ids 1..N
  /// Of each segment, from its point to the next: not 0 where it is driven backwards, whichever way
  /// through the list. Empty: nowhere.
  std::vector<std::uint8_t> backwards;
  /// Nobody asked for either: who stands with his back to the way drives all of it the other way
  /// round.
  bool either = false;
};

struct GeodeticPoint {
  double latitude_deg = 0;
  double longitude_deg = 0;
  double altitude_m = 0;  ///< above the ellipsoid
};

}  // namespace drover
