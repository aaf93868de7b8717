// A plane meets the interval in a strip, in all of it or not at all.
#include <algorithm>
#include <cmath>

#include "scene/plane/areas.h"
#include "scene/plane/motion3.h"
#include "scene/plane/section.h"

namespace drover::scene {
namespace {

/// Flatter than this is level: it rises by 10 um in 10 km.
constexpr double kLevel = 1e-9;
/// What rounding does to a wall that is turned and moved, and less than any wall leans.
constexpr double kUprightPlane = 1e-6;

/// normal . point + offset = 0, in `map`.
struct InMap {
  Vector3 normal;
  double offset = 0;
  double lean = 0;  ///< how much of the normal is level
  double length = 0;
};

InMap in_map_of(const Plane& plane, const Pose& in_map) {
  const Motion3 motion = motion_of(in_map);
  const Vector3 n = turned(motion, {plane.coef[0], plane.coef[1], plane.coef[2]});
  const Vector3& t = motion.move_m;
  // std::hypot may take no number for one.
  return {n, plane.coef[3] - (n.x * t.x + n.y * t.y + n.z * t.z), std::sqrt(n.x * n.x + n.y * n.y),
          std::sqrt(n.x * n.x + n.y * n.y + n.z * n.z)};
}

bool is_plane(const InMap& plane) {
  return plane.length > 0 && std::isfinite(plane.length) && std::isfinite(plane.offset);
}

PlaneLies how_it_lies(const InMap& plane) {
  if (std::abs(plane.normal.z) <= kUprightPlane * plane.length) return PlaneLies::upright;
  return std::abs(plane.normal.z) > plane.lean ? PlaneLies::level : PlaneLies::between;
}

Area area_of_level(double height_m, Heights heights) {
  return misses(height_m, height_m, heights) ? Area{} : area_of_everything();
}

Area area_of_strip(const InMap& plane, double low_m, double high_m) {
  Area area = area_of_everything();
  area.strips = {{{plane.normal.x / plane.lean, plane.normal.y / plane.lean}, low_m, high_m}};
  return area;
}

}  // namespace

bool is_height_ignored(Heights heights) {
  return std::isinf(heights.low_m) && std::isinf(heights.high_m) && heights.low_m < heights.high_m;
}

PlaneLies how_it_lies(const Plane& plane, const Pose& in_map) {
  const InMap placed = in_map_of(plane, in_map);
  return is_plane(placed) ? how_it_lies(placed) : PlaneLies::between;
}

Area area_of(const Plane& plane, const Pose& in_map, Heights heights) {
  if (!is_interval(heights)) return area_of_everything();
  const InMap placed = in_map_of(plane, in_map);
  if (!is_plane(placed)) return area_of_everything();
  const auto& [n, offset, lean, length] = placed;
  if (is_height_ignored(heights)) {
    const PlaneLies lies = how_it_lies(placed);
    if (lies == PlaneLies::level) return {};
    if (lies == PlaneLies::between) return area_of_everything();
    return area_of_strip(placed, -offset / lean, -offset / lean);
  }
  if (lean <= kLevel * length) return area_of_level(-offset / n.z, heights);
  // normal . point = -(offset + n.z z) / lean, for each z of the interval, which may be infinite.
  const auto at_m = [&, z = n.z, o = offset, l = lean](double z_m) {
    return -(o + (z == 0 ? 0 : z * z_m)) / l;
  };
  const auto [low_m, high_m] = std::minmax({at_m(heights.low_m), at_m(heights.high_m)});
  return area_of_strip(placed, low_m, high_m);
}

}  // namespace drover::scene
