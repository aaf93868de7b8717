// moveit_msgs/Constraints of ROS 1 and the four kinds that it lists.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "scene/message/header.h"
#include "scene/message/shapes.h"

namespace drover::scene {

/// -tolerance_below <= q - position <= tolerance_above, in rad or m. `base/x`, `base/y` and
/// `base/theta` are the robot's place in `map`. Source: moveit_msgs/JointConstraint.
struct JointConstraint {
  std::string joint_name;
  double position = 0;
  double tolerance_above = 0;
  double tolerance_below = 0;
  double weight = 0;  ///< orders what is reported; 0 is 1
};

/// Regions in the frame of a header: their union. Source: moveit_msgs/BoundingVolume.
struct BoundingVolume {
  std::vector<SolidPrimitive> primitives;
  std::vector<Pose> primitive_poses;
  std::vector<Mesh> meshes;  ///< each as its convex hull
  std::vector<Pose> mesh_poses;
};

/// The link's origin, moved by the offset turned with the link, is inside the region.
/// Source: moveit_msgs/PositionConstraint.
struct PositionConstraint {
  Header header;
  std::string link_name;
  Vector3 target_point_offset;
  BoundingVolume constraint_region;
  double weight = 0;
};

/// The link's turn from `orientation`, as intrinsic x, y and z angles, is inside the tolerances.
/// Source: ros-message-types, moveit_msgs 2.
struct OrientationConstraint {
  Header header;
  Quaternion orientation;
  std::string link_name;
  double absolute_x_axis_tolerance = 0;
  double absolute_y_axis_tolerance = 0;
  double absolute_z_axis_tolerance = 0;
  double weight = 0;
};

struct PoseStamped {
  Header header;
  Pose pose;
};

/// A sensor sees a disc: nothing of the robot is in the cone between them.
/// Source: moveit_msgs/VisibilityConstraint.
struct VisibilityConstraint {
  enum Axis : std::uint8_t { SENSOR_Z = 0, SENSOR_Y = 1, SENSOR_X = 2 };
  double target_radius = 0;
  PoseStamped target_pose;
  std::int32_t cone_sides = 0;  ///< fewer than 3: 3
  PoseStamped sensor_pose;
  double max_view_angle = 0;   ///< 0: any
  double max_range_angle = 0;  ///< 0: any
  std::uint8_t sensor_view_direction = SENSOR_Z;
  double weight = 0;
};

/// Satisfied only if all are. Source: ros-message-types, moveit_msgs 3.
struct Constraints {
  std::string name;
  std::vector<JointConstraint> joint_constraints;
  std::vector<PositionConstraint> position_constraints;
  std::vector<OrientationConstraint> orientation_constraints;
  std::vector<VisibilityConstraint> visibility_constraints;
};

}  // namespace drover::scene
