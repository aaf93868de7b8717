// Turning vectors and rotations by a unit quaternion.
#pragma once

#include <cmath>

#include "drover/angle.h"
#include "drover/measurement.h"

namespace drover::hipnuc_can {

inline Quaternion operator*(const Quaternion& a, const Quaternion& b) {
  return {
      a.w * b.w - a.x * b.x - a.y * b.y - a.z * b.z, a.w * b.x + a.x * b.w + a.y * b.z - a.z * b.y,
      a.w * b.y - a.x * b.z + a.y * b.w + a.z * b.x, a.w * b.z + a.x * b.y - a.y * b.x + a.z * b.w};
}

inline Quaternion inverse(const Quaternion& q) {
  return {q.w, -q.x, -q.y, -q.z};
}

inline Vector3 rotate(const Quaternion& q, const Vector3& v) {
  const Quaternion turned = q * Quaternion{0, v.x, v.y, v.z} * inverse(q);
  return {turned.x, turned.y, turned.z};
}

/// Roll about x, then pitch about y, then yaw about z, about the axes of the parent.
inline Quaternion from_degrees(double roll_deg, double pitch_deg, double yaw_deg) {
  const auto half = [](double deg) { return to_rad(deg) / 2; };
  const Quaternion roll{std::cos(half(roll_deg)), std::sin(half(roll_deg)), 0, 0};
  const Quaternion pitch{std::cos(half(pitch_deg)), 0, std::sin(half(pitch_deg)), 0};
  const Quaternion yaw{std::cos(half(yaw_deg)), 0, 0, std::sin(half(yaw_deg))};
  return yaw * pitch * roll;
}

}  // namespace drover::hipnuc_can
