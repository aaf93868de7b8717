// The four kinds of constraints, each by itself. What cannot be judged does not hold.
#pragma once

#include "scene/constraint/setting.h"
#include "scene/constraint/verdict.h"
#include "scene/message/constraints.h"

namespace drover::scene {

/// Source: moveit_msgs/JointConstraint; `base/x`, `base/y` and `base/theta` are the robot's place.
Finding finding_of(const JointConstraint& joint, const Setting& setting);
/// Source: moveit_msgs/PositionConstraint; the region is the union of its shapes.
Finding finding_of(const PositionConstraint& position, const Setting& setting);
/// Source: ros-message-types, moveit_msgs 2; XYZ_EULER_ANGLES of moveit2's kinematic_constraint.
Finding finding_of(const OrientationConstraint& orientation, const Setting& setting);
/// Source: moveit_msgs/VisibilityConstraint; the robot's own bodies and all objects hide.
Finding finding_of(const VisibilityConstraint& visibility, const Setting& setting);

/// base/x, base/y or base/theta.
bool is_of_base(const JointConstraint& joint);
/// A tolerance of half a turn and more bounds nothing.
bool is_free_axis(double tolerance_rad);

}  // namespace drover::scene
