// What a person is told of a zone at its import, so that a fence in the wrong place is seen.
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "drover/path.h"
#include "scene/zone/measures.h"
#include "scene/zone/zone.h"

namespace drover::scene {

struct ZoneSummary {
  std::size_t polygons = 0;
  std::size_t holes = 0;
  std::size_t points = 0;
  double area_m2 = 0;                   ///< where polygons overlap it counts once (united_area_m2)
  double perimeter_m = 0;               ///< of all of them
  std::optional<Nearest> from_robot{};  ///< absent: nobody knows where the robot is
  std::vector<std::string> warnings{};  ///< a sentence each
};

/// `robot`: where base_link is. The zone is good (check_zone).
ZoneSummary summarise(const Zone& zone, const std::optional<GeodeticPoint>& robot);

/// Where `origin` is, seen from the origin that was in force when the zone was imported, in the
/// `map` of that one.
struct DatumShift {
  double east_m = 0;
  double north_m = 0;
  double up_m = 0;
  double horizontal_m = 0;
};
/// Nothing when they are the same, or the zone came when there was none.
std::optional<DatumShift> datum_shift(const Zone& zone, const GeodeticPoint& origin);

/// A shift up to this may be a base station that moved; beyond it the origin was given elsewhere.
inline constexpr double kSameMark_m = 10;
/// What a person should know of it, a sentence; empty when there is nothing to say.
std::string datum_shift_text(const Zone& zone, const GeodeticPoint& origin);

}  // namespace drover::scene
