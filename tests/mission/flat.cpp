// Separating axes tell whether two convex polygons overlap; corners against edges tell how far
// apart they are.
#include "mission/flat.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace drover::mission {
namespace {

/// The largest signed distance of all of `b` from an edge of `a`, outwards; -infinity: no edges.
double separation_m(const std::vector<Place>& a, const std::vector<Place>& b) {
  double widest_m = -std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < a.size() && a.size() > 1; ++i) {
    const Place& p = a[i];
    const Place& q = a[(i + 1) % a.size()];
    const double length_m = distance_m(p, q);
    if (!(length_m > 0)) continue;
    double least_m = std::numeric_limits<double>::infinity();
    for (const auto& corner : b)
      least_m = std::min(least_m, ((corner.x_m - p.x_m) * (q.y_m - p.y_m) -
                                   (corner.y_m - p.y_m) * (q.x_m - p.x_m)) /
                                      length_m);
    widest_m = std::max(widest_m, least_m);
  }
  return widest_m;
}

double to_edge_m(const Place& a, const Place& b, const Place& at) {
  const double dx_m = b.x_m - a.x_m;
  const double dy_m = b.y_m - a.y_m;
  const double square = dx_m * dx_m + dy_m * dy_m;
  const double share =
      square > 0
          ? std::clamp(((at.x_m - a.x_m) * dx_m + (at.y_m - a.y_m) * dy_m) / square, 0.0, 1.0)
          : 0.0;
  return std::hypot(at.x_m - a.x_m - share * dx_m, at.y_m - a.y_m - share * dy_m);
}

double corners_to_edges_m(const std::vector<Place>& corners, const std::vector<Place>& edges) {
  double least_m = std::numeric_limits<double>::infinity();
  for (const auto& corner : corners)
    for (std::size_t i = 0; i < edges.size(); ++i)
      least_m = std::min(least_m, to_edge_m(edges[i], edges[(i + 1) % edges.size()], corner));
  return least_m;
}

std::vector<Place> turned(const std::vector<Place>& corners, double x_m, double y_m,
                          double yaw_rad) {
  std::vector<Place> out;
  const double c = std::cos(yaw_rad);
  const double s = std::sin(yaw_rad);
  for (const auto& corner : corners)
    out.push_back({x_m + c * corner.x_m - s * corner.y_m, y_m + s * corner.x_m + c * corner.y_m});
  return out;
}

/// The largest radius between the heights, over the foot or the middle; none: not between them.
std::optional<double> radius_between_m(const TrueSolid& solid, double low_m, double top_m) {
  const double radius_m = solid.sizes.at(0);
  if (solid.kind == "sphere") {
    const double nearest_m = std::clamp(solid.z_m, low_m, top_m);
    const double off_m = std::abs(nearest_m - solid.z_m);
    if (!(off_m < radius_m)) return std::nullopt;
    return std::sqrt(radius_m * radius_m - off_m * off_m);
  }
  const double height_m = solid.sizes.at(1);
  const double foot_m = solid.z_m - height_m / 2;
  if (!(foot_m < top_m && foot_m + height_m > low_m)) return std::nullopt;
  if (solid.kind == "cylinder") return radius_m;
  return radius_m * std::min(1.0, (foot_m + height_m - low_m) / height_m);  // of a cone
}

}  // namespace

double gap_m(const Flat& a, const Flat& b) {
  const double separation =
      std::max(separation_m(a.corners, b.corners), separation_m(b.corners, a.corners));
  double between_m = separation;
  if (!(separation < 0) || std::isinf(separation))
    between_m = std::min(corners_to_edges_m(a.corners, b.corners),
                         corners_to_edges_m(b.corners, a.corners));
  return between_m - a.radius_m - b.radius_m;
}

Flat outline(double x_m, double y_m, double yaw_rad, const RobotShape& robot) {
  return {turned({{robot.front_m, -robot.side_m},
                  {robot.front_m, robot.side_m},
                  {-robot.rear_m, robot.side_m},
                  {-robot.rear_m, -robot.side_m}},
                 x_m, y_m, yaw_rad),
          0};
}

std::optional<Flat> flat(const TrueSolid& solid, const RobotShape& robot) {
  if (solid.kind != "box" && solid.kind != "prism") {
    const auto radius_m = radius_between_m(solid, robot.low_m, robot.top_m);
    if (!radius_m) return std::nullopt;
    return Flat{{{solid.x_m, solid.y_m}}, *radius_m};
  }
  const double height_m = solid.kind == "box" ? solid.sizes.at(2) : solid.sizes.at(0);
  if (!(solid.z_m - height_m / 2 < robot.top_m && solid.z_m + height_m / 2 > robot.low_m))
    return std::nullopt;
  std::vector<Place> corners;
  if (solid.kind == "box") {
    const double x_m = solid.sizes.at(0) / 2;
    const double y_m = solid.sizes.at(1) / 2;
    corners = {{x_m, -y_m}, {x_m, y_m}, {-x_m, y_m}, {-x_m, -y_m}};
  } else {
    for (std::size_t i = 1; i + 1 < solid.sizes.size(); i += 2)
      corners.push_back({solid.sizes[i], solid.sizes[i + 1]});
  }
  return Flat{turned(corners, solid.x_m, solid.y_m, solid.yaw_rad), 0};
}

}  // namespace drover::mission
