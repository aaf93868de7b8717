// What a track's numbers say of a place, and places in the frame of an origin.
#pragma once

#include <GeographicLib/LocalCartesian.hpp>
#include <cmath>

#include "drover/path.h"
#include "store/derive.h"
#include "store/track.h"

namespace drover::store {

struct Local {
  double x_m = 0;
  double y_m = 0;
};

inline double apart_m(Local a, Local b) {
  return std::hypot(a.x_m - b.x_m, a.y_m - b.y_m);
}

/// A map frame. A track knows no height above the ellipsoid; the origin's own is right to
/// centimetres in x, y.
class MapFrame {
 public:
  explicit MapFrame(const GeodeticPoint& origin)
      : altitude_m_(origin.altitude_m),
        frame_(origin.latitude_deg, origin.longitude_deg, origin.altitude_m) {}

  Local local(double latitude_deg, double longitude_deg) const {
    Local at;
    double up_m = 0;
    frame_.Forward(latitude_deg, longitude_deg, altitude_m_, at.x_m, at.y_m, up_m);
    return at;
  }
  /// The same place in another frame.
  Local in(const MapFrame& other, Local at) const {
    double latitude_deg = 0;
    double longitude_deg = 0;
    double height_m = 0;
    frame_.Reverse(at.x_m, at.y_m, 0, latitude_deg, longitude_deg, height_m);
    return other.local(latitude_deg, longitude_deg);
  }

 private:
  double altitude_m_;
  GeographicLib::LocalCartesian frame_;
};

/// Of base_link, whose antenna is there.
Local base_of(Local antenna, const AntennaOffset& arm, double yaw_rad);

inline bool has_place(const TrackPoint& point) {
  return point.latitude_deg != 0 || point.longitude_deg != 0;
}
inline bool has_angle(const TrackPoint& point) {
  return point.yaw_rad != 0 || point.angle_deg != 0;
}
inline bool on_earth(const TrackPoint& point) {
  return std::abs(point.latitude_deg) <= 90 && std::abs(point.longitude_deg) <= 360;
}

struct Heading {
  double yaw_rad = 0;
  double apart_m = 0;  ///< of x, y from the base's place under this yaw
};

/// Clients fill in yaw, angle or both, and not all of them consistently: the one that explains x,
/// y.
Heading better_heading(const TrackPoint& point, Local antenna, const AntennaOffset& arm);

/// One unit of the last digit of latitude and longitude together, in metres on the ground; the
/// point with the most digits tells.
double place_step_m(const Track& track);
/// Likewise of x and y.
double map_step_m(const Track& track);

}  // namespace drover::store
