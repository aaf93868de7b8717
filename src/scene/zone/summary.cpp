// What a person is told of a zone at its import, so that a fence in the wrong place is seen.
#include "scene/zone/summary.h"

#include <GeographicLib/Geodesic.hpp>
#include <GeographicLib/LocalCartesian.hpp>
#include <cmath>
#include <utility>

#include "drover/angle.h"
#include "scene/world/map_change.h"
#include "scene/zone/project.h"
#include "scene/zone/union_area.h"
#include "text/number.h"

namespace drover::scene {
namespace {

using text::number_text;

/// Farther away is most likely a mistake.
constexpr double kElsewhere_m = 20'000;
/// Less is no shift of a fence.
constexpr double kSeen_m = 0.01;

std::string distance_text(double distance_m) {
  if (distance_m >= 10'000) return number_text(std::round(distance_m / 1000)) + " km";
  return number_text(std::round(distance_m * 100) / 100) + " m";
}

std::string centimetres_text(double length_m) {
  return number_text(std::round(length_m * 100) / 100);
}

Nearest from_place(const std::vector<GeoPolygon>& polygons, const GeodeticPoint& place) {
  const auto near = project(polygons, place);
  if (!near.empty()) return nearest(near, {0, 0});
  const GeoPoint& corner = polygons.front().outer.front();
  double distance_m = 0;
  double azimuth_deg = 0;
  double azimuth_there_deg = 0;
  GeographicLib::Geodesic::WGS84().Inverse(place.latitude_deg, place.longitude_deg,
                                           corner.latitude_deg, corner.longitude_deg, distance_m,
                                           azimuth_deg, azimuth_there_deg);
  if (azimuth_deg < 0) azimuth_deg += 360;
  return {distance_m, to_rad(azimuth_deg)};
}

/// Empty when a swapped point would be none.
std::vector<GeoPolygon> swapped(std::vector<GeoPolygon> polygons) {
  for (GeoPolygon& polygon : polygons) {
    for (GeoPoint& point : polygon.outer) {
      std::swap(point.latitude_deg, point.longitude_deg);
      if (std::abs(point.latitude_deg) > 90) return {};
    }
    polygon.holes.clear();
  }
  return polygons;
}

std::string far_away_text(const Zone& zone, const GeodeticPoint& robot, double distance_m) {
  std::string text = "is " + distance_text(distance_m) + " from the robot";
  const auto other_way = swapped(zone.polygons);
  if (other_way.empty()) return text;
  const double swapped_m = from_place(other_way, robot).distance_m;
  if (swapped_m > kElsewhere_m) return text;
  return text + "; with latitude and longitude swapped it would be " + distance_text(swapped_m) +
         " from it";
}

}  // namespace

ZoneSummary summarise(const Zone& zone, const std::optional<GeodeticPoint>& robot) {
  ZoneSummary summary;
  const GeoPoint& corner = zone.polygons.front().outer.front();
  const auto polygons = project(zone.polygons, {corner.latitude_deg, corner.longitude_deg, 0});
  summary.area_m2 = united_area_m2(polygons);
  for (const MapPolygon& polygon : polygons) {
    ++summary.polygons;
    summary.holes += polygon.holes.size();
    summary.perimeter_m += perimeter_m(polygon);
  }
  summary.points = point_count(zone.polygons);
  if (!robot) return summary;
  const Nearest way = from_place(zone.polygons, *robot);
  summary.from_robot = way;
  if (way.distance_m > kElsewhere_m) {
    summary.warnings.push_back(far_away_text(zone, *robot, way.distance_m));
  } else if (zone.kind == Zone::Kind::keep_in && way.distance_m > 0) {
    summary.warnings.emplace_back("the robot is outside of what it may not leave");
  } else if (zone.kind == Zone::Kind::keep_out && way.distance_m == 0) {
    summary.warnings.emplace_back("the robot is inside of where it may not be");
  }
  return summary;
}

std::optional<DatumShift> datum_shift(const Zone& zone, const GeodeticPoint& origin) {
  if (!zone.datum) return std::nullopt;
  const GeodeticPoint& was = *zone.datum;
  if (same_origin(was, origin)) return std::nullopt;
  const GeographicLib::LocalCartesian frame(was.latitude_deg, was.longitude_deg, was.altitude_m);
  DatumShift shift;
  frame.Forward(origin.latitude_deg, origin.longitude_deg, origin.altitude_m, shift.east_m,
                shift.north_m, shift.up_m);
  shift.horizontal_m = std::hypot(shift.east_m, shift.north_m);
  return shift;
}

std::string datum_shift_text(const Zone& zone, const GeodeticPoint& origin) {
  const auto shift = datum_shift(zone, origin);
  if (!shift || shift->horizontal_m < kSeen_m || shift->horizontal_m > kSameMark_m) return {};
  return "zone " + zone.name + " was imported under an origin that is " +
         centimetres_text(shift->horizontal_m) + " m beside the present one (" +
         centimetres_text(shift->east_m) + " m east, " + centimetres_text(shift->north_m) +
         " m north): if both were given at the same mark, the base station has moved, and the "
         "zone is off by that";
}

}  // namespace drover::scene
