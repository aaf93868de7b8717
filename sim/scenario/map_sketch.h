// A map of characters: the track with whatever is put on it.
#pragma once

#include <string>
#include <vector>

#include "sim/scenario/track.h"

namespace drover::sim {

class MapSketch {
 public:
  /// North is up; the scale is the same in both directions (a character is twice as high as wide).
  explicit MapSketch(const std::vector<TrackPose>& track);
  /// `mark` is one character, of any number of bytes. Beyond the edge nothing is drawn.
  void put(const TrackPose& place, const std::string& mark);
  /// The edge of a closed polygon; of a small one the place it is at.
  void put_edge(const std::vector<TrackPose>& polygon, const std::string& mark);
  std::vector<std::string> rows() const;
  /// A bar of a round length with its length: "|--------| 5 m".
  std::string scale() const;

 private:
  double west_m_ = 0;
  double north_m_ = 0;
  double cell_m_ = 1;  ///< width of a character
  std::vector<std::vector<std::string>> cells_;
};

/// One of eight arrows.
std::string arrow(double yaw_rad);

}  // namespace drover::sim
