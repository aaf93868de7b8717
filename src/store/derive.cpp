// Tracks in the frame of the origin that is in force now.
#include "store/derive.h"

#include <GeographicLib/LocalCartesian.hpp>
#include <cmath>

#include "store/point_texts.h"

namespace drover::store {
bool holds_under(const Track& track, const std::optional<GeodeticPoint>& origin) {
  if (!origin) return true;
  return track.origin && track.origin->latitude_deg == origin->latitude_deg &&
         track.origin->longitude_deg == origin->longitude_deg;
}

Track derive(const Track& track, const std::optional<GeodeticPoint>& origin,
             const AntennaOffset& antenna) {
  Track derived = track;
  if (holds_under(track, origin)) return derived;
  derived.origin = origin;
  derived.numbers.clear();
  PointTexts texts(track);
  PointText text;
  const GeographicLib::LocalCartesian frame(origin->latitude_deg, origin->longitude_deg,
                                            origin->altitude_m);
  for (TrackPoint& point : derived.points) {
    double up_m = 0;
    // A track knows no height above the ellipsoid; the origin's own is right to centimetres in x,
    // y.
    frame.Forward(point.latitude_deg, point.longitude_deg, origin->altitude_m, point.x_m, point.y_m,
                  up_m);
    const double c = std::cos(point.yaw_rad);
    const double s = std::sin(point.yaw_rad);
    point.x_m -= c * antenna.x_m - s * antenna.y_m;
    point.y_m -= s * antenna.x_m + c * antenna.y_m;
    texts.next(text);
    const std::string x = place_text(point.x_m);
    const std::string y = place_text(point.y_m);
    text[kX] = x;
    text[kY] = y;
    append_point(derived.numbers, text);
  }
  return derived;
}

}  // namespace drover::store
