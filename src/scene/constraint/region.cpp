#include "scene/constraint/region.h"

#include <algorithm>
#include <cmath>

#include "drover/rotation.h"
#include "scene/constraint/convex.h"

namespace drover::scene {
namespace {

/// What is over the edge. A number that is none stays none.
double over(double beyond_m) {
  return beyond_m <= 0 ? 0.0 : beyond_m;
}

/// From (x, y) to the line between two points.
double to_line_m(double x, double y, double ax, double ay, double bx, double by) {
  const double dx = bx - ax;
  const double dy = by - ay;
  const double share = std::clamp(((x - ax) * dx + (y - ay) * dy) / (dx * dx + dy * dy), 0.0, 1.0);
  return std::hypot(x - ax - share * dx, y - ay - share * dy);
}

/// The cone's cut along its axis is a triangle: `across` from the axis, z along it.
double outside_cone_m(double height_m, double radius_m, double across_m, double z_m) {
  const double low_m = -height_m / 2;
  const double tip_m = height_m / 2;
  const double over_side = height_m * across_m + radius_m * (z_m - tip_m);
  if (over_side <= 0 && z_m >= low_m) return 0;
  return std::min(to_line_m(across_m, z_m, 0, low_m, radius_m, low_m),
                  to_line_m(across_m, z_m, 0, tip_m, radius_m, low_m));
}

}  // namespace

double outside_m(const SolidPrimitive& shape, const Vector3& at) {
  using Type = SolidPrimitive;
  if (!has_dimensions(shape)) return kAbsent;
  const auto& d = shape.dimensions;
  const double across_m = std::hypot(at.x, at.y);
  switch (shape.type) {
    case Type::BOX:
      return length(Vector3{over(std::abs(at.x) - d[Type::BOX_X] / 2),
                            over(std::abs(at.y) - d[Type::BOX_Y] / 2),
                            over(std::abs(at.z) - d[Type::BOX_Z] / 2)});
    case Type::SPHERE: return over(std::hypot(across_m, at.z) - d[Type::SPHERE_RADIUS]);
    case Type::CYLINDER:
      return std::hypot(over(across_m - d[Type::CYLINDER_RADIUS]),
                        over(std::abs(at.z) - d[Type::CYLINDER_HEIGHT] / 2));
    case Type::CONE:
      return outside_cone_m(d[Type::CONE_HEIGHT], d[Type::CONE_RADIUS], across_m, at.z);
    default: return kAbsent;
  }
}

double outside_m(const Mesh& mesh, const Vector3& at) {
  const Convex hull{std::span<const Vector3>(mesh.vertices), {}};
  const Convex point{std::span<const Vector3>(&at, 1), {}};
  const Separation found = separation(hull, point);
  if (found.meeting == Separation::Meeting::together) return 0;
  return std::max(found.at_least_m, 2 * kOnEdge_m);  // undecided is outside
}

}  // namespace drover::scene
