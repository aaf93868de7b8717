#include "scene/world/rigid.h"

#include <cmath>

namespace drover::scene::rigid {

Vector3 sum(const Vector3& a, const Vector3& b) {
  return {a.x + b.x, a.y + b.y, a.z + b.z};
}

Vector3 difference(const Vector3& a, const Vector3& b) {
  return {a.x - b.x, a.y - b.y, a.z - b.z};
}

Vector3 scaled(const Vector3& v, double factor) {
  return {v.x * factor, v.y * factor, v.z * factor};
}

double dot(const Vector3& a, const Vector3& b) {
  return a.x * b.x + a.y * b.y + a.z * b.z;
}

Vector3 cross(const Vector3& a, const Vector3& b) {
  return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}

double length(const Vector3& v) {
  return std::sqrt(dot(v, v));  // std::hypot of three may take a NaN for 0
}

Quaternion product(const Quaternion& outer, const Quaternion& inner) {
  const Quaternion& a = outer;
  const Quaternion& b = inner;
  return {
      a.w * b.w - a.x * b.x - a.y * b.y - a.z * b.z, a.w * b.x + a.x * b.w + a.y * b.z - a.z * b.y,
      a.w * b.y - a.x * b.z + a.y * b.w + a.z * b.x, a.w * b.z + a.x * b.y - a.y * b.x + a.z * b.w};
}

Quaternion back(const Quaternion& turn) {
  return {turn.w, -turn.x, -turn.y, -turn.z};
}

Quaternion unit(const Quaternion& q) {
  const double n = std::sqrt(q.w * q.w + q.x * q.x + q.y * q.y + q.z * q.z);
  return {q.w / n, q.x / n, q.y / n, q.z / n};
}

Quaternion about_z(double angle_rad) {
  return {std::cos(angle_rad / 2), 0, 0, std::sin(angle_rad / 2)};
}

Quaternion from_roll_pitch_yaw(double roll_rad, double pitch_rad, double yaw_rad) {
  const Quaternion roll{std::cos(roll_rad / 2), std::sin(roll_rad / 2), 0, 0};
  const Quaternion pitch{std::cos(pitch_rad / 2), 0, std::sin(pitch_rad / 2), 0};
  return product(about_z(yaw_rad), product(pitch, roll));
}

Vector3 turned(const Quaternion& turn, const Vector3& v) {
  const Vector3 axis{turn.x, turn.y, turn.z};
  const Vector3 t = scaled(cross(axis, v), 2);
  return sum(v, sum(scaled(t, turn.w), cross(axis, t)));
}

std::array<Vector3, 3> matrix(const Quaternion& turn) {
  const Vector3 x = turned(turn, {1, 0, 0});
  const Vector3 y = turned(turn, {0, 1, 0});
  const Vector3 z = turned(turn, {0, 0, 1});
  return {{{x.x, y.x, z.x}, {x.y, y.y, z.y}, {x.z, y.z, z.z}}};
}

Pose product(const Pose& outer, const Pose& inner) {
  return {in_parent(outer, inner.position_m), product(outer.orientation, inner.orientation)};
}

Pose back(const Pose& pose) {
  const Quaternion turn = back(pose.orientation);
  return {scaled(turned(turn, pose.position_m), -1), turn};
}

Vector3 in_parent(const Pose& pose, const Vector3& own) {
  return sum(pose.position_m, turned(pose.orientation, own));
}

Vector3 in_own(const Pose& pose, const Vector3& parent) {
  return turned(back(pose.orientation), difference(parent, pose.position_m));
}

bool is_finite(const Pose& pose) {
  const Quaternion& q = pose.orientation;
  return is_finite(pose.position_m) && std::isfinite(q.w) && std::isfinite(q.x) &&
         std::isfinite(q.y) && std::isfinite(q.z);
}

}  // namespace drover::scene::rigid
