// Shapes, turns and a robot as the tests of the plane have them.
#pragma once

#include <cmath>
#include <initializer_list>
#include <vector>

#include "scene/plane/areas.h"
#include "scene/plane/overlap.h"

namespace drover::scene {

/// Drives over 5 cm, is 0.6 m high.
inline constexpr Heights kRobot{0.05, 0.6};

/// 0.9 m long and 0.7 m wide about base_link.
inline Piece footprint(double margin_m = 0) {
  return piece_of({{-0.45, -0.35}, {0.45, -0.35}, {0.45, 0.35}, {-0.45, 0.35}}, margin_m);
}

inline Pose pose(double x_m, double y_m, double z_m, Quaternion turn = {}) {
  return {{x_m, y_m, z_m}, turn};
}
inline Quaternion about_x(double angle_rad) {
  return {std::cos(angle_rad / 2), std::sin(angle_rad / 2), 0, 0};
}
inline Quaternion about_y(double angle_rad) {
  return {std::cos(angle_rad / 2), 0, std::sin(angle_rad / 2), 0};
}
inline Quaternion about_z(double angle_rad) {
  return {std::cos(angle_rad / 2), 0, 0, std::sin(angle_rad / 2)};
}

inline SolidPrimitive box(double x_m, double y_m, double z_m) {
  return {SolidPrimitive::BOX, {x_m, y_m, z_m}};
}
inline SolidPrimitive sphere(double radius_m) {
  return {SolidPrimitive::SPHERE, {radius_m}};
}
inline SolidPrimitive cylinder(double height_m, double radius_m) {
  return {SolidPrimitive::CYLINDER, {height_m, radius_m}};
}
inline SolidPrimitive cone(double height_m, double radius_m) {
  return {SolidPrimitive::CONE, {height_m, radius_m}};
}

/// A ring (counter-clockwise from above) pulled up from one height to another: closed, with lid and
/// floor as a fan about its first corner, so star-shaped about that.
inline Mesh pulled_up(const std::vector<Point2>& ring, double low_m, double high_m) {
  Mesh mesh;
  for (const Point2 p : ring) mesh.vertices.push_back({p.x_m, p.y_m, low_m});
  for (const Point2 p : ring) mesh.vertices.push_back({p.x_m, p.y_m, high_m});
  const auto count = static_cast<std::uint32_t>(ring.size());
  for (std::uint32_t i = 0; i < count; ++i) {
    const std::uint32_t next = (i + 1) % count;
    mesh.triangles.push_back({i, next, count + next});
    mesh.triangles.push_back({i, count + next, count + i});
    if (i == 0 || next == 0) continue;
    mesh.triangles.push_back({0, next, i});
    mesh.triangles.push_back({count, count + i, count + next});
  }
  return mesh;
}
inline Mesh box_mesh(double half_m, double low_m, double high_m) {
  return pulled_up({{-half_m, -half_m}, {half_m, -half_m}, {half_m, half_m}, {-half_m, half_m}},
                   low_m, high_m);
}

/// A point, as a body to test with.
inline bool covers(const Area& area, double x_m, double y_m) {
  return overlaps(disc({x_m, y_m}, 0), area);
}

}  // namespace drover::scene
