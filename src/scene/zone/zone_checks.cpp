// What a zone has to be, so that inside and outside are never in doubt.
#include "scene/zone/zone_checks.h"

#include <algorithm>
#include <cmath>
#include <string>

#include "json/json_text.h"
#include "json/located_json.h"
#include "scene/zone/ring.h"
#include "text/number.h"

namespace drover::scene {
namespace {

using text::number_text;

/// Smaller is no place for anything, and near what a double can tell: 1 cm^2.
constexpr double kLeastArea_m2 = 1e-4;
/// Of all rings together: it bounds the work of whoever cuts edges into pieces.
constexpr double kMaxPerimeter_m = 1e6;

const GeoRing& ring_of(const GeoPolygon& polygon, std::size_t ring) {
  return ring == 0 ? polygon.outer : polygon.holes[ring - 1];
}

std::string why_no_point(const GeoPoint& point) {
  if (!std::isfinite(point.latitude_deg) || !std::isfinite(point.longitude_deg))
    return "latitude and longitude have to be numbers";
  if (std::abs(point.latitude_deg) > 90)
    return "latitude " + number_text(point.latitude_deg) + " is not within -90 to 90 degrees";
  if (std::abs(point.longitude_deg) > 180)
    return "longitude " + number_text(point.longitude_deg) + " is not within -180 to 180 degrees";
  return {};
}

bool has_three_different(const GeoRing& ring) {
  const GeoPoint& first = ring.front();
  const auto second =
      std::find_if(ring.begin(), ring.end(), [&](const GeoPoint& p) { return !(p == first); });
  return std::any_of(second, ring.end(),
                     [&](const GeoPoint& p) { return !(p == first) && !(p == *second); });
}

std::optional<ZoneFault> check_points(const GeoRing& ring, std::size_t polygon,
                                      std::size_t number) {
  for (std::size_t i = 0; i < ring.size(); ++i) {
    auto why = why_no_point(ring[i]);
    if (!why.empty()) return ZoneFault{polygon, number, i, std::move(why)};
  }
  if (ring.empty() || !has_three_different(ring))
    return ZoneFault{polygon, number, {}, "has fewer than three different points"};
  return std::nullopt;
}

/// All points are good.
std::optional<ZoneFault> check_size(const std::vector<GeoPolygon>& polygons) {
  const GeoPoint zero = polygons.front().outer.front();
  GeoPoint low = zero;
  GeoPoint high = zero;
  double perimeter_m = 0;
  for (const GeoPolygon& polygon : polygons) {
    for (std::size_t r = 0; r <= polygon.holes.size(); ++r) {
      const GeoRing& ring = ring_of(polygon, r);
      for (std::size_t i = 0; i < ring.size(); ++i) {
        low.latitude_deg = std::min(low.latitude_deg, ring[i].latitude_deg);
        low.longitude_deg = std::min(low.longitude_deg, ring[i].longitude_deg);
        high.latitude_deg = std::max(high.latitude_deg, ring[i].latitude_deg);
        high.longitude_deg = std::max(high.longitude_deg, ring[i].longitude_deg);
        const Point2 edge = flat(ring[(i + 1) % ring.size()], ring[i]);
        perimeter_m += length_m(edge);
      }
    }
  }
  if (high.longitude_deg - low.longitude_deg > 180) {
    return ZoneFault{{},
                     {},
                     {},
                     "reach from longitude " + number_text(low.longitude_deg) + " to " +
                         number_text(high.longitude_deg) +
                         ": what crosses the 180th meridian has to be cut there"};
  }
  const Point2 across = flat(high, low);
  const double extent_m = length_m(across);
  if (extent_m > kMaxZoneExtent_m) {
    return ZoneFault{{},
                     {},
                     {},
                     "reach over " + number_text(std::round(extent_m)) + " m; at most " +
                         number_text(kMaxZoneExtent_m) + " m is a zone"};
  }
  if (perimeter_m > kMaxPerimeter_m) {
    return ZoneFault{{},
                     {},
                     {},
                     "have edges of " + number_text(std::round(perimeter_m)) +
                         " m in all; at most " + number_text(kMaxPerimeter_m) + " m"};
  }
  return std::nullopt;
}

ZoneFault crossing_fault(const Crossing& crossing, std::size_t polygon) {
  const ZoneFault other{polygon, crossing.other_ring, crossing.other_point, {}};
  return ZoneFault{
      polygon, crossing.ring, crossing.point,
      "the edge that begins here crosses or touches the one that begins at " + other.path()};
}

/// No edges cross, so one point tells where a whole ring lies.
std::optional<ZoneFault> check_holes(const std::vector<std::vector<Point2>>& rings,
                                     std::size_t polygon) {
  for (std::size_t r = 1; r < rings.size(); ++r) {
    const Point2& point = rings[r].front();
    if (!ring_contains(point, rings[0]))
      return ZoneFault{polygon, r, {}, "is no hole: it lies outside of the outer ring"};
    for (std::size_t other = 1; other < rings.size(); ++other) {
      if (other != r && ring_contains(point, rings[other]))
        return ZoneFault{
            polygon, r, {}, "lies inside of " + ZoneFault{polygon, other, {}, {}}.path()};
    }
  }
  return std::nullopt;
}

/// All points are good.
std::optional<ZoneFault> check_shape(const GeoPolygon& polygon, std::size_t number) {
  std::vector<std::vector<Point2>> rings;
  const GeoPoint zero = polygon.outer.front();
  for (std::size_t r = 0; r <= polygon.holes.size(); ++r) {
    rings.push_back(flat(ring_of(polygon, r), zero));
    if (!(std::abs(signed_area_m2(rings.back())) >= kLeastArea_m2)) {
      return ZoneFault{number, r, {}, "has no area: its points lie on a line, or its edges cross"};
    }
  }
  if (const auto crossing = find_crossing(rings)) return crossing_fault(*crossing, number);
  return check_holes(rings, number);
}

/// What is no UTF-8 would come back from the store as something else.
bool is_utf8(const std::string& text) {
  const auto read = json::parse(json::JsonText().text(text).take());
  return read.ok() && read->root.text() != nullptr && *read->root.text() == text;
}

bool is_place(const GeodeticPoint& point) {
  return std::abs(point.latitude_deg) <= 90 && std::abs(point.longitude_deg) <= 360 &&
         std::isfinite(point.altitude_m);
}

}  // namespace

std::string ZoneFault::path() const {
  std::string path = "polygons";
  if (polygon) path += "[" + std::to_string(*polygon) + "]";
  if (ring) path += *ring == 0 ? ".outer" : ".holes[" + std::to_string(*ring - 1) + "]";
  if (point) path += ".points[" + std::to_string(*point) + "]";
  return path;
}

std::size_t point_count(const std::vector<GeoPolygon>& polygons) {
  std::size_t count = 0;
  for (const GeoPolygon& polygon : polygons) {
    count += polygon.outer.size();
    for (const GeoRing& hole : polygon.holes) count += hole.size();
  }
  return count;
}

std::optional<ZoneFault> find_fault(const std::vector<GeoPolygon>& polygons) {
  if (polygons.empty()) return ZoneFault{{}, {}, {}, "there is none"};
  if (const std::size_t count = point_count(polygons); count > kMaxPointsPerZone) {
    return ZoneFault{{},
                     {},
                     {},
                     "have " + std::to_string(count) + " points; at most " +
                         std::to_string(kMaxPointsPerZone) + " are a zone"};
  }
  for (std::size_t i = 0; i < polygons.size(); ++i) {
    for (std::size_t r = 0; r <= polygons[i].holes.size(); ++r) {
      if (auto fault = check_points(ring_of(polygons[i], r), i, r)) return fault;
    }
  }
  if (auto fault = check_size(polygons)) return fault;
  for (std::size_t i = 0; i < polygons.size(); ++i) {
    if (auto fault = check_shape(polygons[i], i)) return fault;
  }
  return std::nullopt;
}

std::optional<Refusal> check_zone(const Zone& zone) {
  if (zone.name.empty()) return Refusal{"name", "a zone needs one"};
  if (zone.name.size() > kMaxZoneNameBytes) {
    return Refusal{"name", "has " + std::to_string(zone.name.size()) + " bytes; at most " +
                               std::to_string(kMaxZoneNameBytes)};
  }
  if (std::any_of(zone.name.begin(), zone.name.end(),
                  [](unsigned char c) { return c < 0x20 || c == 0x7F; }))
    return Refusal{"name", "has a control character"};
  if (!is_utf8(zone.name)) return Refusal{"name", "is no UTF-8"};
  if (zone.source.size() > kMaxZoneSourceBytes || !is_utf8(zone.source)) {
    return Refusal{"source",
                   "has to be UTF-8 of at most " + std::to_string(kMaxZoneSourceBytes) + " bytes"};
  }
  if (zone.datum && !is_place(*zone.datum)) return Refusal{"datum", "is no place on the earth"};
  if (auto fault = find_fault(zone.polygons)) return Refusal{fault->path(), std::move(fault->why)};
  return std::nullopt;
}

std::optional<Refusal> check_room(const std::vector<Zone>& stored, const Zone& added) {
  std::size_t zones = 1;
  std::size_t points = point_count(added.polygons);
  for (const Zone& zone : stored) {
    if (zone.name == added.name) continue;
    ++zones;
    points += point_count(zone.polygons);
  }
  if (zones > kMaxZones) {
    return Refusal{"", "there are " + std::to_string(zones - 1) + " zones already; at most " +
                           std::to_string(kMaxZones)};
  }
  if (points > kMaxZonePoints) {
    return Refusal{"", "all zones would have " + std::to_string(points) + " points; at most " +
                           std::to_string(kMaxZonePoints)};
  }
  return std::nullopt;
}

}  // namespace drover::scene
