// Poses of the base put together: the estimate knows the plane only.
#pragma once

#include "scene/message/header.h"
#include "scene/plane/point.h"

namespace drover::scene {

/// On the ground, which is z = 0, and level.
Pose upright(const Pose2& pose);
/// In the outer pose's parent, what is at `inner` in its own frame.
Pose2 product(const Pose2& outer, const Pose2& inner);
Pose2 back(const Pose2& pose);

}  // namespace drover::scene
