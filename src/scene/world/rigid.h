// Rigid motions of the scene: poses of things in frames of other things.
#pragma once

#include <array>

#include "drover/rotation.h"
#include "scene/message/header.h"

namespace drover::scene::rigid {

/// Rows of the turn's matrix.
std::array<Vector3, 3> matrix(const Quaternion& turn);

/// The pose, in the outer pose's parent, of what is at `inner` in the outer pose's own frame.
Pose product(const Pose& outer, const Pose& inner);
/// A point of the pose's own frame in its parent's.
Vector3 in_parent(const Pose& pose, const Vector3& own);
/// A point of the parent's frame in the pose's own.
Vector3 in_own(const Pose& pose, const Vector3& parent);

using scene::is_finite;
bool is_finite(const Pose& pose);

}  // namespace drover::scene::rigid
