// Vectors and turns in space: right-handed, quaternions of unit length, without matrices.
#pragma once

#include <cmath>

#include "drover/angle.h"
#include "drover/measurement.h"

namespace drover {

inline Vector3 operator+(const Vector3& a, const Vector3& b) {
  return {a.x + b.x, a.y + b.y, a.z + b.z};
}
inline Vector3 operator-(const Vector3& a, const Vector3& b) {
  return {a.x - b.x, a.y - b.y, a.z - b.z};
}
inline Vector3 operator-(const Vector3& v) {
  return {-v.x, -v.y, -v.z};
}
inline Vector3 operator*(double k, const Vector3& v) {
  return {k * v.x, k * v.y, k * v.z};
}
inline double dot(const Vector3& a, const Vector3& b) {
  return a.x * b.x + a.y * b.y + a.z * b.z;
}
inline Vector3 cross(const Vector3& a, const Vector3& b) {
  return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}
inline double length(const Vector3& v) {
  return std::sqrt(dot(v, v));  // std::hypot of three may take a NaN for 0
}

/// First the turn on the right, then that on the left.
inline Quaternion operator*(const Quaternion& a, const Quaternion& b) {
  return {
      a.w * b.w - a.x * b.x - a.y * b.y - a.z * b.z, a.w * b.x + a.x * b.w + a.y * b.z - a.z * b.y,
      a.w * b.y - a.x * b.z + a.y * b.w + a.z * b.x, a.w * b.z + a.x * b.y - a.y * b.x + a.z * b.w};
}
/// The turn back.
inline Quaternion conjugate(const Quaternion& q) {
  return {q.w, -q.x, -q.y, -q.z};
}
inline double length(const Quaternion& q) {
  return std::sqrt(q.w * q.w + q.x * q.x + q.y * q.y + q.z * q.z);
}
inline Quaternion normalised(const Quaternion& q) {
  const double n = length(q);
  return {q.w / n, q.x / n, q.y / n, q.z / n};
}
/// From the turned frame to its parent.
inline Vector3 rotate(const Quaternion& q, const Vector3& v) {
  const Vector3 axis{q.x, q.y, q.z};
  const Vector3 aside = 2 * cross(axis, v);
  return v + (q.w * aside + cross(axis, aside));
}
inline Quaternion about_z(double angle_rad) {
  return {std::cos(angle_rad / 2), 0, 0, std::sin(angle_rad / 2)};
}
/// Order Z, Y, X: yaw first, then pitch, then roll, each about the turned axis; that is roll, pitch
/// and yaw about the axes of the parent (REP 103).
inline Quaternion from_angles(double roll_rad, double pitch_rad, double yaw_rad) {
  const Quaternion pitch{std::cos(pitch_rad / 2), 0, std::sin(pitch_rad / 2), 0};
  const Quaternion roll{std::cos(roll_rad / 2), std::sin(roll_rad / 2), 0, 0};
  return about_z(yaw_rad) * pitch * roll;
}
inline Quaternion from_degrees(double roll_deg, double pitch_deg, double yaw_deg) {
  return from_angles(to_rad(roll_deg), to_rad(pitch_deg), to_rad(yaw_deg));
}
/// About the parent's z, rad.
inline double yaw_of(const Quaternion& q) {
  return std::atan2(2 * (q.w * q.z + q.x * q.y), 1 - 2 * (q.y * q.y + q.z * q.z));
}

}  // namespace drover
