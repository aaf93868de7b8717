// A point of a link, or more of it, inside the union of the regions.
#include <algorithm>
#include <cmath>
#include <limits>

#include "drover/angle.h"
#include "drover/rotation.h"
#include "scene/constraint/kinds.h"
#include "scene/constraint/region.h"
#include "scene/world/rigid.h"
#include "scene/world/words.h"

namespace drover::scene {
namespace {

constexpr int kMarginSides = 16;  // around the margin's circle: 2 % more, never less

/// All of it in `map`; that everything of them is inside a convex shape is that all corners are.
std::vector<Vector3> corners_of(const PositionConstraint& position, const Extent& extent,
                                const Pose& link, const Pose2& base) {
  std::vector<Vector3> outline = extent.outline;
  if (outline.empty()) outline.push_back({});
  std::vector<Vector3> corners;
  for (const Vector3& own : outline) {
    const Vector3 at = rigid::in_parent(link, position.target_point_offset + own);
    const double thrown_m = extent.turn_rad * std::hypot(at.x - base.x_m, at.y - base.y_m);
    const double margin_m = extent.margin_m + thrown_m;
    if (margin_m == 0) {
      corners.push_back(at);
      continue;
    }
    const double reach_m = margin_m / std::cos(kPi / kMarginSides);
    for (int side = 0; side < kMarginSides; ++side) {
      const double angle_rad = 2 * kPi * side / kMarginSides;
      corners.push_back(at +
                        Vector3{reach_m * std::cos(angle_rad), reach_m * std::sin(angle_rad), 0});
    }
  }
  return corners;
}

/// How far the worst corner is outside.
template <class Shape>
double worst_outside_m(const Shape& shape, const Pose& in_map,
                       const std::vector<Vector3>& corners) {
  double worst_m = 0;
  for (const Vector3& corner : corners) {
    const double outside = outside_m(shape, rigid::in_own(in_map, corner));
    if (!(outside <= worst_m)) worst_m = outside;
    if (std::isnan(worst_m)) break;
  }
  return worst_m;
}

Pose pose_at(const std::vector<Pose>& poses, std::size_t i) {
  return i < poses.size() ? poses[i] : Pose{};
}

/// Everything must be in one of the shapes: what lies across two that only touch is outside.
template <class Shape>
double least_outside_m(const std::vector<Shape>& shapes, const std::vector<Pose>& poses,
                       const Pose& frame, const std::vector<Vector3>& corners) {
  double least_m = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < shapes.size(); ++i) {
    const Pose in_map = rigid::product(frame, pose_at(poses, i));
    const double outside = worst_outside_m(shapes[i], in_map, corners);
    if (outside < least_m) least_m = outside;
  }
  return least_m;
}

}  // namespace

Finding finding_of(const PositionConstraint& position, const Setting& setting) {
  const auto link = link_in_map(setting, position.link_name);
  if (!link) return unknown("the robot has no link " + words::quoted(position.link_name));
  const auto frame = frame_of(setting, position.header.frame_id);
  if (!frame) return unknown("the robot has no frame " + words::quoted(position.header.frame_id));
  if (!rigid::is_finite(*link) || !rigid::is_finite(*frame))
    return unknown("the robot's place is not known");

  const Extent& extent = setting.terms.extent;
  const std::vector<Vector3> corners = corners_of(position, extent, *link, setting.state.base);
  const BoundingVolume& region = position.constraint_region;
  const double outside_all_m =
      std::min(least_outside_m(region.primitives, region.primitive_poses, *frame, corners),
               least_outside_m(region.meshes, region.mesh_poses, *frame, corners));
  if (outside_all_m <= kOnEdge_m) return holding();
  if (!std::isfinite(outside_all_m)) return unknown("it has no region");
  return {false, outside_all_m, words::number(outside_all_m, 3) + " m outside of its region"};
}

}  // namespace drover::scene
