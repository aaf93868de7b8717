#include "scene/constraint/view.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "drover/angle.h"
#include "drover/rotation.h"
#include "scene/constraint/convex.h"
#include "scene/message/validate.h"
#include "scene/world/rigid.h"
#include "scene/world/words.h"

namespace drover::scene {
namespace {

/// What is seen is mostly on something: so far before the disc the view of objects ends.
constexpr double kBeforeTarget_m = 0.01;
constexpr double kOnSheet_m = 1e-6;

using Points = std::vector<Vector3>;

/// Only what is proven to be beside the view does not hide.
bool hides(const Convex& body, const Points& view) {
  const Convex cone{std::span<const Vector3>(view), {}};
  return separation(body, cone).meeting != Separation::Meeting::apart;
}

/// From its middle to what is farthest of it.
double reach_m(const SolidPrimitive& shape) {
  const auto& d = shape.dimensions;
  if (!has_dimensions(shape)) return kAbsent;
  switch (shape.type) {
    case SolidPrimitive::SPHERE: return d[SolidPrimitive::SPHERE_RADIUS];
    case SolidPrimitive::BOX: return 0.5 * length(Vector3{d[0], d[1], d[2]});
    default:
      return std::hypot(0.5 * d[SolidPrimitive::CYLINDER_HEIGHT],
                        d[SolidPrimitive::CYLINDER_RADIUS]);
  }
}

/// The view is nowhere farther from its middle line than the disc is wide: most of a large scene is
/// told apart by that.
bool is_far_beside(const View& view, const Vector3& middle, double reach_m) {
  const Vector3 line = view.target.position_m - view.sensor.position_m;
  const Vector3 way = middle - view.sensor.position_m;
  const double square = dot(line, line);
  const double share = square > 0 ? std::clamp(dot(way, line) / square, 0.0, 1.0) : 0;
  const double beside_m = length(way - share * line);
  return beside_m > reach_m + view.radius_m + kOnSheet_m;
}

bool hides(const SolidPrimitive& shape, const Pose& in_map, const Points& view) {
  return hides(Convex{&shape, in_map}, view);
}

bool hull_hides(const Mesh& mesh, const Pose& in_map, const Points& view) {
  return hides(Convex{std::span<const Vector3>(mesh.vertices), in_map}, view);
}

/// A box along the axes around points.
struct Around {
  Vector3 low;
  Vector3 high;
};

Around around(std::span<const Vector3> points) {
  Around box{points[0], points[0]};
  for (const Vector3& p : points) {
    box.low = {std::min(box.low.x, p.x), std::min(box.low.y, p.y), std::min(box.low.z, p.z)};
    box.high = {std::max(box.high.x, p.x), std::max(box.high.y, p.y), std::max(box.high.z, p.z)};
  }
  return box;
}

bool are_apart(const Around& a, const Around& b) {
  return a.low.x > b.high.x || a.low.y > b.high.y || a.low.z > b.high.z || b.low.x > a.high.x ||
         b.low.y > a.high.y || b.low.z > a.high.z;
}

/// An object's mesh is its triangles: one sees through the gate that is between them.
bool hides(const Mesh& mesh, const Pose& in_map, const Points& view) {
  if (!hull_hides(mesh, in_map, view)) return false;
  Points own;  // the view in the mesh's frame
  for (const Vector3& corner : view) own.push_back(rigid::in_own(in_map, corner));
  const Around view_box = around(own);
  return std::ranges::any_of(mesh.triangles, [&](const MeshTriangle& triangle) {
    std::array<Vector3, 3> corners;
    for (std::size_t i = 0; i < 3; ++i) {
      if (triangle[i] >= mesh.vertices.size()) return true;
      corners[i] = mesh.vertices[triangle[i]];
      if (!rigid::is_finite(corners[i])) return true;
    }
    if (are_apart(around(corners), view_box)) return false;
    return hides(Convex{std::span<const Vector3>(corners), {}}, own);
  });
}

/// A sheet without thickness: the view is on one side of it, or it hides.
bool hides(const Plane& plane, const Pose& in_map, const Points& view) {
  const Vector3 normal{plane.coef[0], plane.coef[1], plane.coef[2]};
  const double scale = length(normal);
  const auto side_m = [&](const Vector3& at) {
    return (dot(normal, rigid::in_own(in_map, at)) + plane.coef[3]) / scale;
  };
  const bool above = std::ranges::all_of(view, [&](auto& at) { return side_m(at) >= -kOnSheet_m; });
  const bool below = std::ranges::all_of(view, [&](auto& at) { return side_m(at) <= kOnSheet_m; });
  return !above && !below;
}

template <class Shape>
bool any_hides(const std::vector<Placed<Shape>>& shapes, const Points& view) {
  return std::ranges::any_of(
      shapes, [&](const Placed<Shape>& one) { return hides(one.shape, one.in_map, view); });
}

bool object_hides(const Object& object, const View& view, const Points& before) {
  const bool primitive_hides =
      std::ranges::any_of(object.primitives, [&](const Placed<SolidPrimitive>& one) {
        return !is_far_beside(view, one.in_map.position_m, reach_m(one.shape)) &&
               hides(one.shape, one.in_map, before);
      });
  return primitive_hides || any_hides(object.meshes, before) || any_hides(object.planes, before);
}

bool body_hides(const RobotBody& body, const Pose& link, const Points& view) {
  const Pose in_map = rigid::product(link, body.on_link);
  if (const auto* shape = std::get_if<SolidPrimitive>(&body.shape))
    return hides(*shape, in_map, view);
  return hull_hides(*std::get_if<Mesh>(&body.shape), in_map, view);
}

}  // namespace

Points corners_of(const View& view, double short_of_m) {
  const Vector3& sensor = view.sensor.position_m;
  const double way_m = length(view.target.position_m - sensor);
  const double share = way_m > 2 * short_of_m ? 1 - short_of_m / way_m : 0.5;
  Points corners{sensor};
  const int sides = std::clamp(view.sides, 3, kMaxConeSides);
  for (int i = 0; i < sides; ++i) {
    const double angle_rad = 2 * kPi * i / sides;
    const Vector3 on_disc{view.radius_m * std::cos(angle_rad), view.radius_m * std::sin(angle_rad),
                          0};
    const Vector3 ray = rigid::in_parent(view.target, on_disc) - sensor;
    corners.push_back(sensor + share * ray);
  }
  return corners;
}

std::optional<std::string> what_hides(const View& view, const Setting& setting,
                                      std::string_view sensor_link, std::string_view target_link) {
  const Points whole = corners_of(view, 0);
  for (const Link& link : setting.robot.links) {
    if (same_frame(link.name, sensor_link) || same_frame(link.name, target_link)) continue;
    const Pose in_map = *link_in_map(setting, link.name);
    for (const RobotBody& body : link.bodies) {
      if (body_hides(body, in_map, whole))
        return "the robot's own " + link.name + " is in the view";
    }
  }
  const Points before = corners_of(view, kBeforeTarget_m);
  for (const Object& object : setting.objects) {
    if (object_hides(object, view, before)) return words::quoted(object.id) + " is in the view";
  }
  return std::nullopt;
}

}  // namespace drover::scene
