// Points, poses and circles of the plane: `map`, metres and radians.
#pragma once

#include <cmath>

namespace drover::scene {

/// A point or a free vector.
struct Point2 {
  double x_m = 0;
  double y_m = 0;
  friend bool operator==(const Point2&, const Point2&) = default;
};
inline Point2 operator+(Point2 a, Point2 b) {
  return {a.x_m + b.x_m, a.y_m + b.y_m};
}
inline Point2 operator-(Point2 a, Point2 b) {
  return {a.x_m - b.x_m, a.y_m - b.y_m};
}
inline Point2 operator*(double k, Point2 a) {
  return {k * a.x_m, k * a.y_m};
}
inline double dot(Point2 a, Point2 b) {
  return a.x_m * b.x_m + a.y_m * b.y_m;
}
/// Positive when `b` points to the left of `a`.
inline double cross(Point2 a, Point2 b) {
  return a.x_m * b.y_m - a.y_m * b.x_m;
}
inline double squared(Point2 a) {
  return dot(a, a);
}
inline double length_m(Point2 a) {
  return std::sqrt(squared(a));
}
inline bool is_finite(Point2 a) {
  return std::isfinite(a.x_m) && std::isfinite(a.y_m);
}
inline Point2 direction(double yaw_rad) {
  return {std::cos(yaw_rad), std::sin(yaw_rad)};
}

/// Where base_link is in `map`; yaw counter-clockwise from x.
struct Pose2 {
  double x_m = 0;
  double y_m = 0;
  double yaw_rad = 0;
  friend bool operator==(const Pose2&, const Pose2&) = default;
};
inline Point2 place_of(const Pose2& pose) {
  return {pose.x_m, pose.y_m};
}
inline bool is_finite(const Pose2& pose) {
  return is_finite(place_of(pose)) && std::isfinite(pose.yaw_rad);
}

/// A bound around something. Infinite where that has no end.
struct Circle {
  Point2 centre;
  double radius_m = 0;
};
/// What is not a number is not apart from anything.
inline bool apart(const Circle& a, const Circle& b) {
  const double reach_m = a.radius_m + b.radius_m;
  return squared(a.centre - b.centre) > reach_m * reach_m;
}

}  // namespace drover::scene
