// Tracks made of shapes, as an operator would have recorded them.
#pragma once

#include <string>
#include <vector>

namespace drover::sim {

/// Of base_link in the simulator's frame (x east, y north, yaw counter-clockwise from east).
struct TrackPose {
  double x_m = 0;
  double y_m = 0;
  double yaw_rad = 0;
};

/// A straight when `straight_m` is above 0, otherwise a turn; left is positive. A turn of radius 0
/// is a corner: it adds no point. Backwards the robot keeps its yaw on a straight, and turns left
/// (yaw grows) for a positive turn, as ahead.
struct Shape {
  double straight_m = 0;
  double turn_rad = 0;
  double radius_m = 0;
  bool backwards = false;
};

/// The shapes from `start` on, one point each 0.5 m driven, the first at `start` and the last at
/// the end of the last shape.
std::vector<TrackPose> make_track(const TrackPose& start, const std::vector<Shape>& shapes);

/// Where the antenna sits in base_link.
struct Antenna {
  double x_m = 0;
  double y_m = 0;
};

struct Origin {
  double latitude_deg = 0;
  double longitude_deg = 0;
  double altitude_m = 0;
};

/// What base_status said at one instant: pose in the robot's `map`, position of its antenna.
struct Fix {
  double x_m = 0;
  double y_m = 0;
  double yaw_rad = 0;
  double latitude_deg = 0;
  double longitude_deg = 0;
};

/// Shift from the simulator's frame to the robot's `map`, whose origin is the robot's own choice.
TrackPose map_shift(const Fix& fix, const Origin& origin, const Antenna& antenna);

/// The text of a save_trajectory message (RTK navigation protocol) with the track as base_status
/// would have shown it: longitude, latitude of the antenna; x, y of base_link in `map`; yaw; angle
/// clockwise from north.
std::string save_message(const std::string& name, const std::vector<TrackPose>& track,
                         const TrackPose& shift, const Origin& origin, const Antenna& antenna);

/// Walks along a polyline and says how far beside it a position is. It looks near where it was
/// last, so a track may cross itself or come back beside itself.
class CrossTrack {
 public:
  explicit CrossTrack(const std::vector<TrackPose>& track) : track_(&track) {}
  /// Metres, never negative.
  double distance_m(double x_m, double y_m);

 private:
  const std::vector<TrackPose>* track_;
  std::size_t segment_ = 0;
  bool found_ = false;
};

}  // namespace drover::sim
