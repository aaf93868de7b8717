// Tracks in the frame of the origin that is in force now.
#include "store/derive.h"

#include "store/placing.h"
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
  const Placing placing(track, *origin, antenna);
  for (TrackPoint& point : derived.points) {
    texts.next(text);
    // Of a place that nobody knows the numbers stay as they came.
    if (const auto at = placing.at(point)) {
      point.x_m = at->x_m;
      point.y_m = at->y_m;
    }
    const std::string x = place_text(point.x_m);
    const std::string y = place_text(point.y_m);
    text[kX] = x;
    text[kY] = y;
    append_point(derived.numbers, text);
  }
  return derived;
}

}  // namespace drover::store
