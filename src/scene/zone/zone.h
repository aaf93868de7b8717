// A zone: where the robot may be, or may not, kept in latitude and longitude.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "drover/path.h"

namespace drover::scene {

/// A corner, WGS 84.
struct GeoPoint {
  double latitude_deg = 0;
  double longitude_deg = 0;
  friend bool operator==(const GeoPoint&, const GeoPoint&) = default;
};

/// Corners in order, the first one not repeated at the end. An edge is straight in latitude and
/// longitude (RFC 7946, 3.1.1).
using GeoRing = std::vector<GeoPoint>;

struct GeoPolygon {
  GeoRing outer;
  std::vector<GeoRing> holes;
  friend bool operator==(const GeoPolygon&, const GeoPolygon&) = default;
};

struct Zone {
  enum class Kind : std::uint8_t {
    keep_in,   ///< the whole footprint stays inside one of its polygons
    keep_out,  ///< nothing of the footprint comes into any of them
  };
  std::string name;
  Kind kind = Kind::keep_out;
  std::vector<GeoPolygon> polygons;  ///< together: their union
  /// The origin of `map` that was in force at the import; absent when there was none.
  std::optional<GeodeticPoint> datum;
  std::string source;  ///< name of the file it came from
};

inline constexpr std::size_t kMaxZones = 100;
inline constexpr std::size_t kMaxPointsPerZone = 10'000;
inline constexpr std::size_t kMaxZonePoints = 100'000;  ///< of all zones together
inline constexpr std::size_t kMaxZoneNameBytes = 100;
inline constexpr std::size_t kMaxZoneSourceBytes = 255;
/// A larger one is most likely another thing than a fence, and the plane of `map` ends.
inline constexpr double kMaxZoneExtent_m = 20'000;

std::size_t point_count(const std::vector<GeoPolygon>& polygons);

}  // namespace drover::scene
