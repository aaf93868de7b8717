// A robot in a yard, and messages as its neighbours send them.
#pragma once

#include <gtest/gtest.h>

#include <cmath>
#include <string>

#include "drover/angle.h"
#include "drover/rotation.h"
#include "scene/world/world.h"

namespace drover::scene::yard {

inline const GeodeticPoint kOrigin{48.0, 11.0, 500.0};
inline constexpr double kWall0_s = 1'700'000'000;
inline constexpr double kStart_s = 100;  ///< monotonic

inline Stamp stamp_s(double monotonic_s) {
  const double wall_s = kWall0_s + monotonic_s;
  const double whole_s = std::floor(wall_s);
  return {static_cast<std::uint32_t>(whole_s),
          static_cast<std::uint32_t>(std::lround((wall_s - whole_s) * 1e3) * 1'000'000)};
}

inline Pose at(double x_m, double y_m, double z_m = 0, double yaw_rad = 0) {
  return {{x_m, y_m, z_m}, about_z(yaw_rad)};
}

inline SolidPrimitive box(double x_m, double y_m, double z_m) {
  SolidPrimitive shape;
  shape.type = SolidPrimitive::BOX;
  shape.dimensions = {x_m, y_m, z_m};
  return shape;
}

inline CollisionObject add_box(const std::string& id, const Pose& pose,
                               const std::string& frame = "map") {
  CollisionObject message;
  message.id = id;
  message.header.frame_id = frame;
  message.primitives = {box(1, 1, 1)};
  message.primitive_poses = {pose};
  return message;
}

inline CollisionObject only(CollisionObject::Operation operation, const std::string& id) {
  CollisionObject message;
  message.id = id;
  message.operation = operation;
  message.header.frame_id = "map";
  return message;
}

/// A flat roof of so many triangles.
inline Mesh mesh(std::size_t triangles) {
  Mesh shape;
  shape.vertices = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
  shape.triangles.assign(triangles, MeshTriangle{0, 1, 2});
  return shape;
}

struct Yard {
  RobotModel robot;
  PoseHistory poses;
  World world;
  double now_s = kStart_s;
  // How well the robot knows where it is while it drives.
  double position_sigma_m = 0;
  double yaw_sigma_rad = 0;
  std::string late;

  Yard() {
    robot.links.push_back({"lidar", {{0.5, 0, 0.3}, about_z(kPi / 2)}, {}});
    world.move_origin(kOrigin);
  }
  /// The robot drives for `seconds` from where `from` is along x, heading `yaw`.
  void drive(double seconds, double speed_mps, Pose2 from = {}) {
    for (int i = 0; i <= std::lround(seconds * 20); ++i) {
      const double t_s = i * 0.05;
      Pose2 pose = from;
      pose.x_m += speed_mps * t_s * std::cos(from.yaw_rad);
      pose.y_m += speed_mps * t_s * std::sin(from.yaw_rad);
      poses.add(Time{from_s(kStart_s + t_s)}, pose, position_sigma_m, yaw_sigma_rad);
      now_s = kStart_s + t_s;
    }
  }
  Placement placement() const {
    return {robot, poses, Time{from_s(now_s)}, from_s(kWall0_s), late};
  }

  /// "added", ... or "path: why".
  std::string apply(const CollisionObject& message) {
    return in_words(world.apply(message, placement()));
  }
  std::string apply(const Constraints& message) { return in_words(world.apply(message, robot)); }
  Vector3 place_of(const std::string& id, std::size_t i = 0) const {
    const Object* object = world.object(id);
    return object != nullptr && i < object->primitives.size()
               ? object->primitives[i].in_map.position_m
               : Vector3{kAbsent, kAbsent, kAbsent};
  }

  double sigma_of(const std::string& id) const {
    const Object* object = world.object(id);
    return object != nullptr ? object->place_sigma_m : kAbsent;
  }

  static std::string in_words(const Result<Applied, Refusal>& result) {
    if (!result) return result.error().path + ": " + result.error().why;
    switch (result->effect) {
      case Applied::Effect::added: return "added";
      case Applied::Effect::replaced: return "replaced";
      case Applied::Effect::extended: return "extended";
      case Applied::Effect::moved: return "moved";
      case Applied::Effect::removed: return "removed";
    }
    return "";
  }
};

inline void expect_at(const Vector3& is, double x_m, double y_m, double z_m,
                      double within_m = 1e-9) {
  EXPECT_NEAR(is.x, x_m, within_m);
  EXPECT_NEAR(is.y, y_m, within_m);
  EXPECT_NEAR(is.z, z_m, within_m);
}

}  // namespace drover::scene::yard
