// A point of a link, or more of it, inside the union of the regions.
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <utility>

#include "drover/angle.h"
#include "drover/rotation.h"
#include "scene/constraint/kinds.h"
#include "scene/constraint/region.h"
#include "scene/message/frames.h"
#include "scene/world/rigid.h"
#include "scene/world/words.h"

namespace drover::scene {
namespace {

constexpr int kMarginSides = 16;  // around the margin's circle: 2 % more, never less

/// How well the way that the robot looks is known, for a region.
enum class Looks : std::uint8_t {
  known,
  any_way,  ///< the point is somewhere on a circle about base_link
  along     ///< nobody knows, but the region turns with the robot
};

Looks looks_of(const PositionConstraint& position, double yaw_rad) {
  if (std::isfinite(yaw_rad)) return Looks::known;
  return is_global_frame(position.header.frame_id) ? Looks::any_way : Looks::along;
}

/// All of it in `map`; that everything of them is inside a convex shape is that all corners are.
std::vector<Vector3> corners_of(const PositionConstraint& position, const Extent& extent,
                                const Pose& link, const Pose2& base, Looks looks) {
  std::vector<Vector3> outline = extent.outline;
  if (outline.empty()) outline.push_back({});
  std::vector<Vector3> corners;
  for (const Vector3& own : outline) {
    Vector3 at = rigid::in_parent(link, position.target_point_offset + own);
    const double reach_of_point_m = std::hypot(at.x - base.x_m, at.y - base.y_m);
    double margin_m = extent.margin_m;
    if (looks == Looks::known) margin_m += extent.turn_rad * reach_of_point_m;
    if (looks == Looks::any_way) {
      margin_m += reach_of_point_m;
      at = {base.x_m, base.y_m, at.z};
    }
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

/// Where the point is depends on where the robot looks.
bool reaches_out(const PositionConstraint& position, const Pose& link, const Pose2& base) {
  constexpr double kReaches_m = 1e-3;
  const Vector3 at = rigid::in_parent(link, position.target_point_offset);
  return std::hypot(at.x - base.x_m, at.y - base.y_m) > kReaches_m;
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
  const Pose2& base = setting.state.base;
  const Looks looks = looks_of(position, base.yaw_rad);
  const double yaw_rad = looks == Looks::known ? base.yaw_rad : 0;
  const auto link = link_if_looking(setting, position.link_name, yaw_rad);
  if (!link) return unknown("the robot has no link " + words::quoted(position.link_name));
  const auto frame = frame_if_looking(setting, position.header.frame_id, yaw_rad);
  if (!frame) return unknown("the robot has no frame " + words::quoted(position.header.frame_id));
  if (!rigid::is_finite(*link) || !rigid::is_finite(*frame))
    return unknown("the robot's place is not known");

  const std::vector<Vector3> corners =
      corners_of(position, setting.terms.extent, *link, base, looks);
  const BoundingVolume& region = position.constraint_region;
  const double outside_all_m =
      std::min(least_outside_m(region.primitives, region.primitive_poses, *frame, corners),
               least_outside_m(region.meshes, region.mesh_poses, *frame, corners));
  if (outside_all_m <= kOnEdge_m) return holding();
  if (!std::isfinite(outside_all_m)) return unknown("it has no region");
  std::string why = words::number(outside_all_m, 3) + " m outside of its region";
  // What is missing may be all that it needs.
  if (looks == Looks::any_way && reaches_out(position, *link, base)) why += ", with no heading";
  return {false, outside_all_m, std::move(why)};
}

}  // namespace drover::scene
