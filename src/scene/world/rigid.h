// Turns and rigid motions of the scene: right-handed, quaternions of unit length.
#pragma once

#include <array>

#include "scene/message/header.h"

namespace drover::scene::rigid {

Vector3 sum(const Vector3& a, const Vector3& b);
Vector3 difference(const Vector3& a, const Vector3& b);
Vector3 scaled(const Vector3& v, double factor);
double dot(const Vector3& a, const Vector3& b);
Vector3 cross(const Vector3& a, const Vector3& b);
double length(const Vector3& v);

/// First the inner turn, then the outer one.
Quaternion product(const Quaternion& outer, const Quaternion& inner);
Quaternion back(const Quaternion& turn);
Quaternion unit(const Quaternion& q);
Quaternion about_z(double angle_rad);
/// Roll about x, then pitch about y, then yaw about z, all of the outer frame (REP 103).
Quaternion from_roll_pitch_yaw(double roll_rad, double pitch_rad, double yaw_rad);
Vector3 turned(const Quaternion& turn, const Vector3& v);
/// Rows of the turn's matrix.
std::array<Vector3, 3> matrix(const Quaternion& turn);

/// The pose, in the outer pose's parent, of what is at `inner` in the outer pose's own frame.
Pose product(const Pose& outer, const Pose& inner);
Pose back(const Pose& pose);
/// A point of the pose's own frame in its parent's.
Vector3 in_parent(const Pose& pose, const Vector3& own);
/// A point of the parent's frame in the pose's own.
Vector3 in_own(const Pose& pose, const Vector3& parent);

using scene::is_finite;
bool is_finite(const Pose& pose);

}  // namespace drover::scene::rigid
