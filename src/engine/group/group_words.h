// The sentences that a group of joints says of itself.
#pragma once

#include <span>
#include <vector>

#include "drover/snapshot.h"
#include "engine/group/joint_servo.h"

namespace drover::engine {

/// "elbow: its drive is silent".
Reason of_joint(const Name& joint, const Reason& what);

/// What is wrong with a drive whoever commands it: it is not heard, or has a fault that is more
/// than a want of set points or of supply. Empty: nothing.
Reason trouble_of(const AxisSnapshot& axis, bool heard);

/// What the sender of a stream that was stopped is told.
inline constexpr const char* kPauseFirst =
    "pause your commands for a second, then send again: it was stopped";
bool awaits_pause(std::span<const JointServo> joints);
/// What the sender has to do after a stop, and what that was. Empty: nothing, or nobody sends.
Reason pause_first(std::span<const JointServo> joints, std::span<const AxisSnapshot> axes);

/// `why` behind who is held by nobody any more, where it does not say that itself.
Reason with_lost(std::span<const JointServo> joints, std::span<const AxisSnapshot> axes,
                 const Reason& why);

/// Of one whose drives are off, or come into closed loop, what keeps them from it. Empty: nobody
/// has asked for it.
Reason not_running(std::span<const JointServo> joints, std::span<const AxisSnapshot> axes,
                   GroupState state);

}  // namespace drover::engine
