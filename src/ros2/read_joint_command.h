// A message on /joint_command as the JSON that AimRT writes of its protobuf twin, which droverd
// reads as it reads the broker's. Pure.
#pragma once

#include <aimrt_msgs.h>

#include <cstddef>
#include <string>

#include "drover/fixed_text.h"
#include "drover/result.h"

namespace drover::ros2 {

/// Values are droverd's to judge. What is longer than any command of a robot with so many `joints`
/// is refused here: which part, and why.
Result<std::string, Reason> read_joint_command(
    const aimrt_msgs_msg_dds__JointCommandArray_& message, std::size_t joints);

}  // namespace drover::ros2
