#include "store/placing.h"

#include "drover/measurement.h"

namespace drover::store {
namespace {

constexpr double kSmoothest_m = 0.02;  // coarser latitudes would make steps in the line

}  // namespace

Placing::Placing(const Track& track, const GeodeticPoint& origin, const AntennaOffset& antenna)
    : now_(origin),
      then_(track.origin ? std::optional<MapFrame>(*track.origin) : std::nullopt),
      same_(track.origin && holds_under(track, origin)),
      coarse_(then_ && place_step_m(track) > kSmoothest_m),
      antenna_(antenna) {}

std::optional<Local> Placing::at(const TrackPoint& point) const {
  const Local told{point.x_m, point.y_m};
  if (has_place(point) && (!then_ || (has_angle(point) && !coarse_))) {
    const Local place = now_.local(point.latitude_deg, point.longitude_deg);
    if (!then_) return base_of(place, antenna_, point.yaw_rad);
    const Local before = then_->local(point.latitude_deg, point.longitude_deg);
    return base_of(place, antenna_, better_heading(point, before, antenna_).yaw_rad);
  }
  if (!then_) return std::nullopt;
  return same_ ? told : then_->in(now_, told);
}

double Placing::yaw_rad(const TrackPoint& point) const {
  if (!has_angle(point)) return kAbsent;
  if (!then_ || !has_place(point)) return point.yaw_rad;
  const Local before = then_->local(point.latitude_deg, point.longitude_deg);
  return better_heading(point, before, antenna_).yaw_rad;
}

}  // namespace drover::store
