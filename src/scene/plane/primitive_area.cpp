// Boxes by their corners; sphere, cylinder and cone upright by their largest circle in the
// interval, tilted as a prism or pyramid around them.
#include <algorithm>
#include <cmath>
#include <span>

#include "drover/angle.h"
#include "scene/plane/areas.h"
#include "scene/plane/motion3.h"
#include "scene/plane/section.h"

namespace drover::scene {
namespace {

/// An axis that leans less than this many metres a metre counts as upright: 10 um in 10 km.
constexpr double kUpright = 1e-9;
/// Sides of a prism around a tilted cylinder: outside it by at most 0.13 % of the radius.
constexpr std::size_t kSides = 64;

Area area_of_disc(Point2 centre, double radius_m) {
  if (radius_m <= 0) return {};
  std::vector<Piece> pieces;
  pieces.push_back(disc(centre, radius_m));
  return area_of(std::move(pieces));
}

Area area_of_box(std::span<const double> size_m, const Motion3& motion, Heights heights) {
  Polyhedron box;
  for (std::size_t i = 0; i < 8; ++i) {
    const Vector3 corner{(i & 1 ? 0.5 : -0.5) * size_m[SolidPrimitive::BOX_X],
                         (i & 2 ? 0.5 : -0.5) * size_m[SolidPrimitive::BOX_Y],
                         (i & 4 ? 0.5 : -0.5) * size_m[SolidPrimitive::BOX_Z]};
    box.corners_m.push_back(moved(motion, corner));
    for (const std::size_t along : {1, 2, 4})
      if (!(i & along)) box.edges.push_back({i, i | along});
  }
  return area_between(box, heights);
}

Area area_of_sphere(double radius_m, const Motion3& motion, Heights heights) {
  const Vector3& centre = motion.move_m;
  if (misses(centre.z - radius_m, centre.z + radius_m, heights)) return {};
  const double off_m = centre.z - std::clamp(centre.z, heights.low_m, heights.high_m);
  return area_of_disc({centre.x, centre.y}, std::sqrt(radius_m * radius_m - off_m * off_m));
}

/// Cylinder (both radii alike) and cone (the upper one 0), axis along z of `map`, whichever end up.
Area area_of_upright(double height_m, double lower_m, double upper_m, const Motion3& motion,
                     Heights heights) {
  const Vector3& centre = motion.move_m;
  const double bottom_m = centre.z - 0.5 * height_m;
  const double top_m = centre.z + 0.5 * height_m;
  if (misses(bottom_m, top_m, heights)) return {};
  const auto radius_at_m = [&](double z_m) {
    const double part = std::clamp((z_m - bottom_m) / height_m, 0.0, 1.0);
    return lower_m + part * (upper_m - lower_m);
  };
  return area_of_disc({centre.x, centre.y},
                      std::max(radius_at_m(heights.low_m), radius_at_m(heights.high_m)));
}

/// The prism around a cylinder, the pyramid around a cone: its sides touch the round.
Area area_of_tilted(double height_m, double lower_m, double upper_m, const Motion3& motion,
                    Heights heights) {
  const double outer = 1 / std::cos(kPi / static_cast<double>(kSides));
  Polyhedron body;
  for (std::size_t i = 0; i < kSides; ++i) {
    const Point2 at = outer * direction(2 * kPi * static_cast<double>(i) / kSides);
    const std::size_t low = 2 * i;
    const std::size_t next = 2 * ((i + 1) % kSides);
    body.corners_m.push_back(moved(motion, {lower_m * at.x_m, lower_m * at.y_m, -0.5 * height_m}));
    body.corners_m.push_back(moved(motion, {upper_m * at.x_m, upper_m * at.y_m, 0.5 * height_m}));
    body.edges.insert(body.edges.end(), {{low, low + 1}, {low, next}, {low + 1, next + 1}});
  }
  return area_between(body, heights);
}

Area area_of_round(double height_m, double lower_m, double upper_m, const Motion3& motion,
                   Heights heights) {
  if (std::hypot(motion.z_axis.x, motion.z_axis.y) > kUpright)
    return area_of_tilted(height_m, lower_m, upper_m, motion, heights);
  if (motion.z_axis.z < 0) std::swap(lower_m, upper_m);
  return area_of_upright(height_m, lower_m, upper_m, motion, heights);
}

bool can_be_judged(std::span<const double> size_m, std::size_t count, const Motion3& motion) {
  return size_m.size() >= count && is_finite(motion) &&
         std::all_of(size_m.begin(), size_m.end(),
                     [](double m) { return std::isfinite(m) && m > 0; });
}

}  // namespace

Area area_of(const SolidPrimitive& shape, const Pose& in_map, Heights heights) {
  using P = SolidPrimitive;
  const Motion3 motion = motion_of(in_map);
  const std::span<const double> size_m = shape.dimensions;
  const auto needs = [&](std::size_t count) {
    return is_interval(heights) && can_be_judged(size_m, count, motion);
  };
  switch (shape.type) {
    case P::BOX:
      if (needs(3)) return area_of_box(size_m, motion, heights);
      break;
    case P::SPHERE:
      if (needs(1)) return area_of_sphere(size_m[P::SPHERE_RADIUS], motion, heights);
      break;
    case P::CYLINDER: {
      if (!needs(2)) break;
      const double radius_m = size_m[P::CYLINDER_RADIUS];
      return area_of_round(size_m[P::CYLINDER_HEIGHT], radius_m, radius_m, motion, heights);
    }
    case P::CONE:
      if (needs(2))
        return area_of_round(size_m[P::CONE_HEIGHT], size_m[P::CONE_RADIUS], 0, motion, heights);
      break;
  }
  return area_of_everything();
}

}  // namespace drover::scene
