#include "scene/world/sighting.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "drover/angle.h"
#include "drover/rotation.h"
#include "scene/world/rigid.h"
#include "scene/world/words.h"

namespace drover::scene {
namespace {

constexpr double kUnknown_m = std::numeric_limits<double>::infinity();
/// A plane that leans less from level turns into itself.
constexpr double kLevelPlane = 1e-9;

double level_m(const Pose& in_map, const Vector3& own, Point2 from) {
  const Vector3 at = rigid::in_parent(in_map, own);
  return std::hypot(at.x - from.x_m, at.y - from.y_m);
}

double farthest_corner_m(const std::vector<double>& size_m, const Pose& in_map, Point2 from) {
  double most_m = 0;
  for (unsigned i = 0; i < 8; ++i) {
    const Vector3 corner{(i & 1U ? 0.5 : -0.5) * size_m[SolidPrimitive::BOX_X],
                         (i & 2U ? 0.5 : -0.5) * size_m[SolidPrimitive::BOX_Y],
                         (i & 4U ? 0.5 : -0.5) * size_m[SolidPrimitive::BOX_Z]};
    most_m = std::max(most_m, level_m(in_map, corner, from));
  }
  return most_m;
}

}  // namespace

double farthest_m(const SolidPrimitive& shape, const Pose& in_map, Point2 from) {
  using P = SolidPrimitive;
  const auto& size_m = shape.dimensions;
  if (shape.type == P::BOX && size_m.size() >= 3) return farthest_corner_m(size_m, in_map, from);
  if (shape.type == P::SPHERE && !size_m.empty())
    return level_m(in_map, {}, from) + size_m[P::SPHERE_RADIUS];
  if ((shape.type != P::CYLINDER && shape.type != P::CONE) || size_m.size() < 2) return kUnknown_m;
  const double half_m = 0.5 * size_m[P::CYLINDER_HEIGHT];
  return std::max(level_m(in_map, {0, 0, half_m}, from), level_m(in_map, {0, 0, -half_m}, from)) +
         size_m[P::CYLINDER_RADIUS];
}

double farthest_m(const Mesh& shape, const Pose& in_map, Point2 from) {
  double most_m = 0;
  for (const Vector3& vertex : shape.vertices)
    most_m = std::max(most_m, level_m(in_map, vertex, from));
  return most_m;
}

double farthest_m(const Plane& shape, const Pose& in_map, Point2 from) {
  const auto& [a, b, c, d] = shape.coef;
  const double length = std::hypot(a, b, c);
  if (!(length > 0)) return kUnknown_m;
  const Vector3 normal = rotate(in_map.orientation, Vector3{a / length, b / length, c / length});
  const double level = std::hypot(normal.x, normal.y);
  if (level < kLevelPlane) return 0;
  const Vector3 to_robot = Vector3{from.x_m, from.y_m, 0} - in_map.position_m;
  const double away_m = std::abs(dot(normal, to_robot) + d / length) / level;
  return std::max(away_m, kPlaneReach_m);
}

Result<double, std::string> sigma_of_place(const Sighting& seen, double farthest_m) {
  const double aside_m = farthest_m * seen.yaw_sigma_rad;
  if (!(2 * aside_m <= kMostAside_m))
    return "heading known to " + words::number(to_deg(2 * seen.yaw_sigma_rad), 1) +
           " deg: " + words::number(farthest_m, 1) + " m away that is " +
           words::number(2 * aside_m, 2) + " m, allowed: " + words::number(kMostAside_m, 2) +
           " m; wait until the heading is better";
  return seen.position_sigma_m + aside_m;
}

}  // namespace drover::scene
