// From a recorded track to the line that is driven: latitude and longitude are the truth, x and y
// must fit them.
#include "store/drivable.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <vector>

#include "store/placing.h"

namespace drover::store {
namespace {

std::string told_point(std::size_t index) {
  return "point " + std::to_string(index + 1);
}

std::string metres(double value) {
  char text[32];
  std::snprintf(text, sizeof text,
                value < 1      ? "%.3f m"
                : value < 1000 ? "%.2f m"
                : value < 1e6  ? "%.0f m"
                               : "%.3g m",
                value);
  return text;
}

std::string degrees(double value) {
  char text[32];
  std::snprintf(text, sizeof text, "%.4f", value);
  return text;
}

std::string told(const Track& track, const Disagreement& wrong) {
  std::string text = told_point(wrong.index) + ": x, y are " + metres(wrong.distance_m) +
                     " away from its latitude and longitude, allowed " + metres(wrong.allowed_m);
  const double longitude_deg = track.points[wrong.index].longitude_deg;
  if (std::abs(longitude_deg) <= 180)
    return text + ": were they recorded before the origin was set, or with the antenna elsewhere?";
  const double other_name_deg = longitude_deg - std::copysign(360, longitude_deg);
  return text + ": its longitude " + degrees(longitude_deg) + " is beyond 180 degrees, which is " +
         degrees(other_name_deg) + " on earth: is it right?";
}

}  // namespace

double resolution_m(const Track& track) {
  return place_step_m(track) + map_step_m(track);
}

std::optional<Disagreement> find_disagreement(const Track& track, const AntennaOffset& antenna) {
  if (!track.origin) return std::nullopt;
  const MapFrame frame(*track.origin);
  const double arm_m = std::hypot(antenna.x_m, antenna.y_m);
  const double allowed_m = kAgreement_m + std::min(resolution_m(track), kCoarsest_m);
  for (std::size_t i = 0; i < track.points.size(); ++i) {
    const TrackPoint& point = track.points[i];
    if (!has_place(point) || !on_earth(point)) continue;
    const Local place = frame.local(point.latitude_deg, point.longitude_deg);
    const bool turned = has_angle(point);
    const double off_m = turned ? better_heading(point, place, antenna).apart_m
                                : apart_m(place, {point.x_m, point.y_m});
    const double may_m = turned ? allowed_m : allowed_m + arm_m;
    if (!(off_m <= may_m)) return Disagreement{i, off_m, may_m};
  }
  return std::nullopt;
}

Result<std::unique_ptr<Path>, std::string> build_path(const Track& track,
                                                      const GeodeticPoint& origin,
                                                      const AntennaOffset& antenna,
                                                      TrackDrive drive) {
  const auto wrong = find_disagreement(track, antenna);
  if (wrong) return told(track, *wrong);
  const Placing placing(track, origin, antenna);
  auto path = std::make_unique<Path>();
  path->name = track.name;
  path->points.reserve(track.points.size());
  std::vector<double> looks_rad;
  if (drive == TrackDrive::recorded) looks_rad.reserve(track.points.size());
  for (std::size_t i = 0; i < track.points.size(); ++i) {
    const TrackPoint& point = track.points[i];
    if (has_place(point) && !on_earth(point))
      return told_point(i) + ": its latitude or longitude is no place on earth";
    const auto at = placing.at(point);
    if (!at)
      return told_point(i) + ": it has no latitude and longitude, and x, y are of no known origin";
    path->points.push_back({at->x_m, at->y_m});
    if (drive == TrackDrive::recorded) looks_rad.push_back(placing.yaw_rad(point));
  }
  set_gears(*path, looks_rad, drive);
  return std::unique_ptr<Path>(std::move(path));
}

}  // namespace drover::store
