// Messages of the planning scene as ROS 2 has them, as the JSON of their twins on MQTT, which
// droverd reads as it reads the broker's. Pure.
#pragma once

#include <moveit_msgs.h>

#include <string>

#include "drover/result.h"

namespace drover::ros2 {

/// What is wrong with a message, and where in it.
struct SceneRefusal {
  std::string path;  ///< like `primitives[2].dimensions[0]`; empty: the message as a whole
  std::string why;
};

/// The object's own pose is in the poses of its shapes, as MQTT's form has none. Refused is what
/// JSON cannot say (numbers that are not finite, texts that are no UTF-8) and what that form cannot
/// (a MOVE by the object's pose alone); everything else is droverd's to judge.
Result<std::string, SceneRefusal> read_collision_object(
    const moveit_msgs_msg_dds__CollisionObject_& message);
Result<std::string, SceneRefusal> read_constraints(
    const moveit_msgs_msg_dds__Constraints_& message);

}  // namespace drover::ros2
