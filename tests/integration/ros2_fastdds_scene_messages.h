// Those of the planning scene, written down as ros2_fastdds_messages.h is.
#pragma once

#include "integration/ros2_fastdds_messages.h"

namespace drover::test::fast {

// shape_msgs, object_recognition_msgs, moveit_msgs
struct Point32 {
  float x = 0;
  float y = 0;
  float z = 0;
  static auto parts(auto& m) { return std::tie(m.x, m.y, m.z); }
};
struct Polygon {
  std::vector<Point32> points;
  static auto parts(auto& m) { return std::tie(m.points); }
};
struct PoseStamped {
  Header header;
  Pose pose;
  static auto parts(auto& m) { return std::tie(m.header, m.pose); }
};
struct SolidPrimitive {
  std::uint8_t type = 0;
  std::vector<double> dimensions;  ///< three at most
  Polygon polygon;
  static auto parts(auto& m) { return std::tie(m.type, m.dimensions, m.polygon); }
};
struct MeshTriangle {
  std::array<std::uint32_t, 3> vertex_indices{};
  static auto parts(auto& m) { return std::tie(m.vertex_indices); }
};
struct Mesh {
  std::vector<MeshTriangle> triangles;
  std::vector<Vector3> vertices;
  static auto parts(auto& m) { return std::tie(m.triangles, m.vertices); }
};
struct Plane {
  std::array<double, 4> coef{};
  static auto parts(auto& m) { return std::tie(m.coef); }
};
struct ObjectType {
  std::string key;
  std::string db;
  static auto parts(auto& m) { return std::tie(m.key, m.db); }
};
struct CollisionObject {
  static constexpr const char* kType = "moveit_msgs::msg::dds_::CollisionObject_";
  Header header;
  Pose pose;
  std::string id;
  ObjectType type;
  std::vector<SolidPrimitive> primitives;
  std::vector<Pose> primitive_poses;
  std::vector<Mesh> meshes;
  std::vector<Pose> mesh_poses;
  std::vector<Plane> planes;
  std::vector<Pose> plane_poses;
  std::vector<std::string> subframe_names;
  std::vector<Pose> subframe_poses;
  std::uint8_t operation = 0;
  static auto parts(auto& m) {
    return std::tie(m.header, m.pose, m.id, m.type, m.primitives, m.primitive_poses, m.meshes,
                    m.mesh_poses, m.planes, m.plane_poses, m.subframe_names, m.subframe_poses,
                    m.operation);
  }
};
struct JointConstraint {
  std::string joint_name;
  double position = 0;
  double tolerance_above = 0;
  double tolerance_below = 0;
  double weight = 0;
  static auto parts(auto& m) {
    return std::tie(m.joint_name, m.position, m.tolerance_above, m.tolerance_below, m.weight);
  }
};
struct BoundingVolume {
  std::vector<SolidPrimitive> primitives;
  std::vector<Pose> primitive_poses;
  std::vector<Mesh> meshes;
  std::vector<Pose> mesh_poses;
  static auto parts(auto& m) {
    return std::tie(m.primitives, m.primitive_poses, m.meshes, m.mesh_poses);
  }
};
struct PositionConstraint {
  Header header;
  std::string link_name;
  Vector3 target_point_offset;
  BoundingVolume constraint_region;
  double weight = 0;
  static auto parts(auto& m) {
    return std::tie(m.header, m.link_name, m.target_point_offset, m.constraint_region, m.weight);
  }
};
struct OrientationConstraint {
  Header header;
  Quaternion orientation;
  std::string link_name;
  double absolute_x_axis_tolerance = 0;
  double absolute_y_axis_tolerance = 0;
  double absolute_z_axis_tolerance = 0;
  std::uint8_t parameterization = 0;
  double weight = 0;
  static auto parts(auto& m) {
    return std::tie(m.header, m.orientation, m.link_name, m.absolute_x_axis_tolerance,
                    m.absolute_y_axis_tolerance, m.absolute_z_axis_tolerance, m.parameterization,
                    m.weight);
  }
};
struct VisibilityConstraint {
  double target_radius = 0;
  PoseStamped target_pose;
  std::int32_t cone_sides = 0;
  PoseStamped sensor_pose;
  double max_view_angle = 0;
  double max_range_angle = 0;
  std::uint8_t sensor_view_direction = 0;
  double weight = 0;
  static auto parts(auto& m) {
    return std::tie(m.target_radius, m.target_pose, m.cone_sides, m.sensor_pose, m.max_view_angle,
                    m.max_range_angle, m.sensor_view_direction, m.weight);
  }
};
struct Constraints {
  static constexpr const char* kType = "moveit_msgs::msg::dds_::Constraints_";
  std::string name;
  std::vector<JointConstraint> joint_constraints;
  std::vector<PositionConstraint> position_constraints;
  std::vector<OrientationConstraint> orientation_constraints;
  std::vector<VisibilityConstraint> visibility_constraints;
  static auto parts(auto& m) {
    return std::tie(m.name, m.joint_constraints, m.position_constraints, m.orientation_constraints,
                    m.visibility_constraints);
  }
};

}  // namespace drover::test::fast
