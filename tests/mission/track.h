// The track that the operator saved, in the simulator's frame, and how far beside it something is.
#pragma once

#include <GeographicLib/LocalCartesian.hpp>
#include <cmath>
#include <nlohmann/json.hpp>
#include <vector>

namespace drover::mission {

struct Place {
  double x_m = 0;
  double y_m = 0;
};
inline double distance_m(const Place& a, const Place& b) {
  return std::hypot(a.x_m - b.x_m, a.y_m - b.y_m);
}

/// Where on the earth the simulator's frame lies and where the antenna sits in base_link.
class Earth final {
 public:
  /// From a scenario's document, robot included. Throws when origin or antenna is missing.
  explicit Earth(const nlohmann::json& scenario);
  /// Of base_link, from the antenna's position and base_link's yaw.
  Place base(double latitude_deg, double longitude_deg, double yaw_rad) const;

 private:
  GeographicLib::LocalCartesian frame_;
  double altitude_m_ = 0;
  double antenna_x_m_ = 0;
  double antenna_y_m_ = 0;
};

/// Points of a save_trajectory message, from latitude and longitude: x and y are the robot's own.
std::vector<Place> read_track(const nlohmann::json& save_message, const Earth& earth);

/// Walks along the track with the robot, so that a track may cross itself.
class Beside final {
 public:
  explicit Beside(const std::vector<Place>& track) : track_(&track) {}
  /// Metres, never negative; looks at most 2 m along the track from where it was last.
  double distance_m(const Place& place);

 private:
  const std::vector<Place>* track_;
  std::size_t segment_ = 0;
  bool found_ = false;
};

}  // namespace drover::mission
