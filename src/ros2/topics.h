// The topics that drover-ros2 writes and hears: names, types, type hashes and qualities of service,
// as ROS 2 makes them itself.
#pragma once

#include <array>
#include <string>

#include "ros2/convert.h"

namespace drover::ros2 {

/// How many samples wait for a reader, and for whom they are kept.
enum class Kept : std::uint8_t {
  last,       ///< the newest one
  few,        ///< the newest five
  hundred,    ///< of frames
  for_later,  ///< the newest one, also for a reader that comes later
};

struct TopicKind {
  const char* name = nullptr;
  const dds_topic_descriptor_t* type = nullptr;
  const char* hash = nullptr;  ///< of the type's description, 64 hex digits
  Kept kept = Kept::last;
};

enum class Topic : std::uint8_t {
  joint_states,
  joint_state,
  imu,
  fix,
  odom,
  rtk_pose,
  tf,
  tf_static,
  battery_state,
  scan,
  diagnostics,
  touch_state,
};
inline constexpr std::size_t kTopicCount = 12;

/// By Topic.
const std::array<TopicKind, kTopicCount>& topic_kinds();

/// std_msgs/Bool, heard and not written.
const TopicKind& stop_kind();

/// geometry_msgs/Twist or TwistStamped, likewise.
const TopicKind& cmd_vel_kind(bool stamped);

/// aimrt_msgs/JointCommandArray, likewise.
const TopicKind& joint_command_kind();

/// moveit_msgs/CollisionObject and Constraints, likewise.
const TopicKind& collision_object_kind();
const TopicKind& planning_constraints_kind();

/// What ROS 2 of Iron and later reads of an endpoint: "typehash=RIHS01_...;".
std::string hash_user_data(const char* hash);

}  // namespace drover::ros2
