#include "scene/world/map_change.h"

#include <GeographicLib/LocalCartesian.hpp>
#include <cmath>
#include <vector>

#include "drover/angle.h"
#include "drover/rotation.h"

namespace drover::scene {
namespace {

using GeographicLib::LocalCartesian;

LocalCartesian map_about(const GeodeticPoint& origin) {
  return {origin.latitude_deg, origin.longitude_deg, origin.altitude_m};
}

/// How far east at this place is turned from the map's x, from the rotation that GeographicLib
/// gives row by row.
double east_rad(const std::vector<double>& rotation) {
  return std::atan2(rotation[3], rotation[0]);
}

/// Nearly a quarter of the way around the earth: from there on places come nearer again in the map,
/// and the other side of it would be here.
constexpr double kBelowTheHorizon_m = -6e6;
constexpr double kFar_m = 1e7;

void keep_far(Pose2& pose) {
  const double way_m = std::hypot(pose.x_m, pose.y_m);
  const double factor = way_m > 0 ? kFar_m / way_m : 0;
  pose.x_m = way_m > 0 ? pose.x_m * factor : kFar_m;
  pose.y_m *= factor;
}

}  // namespace

bool is_origin(const GeodeticPoint& origin) {
  return std::abs(origin.latitude_deg) <= 90 && std::abs(origin.longitude_deg) <= 360 &&
         std::isfinite(origin.altitude_m);
}

bool same_origin(const GeodeticPoint& a, const GeodeticPoint& b) {
  return a.latitude_deg == b.latitude_deg && a.longitude_deg == b.longitude_deg &&
         a.altitude_m == b.altitude_m;
}

Pose2 moved(const Pose2& pose, const GeodeticPoint& from, const GeodeticPoint& to) {
  if (same_origin(from, to)) return pose;
  const LocalCartesian old_map = map_about(from);
  const LocalCartesian new_map = map_about(to);
  std::vector<double> rotation(9);
  GeodeticPoint place;
  // The ground bends away from the map's plane: the second turn finds what is upright above it.
  double up_m = 0;
  for (int turn = 0; turn < 2; ++turn) {
    old_map.Reverse(pose.x_m, pose.y_m, up_m, place.latitude_deg, place.longitude_deg,
                    place.altitude_m, rotation);
    up_m -= place.altitude_m - from.altitude_m;
  }
  const double old_east_rad = east_rad(rotation);
  Pose2 there;
  new_map.Forward(place.latitude_deg, place.longitude_deg, to.altitude_m, there.x_m, there.y_m,
                  up_m, rotation);
  if (up_m < kBelowTheHorizon_m) keep_far(there);
  there.yaw_rad = wrap_rad(pose.yaw_rad + east_rad(rotation) - old_east_rad);
  return there;
}

Pose moved(const Pose& pose, const GeodeticPoint& from, const GeodeticPoint& to) {
  if (same_origin(from, to)) return pose;
  const Pose2 there = moved(Pose2{pose.position_m.x, pose.position_m.y, 0}, from, to);
  return {{there.x_m, there.y_m, pose.position_m.z}, about_z(there.yaw_rad) * pose.orientation};
}

}  // namespace drover::scene
