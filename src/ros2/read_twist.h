// A message on /cmd_vel as what the base can do. Pure.
#pragma once

#include <geometry_msgs.h>

#include <string>

#include "drover/result.h"
#include "drover/twist.h"

namespace drover::ros2 {

/// Nothing is repaired: a part that no base of ours has must be 0. Otherwise which one, and why.
Result<Twist, std::string> read_twist(const geometry_msgs_msg_dds__Twist_& message);

}  // namespace drover::ros2
