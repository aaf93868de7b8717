// The messages of ros2_fastdds_messages.h as values of our own types, which idlc makes.
#pragma once

#include <moveit_msgs.h>

#include "integration/ros2_fastdds_scene_messages.h"
#include "ros2/arena.h"
#include "ros2/topics.h"

namespace drover::test {

class Ours {
 public:
  char* of(const std::string& text) { return arena_.text(text); }
  template <class T, std::size_t kSize>
  static void copy(T (&to)[kSize], const std::array<T, kSize>& from) {
    std::copy(from.begin(), from.end(), to);
  }
  template <class Sequence, class T>
  void list(Sequence& to, const std::vector<T>& from) {
    auto* one = arena_.fill(to, from.size());
    for (const auto& value : from) {
      if constexpr (std::is_arithmetic_v<T>)
        *one++ = value;
      else
        *one++ = of(value);
    }
  }

  static builtin_interfaces_msg_dds__Time_ of(const fast::Time& m) {
    builtin_interfaces_msg_dds__Time_ o{};
    o.sec_ = m.sec;
    o.nanosec_ = m.nanosec;
    return o;
  }
  std_msgs_msg_dds__Header_ of(const fast::Header& m) {
    std_msgs_msg_dds__Header_ o{};
    o.stamp_ = of(m.stamp);
    o.frame_id_ = of(m.frame_id);
    return o;
  }
  static std_msgs_msg_dds__Bool_ of(const fast::Bool& m) { return {m.data}; }
  static geometry_msgs_msg_dds__Vector3_ of(const fast::Vector3& m) {
    geometry_msgs_msg_dds__Vector3_ o{};
    o.x_ = m.x;
    o.y_ = m.y;
    o.z_ = m.z;
    return o;
  }
  static geometry_msgs_msg_dds__Quaternion_ of(const fast::Quaternion& m) {
    geometry_msgs_msg_dds__Quaternion_ o{};
    o.x_ = m.x;
    o.y_ = m.y;
    o.z_ = m.z;
    o.w_ = m.w;
    return o;
  }
  static geometry_msgs_msg_dds__Pose_ of(const fast::Pose& m) {
    geometry_msgs_msg_dds__Pose_ o{};
    o.position_ = {m.position.x, m.position.y, m.position.z};
    o.orientation_ = of(m.orientation);
    return o;
  }
  static geometry_msgs_msg_dds__PoseWithCovariance_ of(const fast::PoseWithCovariance& m) {
    geometry_msgs_msg_dds__PoseWithCovariance_ o{};
    o.pose_ = of(m.pose);
    copy(o.covariance_, m.covariance);
    return o;
  }
  geometry_msgs_msg_dds__PoseWithCovarianceStamped_ of(const fast::PoseWithCovarianceStamped& m) {
    geometry_msgs_msg_dds__PoseWithCovarianceStamped_ o{};
    o.header_ = of(m.header);
    o.pose_ = of(m.pose);
    return o;
  }
  static geometry_msgs_msg_dds__Twist_ of(const fast::Twist& m) {
    geometry_msgs_msg_dds__Twist_ o{};
    o.linear_ = of(m.linear);
    o.angular_ = of(m.angular);
    return o;
  }
  geometry_msgs_msg_dds__TwistStamped_ of(const fast::TwistStamped& m) {
    geometry_msgs_msg_dds__TwistStamped_ o{};
    o.header_ = of(m.header);
    o.twist_ = of(m.twist);
    return o;
  }
  nav_msgs_msg_dds__Odometry_ of(const fast::Odometry& m) {
    nav_msgs_msg_dds__Odometry_ o{};
    o.header_ = of(m.header);
    o.child_frame_id_ = of(m.child_frame_id);
    o.pose_ = of(m.pose);
    o.twist_.twist_ = of(m.twist.twist);
    copy(o.twist_.covariance_, m.twist.covariance);
    return o;
  }
  geometry_msgs_msg_dds__TransformStamped_ of(const fast::TransformStamped& m) {
    geometry_msgs_msg_dds__TransformStamped_ o{};
    o.header_ = of(m.header);
    o.child_frame_id_ = of(m.child_frame_id);
    o.transform_.translation_ = of(m.transform.translation);
    o.transform_.rotation_ = of(m.transform.rotation);
    return o;
  }
  tf2_msgs_msg_dds__TFMessage_ of(const fast::TFMessage& m) {
    tf2_msgs_msg_dds__TFMessage_ o{};
    list(o.transforms_, m.transforms);
    return o;
  }
  sensor_msgs_msg_dds__JointState_ of(const fast::JointState& m) {
    sensor_msgs_msg_dds__JointState_ o{};
    o.header_ = of(m.header);
    list(o.name_, m.name);
    list(o.position_, m.position);
    list(o.velocity_, m.velocity);
    list(o.effort_, m.effort);
    return o;
  }
  sensor_msgs_msg_dds__Imu_ of(const fast::Imu& m) {
    sensor_msgs_msg_dds__Imu_ o{};
    o.header_ = of(m.header);
    o.orientation_ = of(m.orientation);
    copy(o.orientation_covariance_, m.orientation_covariance);
    o.angular_velocity_ = of(m.angular_velocity);
    copy(o.angular_velocity_covariance_, m.angular_velocity_covariance);
    o.linear_acceleration_ = of(m.linear_acceleration);
    copy(o.linear_acceleration_covariance_, m.linear_acceleration_covariance);
    return o;
  }
  sensor_msgs_msg_dds__NavSatFix_ of(const fast::NavSatFix& m) {
    sensor_msgs_msg_dds__NavSatFix_ o{};
    o.header_ = of(m.header);
    o.status_.status_ = m.status.status;
    o.status_.service_ = m.status.service;
    o.latitude_ = m.latitude;
    o.longitude_ = m.longitude;
    o.altitude_ = m.altitude;
    copy(o.position_covariance_, m.position_covariance);
    o.position_covariance_type_ = m.position_covariance_type;
    return o;
  }
  sensor_msgs_msg_dds__BatteryState_ of(const fast::BatteryState& m) {
    sensor_msgs_msg_dds__BatteryState_ o{};
    o.header_ = of(m.header);
    o.voltage_ = m.voltage;
    o.temperature_ = m.temperature;
    o.current_ = m.current;
    o.charge_ = m.charge;
    o.capacity_ = m.capacity;
    o.design_capacity_ = m.design_capacity;
    o.percentage_ = m.percentage;
    o.power_supply_status_ = m.power_supply_status;
    o.power_supply_health_ = m.power_supply_health;
    o.power_supply_technology_ = m.power_supply_technology;
    o.present_ = m.present;
    list(o.cell_voltage_, m.cell_voltage);
    list(o.cell_temperature_, m.cell_temperature);
    o.location_ = of(m.location);
    o.serial_number_ = of(m.serial_number);
    return o;
  }
  sensor_msgs_msg_dds__LaserScan_ of(const fast::LaserScan& m) {
    sensor_msgs_msg_dds__LaserScan_ o{};
    o.header_ = of(m.header);
    o.angle_min_ = m.angle_min;
    o.angle_max_ = m.angle_max;
    o.angle_increment_ = m.angle_increment;
    o.time_increment_ = m.time_increment;
    o.scan_time_ = m.scan_time;
    o.range_min_ = m.range_min;
    o.range_max_ = m.range_max;
    list(o.ranges_, m.ranges);
    list(o.intensities_, m.intensities);
    return o;
  }
  diagnostic_msgs_msg_dds__KeyValue_ of(const fast::KeyValue& m) {
    diagnostic_msgs_msg_dds__KeyValue_ o{};
    o.key_ = of(m.key);
    o.value_ = of(m.value);
    return o;
  }
  diagnostic_msgs_msg_dds__DiagnosticStatus_ of(const fast::DiagnosticStatus& m) {
    diagnostic_msgs_msg_dds__DiagnosticStatus_ o{};
    o.level_ = m.level;
    o.name_ = of(m.name);
    o.message_ = of(m.message);
    o.hardware_id_ = of(m.hardware_id);
    list(o.values_, m.values);
    return o;
  }
  diagnostic_msgs_msg_dds__DiagnosticArray_ of(const fast::DiagnosticArray& m) {
    diagnostic_msgs_msg_dds__DiagnosticArray_ o{};
    o.header_ = of(m.header);
    list(o.status_, m.status);
    return o;
  }
  aimrt_msgs_msg_dds__MessageHeader_ of(const fast::MessageHeader& m) {
    aimrt_msgs_msg_dds__MessageHeader_ o{};
    o.stamp_ = of(m.stamp);
    o.frame_id_ = of(m.frame_id);
    o.sequence_ = m.sequence;
    return o;
  }
  aimrt_msgs_msg_dds__JointState_ of(const fast::AimrtJoint& m) {
    aimrt_msgs_msg_dds__JointState_ o{};
    o.name_ = of(m.name);
    o.position_ = m.position;
    o.velocity_ = m.velocity;
    o.effort_ = m.effort;
    return o;
  }
  aimrt_msgs_msg_dds__JointStateArray_ of(const fast::JointStateArray& m) {
    aimrt_msgs_msg_dds__JointStateArray_ o{};
    o.header_ = of(m.header);
    list(o.joints_, m.joints);
    return o;
  }
  aimrt_msgs_msg_dds__JointCommand_ of(const fast::AimrtJointCommand& m) {
    aimrt_msgs_msg_dds__JointCommand_ o{};
    o.name_ = of(m.name);
    o.position_ = m.position;
    o.velocity_ = m.velocity;
    o.effort_ = m.effort;
    o.stiffness_ = m.stiffness;
    o.damping_ = m.damping;
    return o;
  }
  aimrt_msgs_msg_dds__JointCommandArray_ of(const fast::JointCommandArray& m) {
    aimrt_msgs_msg_dds__JointCommandArray_ o{};
    o.header_ = of(m.header);
    list(o.joints_, m.joints);
    return o;
  }
  aimrt_msgs_msg_dds__TouchSensorState_ of(const fast::TouchSensorState& m) {
    aimrt_msgs_msg_dds__TouchSensorState_ o{};
    list(o.pressure_, m.pressure);
    return o;
  }
  aimrt_msgs_msg_dds__TouchSensorStateArray_ of(const fast::TouchSensorStateArray& m) {
    aimrt_msgs_msg_dds__TouchSensorStateArray_ o{};
    o.header_ = of(m.header);
    list(o.names_, m.names);
    list(o.states_, m.states);
    return o;
  }
  geometry_msgs_msg_dds__PoseStamped_ of(const fast::PoseStamped& m) {
    geometry_msgs_msg_dds__PoseStamped_ o{};
    o.header_ = of(m.header);
    o.pose_ = of(m.pose);
    return o;
  }
  shape_msgs_msg_dds__SolidPrimitive_ of(const fast::SolidPrimitive& m) {
    shape_msgs_msg_dds__SolidPrimitive_ o{};
    o.type_ = m.type;
    list(o.dimensions_, m.dimensions);
    o.dimensions_._maximum = 3;
    auto* point = arena_.fill(o.polygon_.points_, m.polygon.points.size());
    for (const auto& from : m.polygon.points) {
      point->x_ = from.x;
      point->y_ = from.y;
      (point++)->z_ = from.z;
    }
    return o;
  }
  shape_msgs_msg_dds__Mesh_ of(const fast::Mesh& m) {
    shape_msgs_msg_dds__Mesh_ o{};
    auto* triangle = arena_.fill(o.triangles_, m.triangles.size());
    for (const auto& from : m.triangles) copy((triangle++)->vertex_indices_, from.vertex_indices);
    auto* vertex = arena_.fill(o.vertices_, m.vertices.size());
    for (const auto& from : m.vertices) {
      vertex->x_ = from.x;
      vertex->y_ = from.y;
      (vertex++)->z_ = from.z;
    }
    return o;
  }
  static shape_msgs_msg_dds__Plane_ of(const fast::Plane& m) {
    shape_msgs_msg_dds__Plane_ o{};
    copy(o.coef_, m.coef);
    return o;
  }
  moveit_msgs_msg_dds__CollisionObject_ of(const fast::CollisionObject& m) {
    moveit_msgs_msg_dds__CollisionObject_ o{};
    o.header_ = of(m.header);
    o.pose_ = of(m.pose);
    o.id_ = of(m.id);
    o.type_.key_ = of(m.type.key);
    o.type_.db_ = of(m.type.db);
    list(o.primitives_, m.primitives);
    list(o.primitive_poses_, m.primitive_poses);
    list(o.meshes_, m.meshes);
    list(o.mesh_poses_, m.mesh_poses);
    list(o.planes_, m.planes);
    list(o.plane_poses_, m.plane_poses);
    list(o.subframe_names_, m.subframe_names);
    list(o.subframe_poses_, m.subframe_poses);
    o.operation_ = m.operation;
    return o;
  }
  moveit_msgs_msg_dds__JointConstraint_ of(const fast::JointConstraint& m) {
    moveit_msgs_msg_dds__JointConstraint_ o{};
    o.joint_name_ = of(m.joint_name);
    o.position_ = m.position;
    o.tolerance_above_ = m.tolerance_above;
    o.tolerance_below_ = m.tolerance_below;
    o.weight_ = m.weight;
    return o;
  }
  moveit_msgs_msg_dds__PositionConstraint_ of(const fast::PositionConstraint& m) {
    moveit_msgs_msg_dds__PositionConstraint_ o{};
    o.header_ = of(m.header);
    o.link_name_ = of(m.link_name);
    o.target_point_offset_ = of(m.target_point_offset);
    list(o.constraint_region_.primitives_, m.constraint_region.primitives);
    list(o.constraint_region_.primitive_poses_, m.constraint_region.primitive_poses);
    list(o.constraint_region_.meshes_, m.constraint_region.meshes);
    list(o.constraint_region_.mesh_poses_, m.constraint_region.mesh_poses);
    o.weight_ = m.weight;
    return o;
  }
  moveit_msgs_msg_dds__OrientationConstraint_ of(const fast::OrientationConstraint& m) {
    moveit_msgs_msg_dds__OrientationConstraint_ o{};
    o.header_ = of(m.header);
    o.orientation_ = of(m.orientation);
    o.link_name_ = of(m.link_name);
    o.absolute_x_axis_tolerance_ = m.absolute_x_axis_tolerance;
    o.absolute_y_axis_tolerance_ = m.absolute_y_axis_tolerance;
    o.absolute_z_axis_tolerance_ = m.absolute_z_axis_tolerance;
    o.parameterization_ = m.parameterization;
    o.weight_ = m.weight;
    return o;
  }
  moveit_msgs_msg_dds__VisibilityConstraint_ of(const fast::VisibilityConstraint& m) {
    moveit_msgs_msg_dds__VisibilityConstraint_ o{};
    o.target_radius_ = m.target_radius;
    o.target_pose_ = of(m.target_pose);
    o.cone_sides_ = m.cone_sides;
    o.sensor_pose_ = of(m.sensor_pose);
    o.max_view_angle_ = m.max_view_angle;
    o.max_range_angle_ = m.max_range_angle;
    o.sensor_view_direction_ = m.sensor_view_direction;
    o.weight_ = m.weight;
    return o;
  }
  moveit_msgs_msg_dds__Constraints_ of(const fast::Constraints& m) {
    moveit_msgs_msg_dds__Constraints_ o{};
    o.name_ = of(m.name);
    list(o.joint_constraints_, m.joint_constraints);
    list(o.position_constraints_, m.position_constraints);
    list(o.orientation_constraints_, m.orientation_constraints);
    list(o.visibility_constraints_, m.visibility_constraints);
    return o;
  }

 private:
  ros2::Arena arena_;
};

}  // namespace drover::test
