// A turn and a move in space, for shapes on their way into the plane.
#pragma once

#include "scene/message/header.h"

namespace drover::scene {

/// `map` = turn * shape + move.
struct Motion3 {
  Vector3 x_axis;  ///< of the shape, in `map`
  Vector3 y_axis;
  Vector3 z_axis;
  Vector3 move_m;
};

/// The quaternion need not be of unit length; all zero is no turn.
Motion3 motion_of(const Pose& pose);
Vector3 turned(const Motion3& motion, const Vector3& v);
Vector3 moved(const Motion3& motion, const Vector3& point_m);
bool is_finite(const Motion3& motion);

}  // namespace drover::scene
