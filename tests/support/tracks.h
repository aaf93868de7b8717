// Tracks drawn with a pen and recorded as operators do.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <random>
#include <vector>

#include "drover/angle.h"
#include "drover/path.h"
#include "track/path_geometry.h"

namespace drover::test {

using Points = std::vector<PathPoint>;

/// Draws a line in points 1 cm apart, beginning at the origin to the east.
class Pen final {
 public:
  Pen& line(double length_m) {
    const int steps = static_cast<int>(std::lround(length_m / 0.01));
    for (int i = 0; i < steps; ++i) go(length_m / steps, 0);
    return *this;
  }
  /// Left for a positive angle.
  Pen& arc(double radius_m, double angle_rad) {
    const double length_m = radius_m * std::abs(angle_rad);
    const int steps = static_cast<int>(std::lround(length_m / 0.01));
    for (int i = 0; i < steps; ++i) go(length_m / steps, angle_rad / steps);
    return *this;
  }
  Pen& turn(double angle_rad) {
    yaw_rad_ += angle_rad;
    return *this;
  }
  const Points& points() const { return points_; }

 private:
  void go(double step_m, double turn_rad) {
    yaw_rad_ += turn_rad / 2;
    const PathPoint& p = points_.back();
    points_.push_back({p.x_m + step_m * std::cos(yaw_rad_), p.y_m + step_m * std::sin(yaw_rad_)});
    yaw_rad_ += turn_rad / 2;
  }
  Points points_{{0, 0}};
  double yaw_rad_ = 0;
};

/// One point each `spacing_m` and the last, as a client records them.
inline Path record(const Points& drawn, double spacing_m = 0.5, double noise_m = 0,
                   unsigned seed = 1) {
  std::mt19937 random(seed);
  // Twelve uniform numbers: near enough to normal, and the same in every library.
  const auto noise = [&] {
    double sum = -6;
    for (int i = 0; i < 12; ++i) sum += static_cast<double>(random()) / 4294967296.0;
    return noise_m * sum;
  };
  Path path;
  double since_m = spacing_m;
  for (std::size_t i = 0; i < drawn.size(); ++i) {
    if (i > 0) {
      since_m += std::hypot(drawn[i].x_m - drawn[i - 1].x_m, drawn[i].y_m - drawn[i - 1].y_m);
    }
    if (since_m < spacing_m - 1e-9 && i + 1 < drawn.size()) continue;
    path.points.push_back({drawn[i].x_m + noise(), drawn[i].y_m + noise()});
    since_m = 0;
  }
  return path;
}

/// Where it turns by more than 120 degrees it goes on the other way.
inline Path with_gears(Path path, bool first_backwards = false, bool either = false) {
  std::uint8_t back = first_backwards ? 1 : 0;
  for (std::size_t i = 0; i + 1 < path.points.size(); ++i) {
    if (i > 0) {
      const track::Vector before{path.points[i].x_m - path.points[i - 1].x_m,
                                 path.points[i].y_m - path.points[i - 1].y_m};
      const track::Vector after{path.points[i + 1].x_m - path.points[i].x_m,
                                path.points[i + 1].y_m - path.points[i].y_m};
      if (dot(before, after) < -0.5 * length(before) * length(after)) back ^= 1;
    }
    path.backwards.push_back(back);
  }
  path.either = either;
  return path;
}

/// Ahead, back in a bend, and ahead again: how one turns round where there is no room.
inline Points three_point_turn() {
  Pen pen;
  pen.line(4).arc(2.5, kPi / 3).turn(kPi).arc(2.5, kPi / 3).line(2).turn(kPi).arc(2.5, kPi / 3);
  pen.line(3);
  return pen.points();
}

inline Points rows() {
  Pen pen;
  pen.line(8).arc(1, kPi).line(8).arc(1, -kPi).line(8).arc(1.5, kPi).line(4);
  return pen.points();
}
inline Points figure_eight() {
  Pen pen;
  pen.arc(2, 2 * kPi).arc(2, -2 * kPi);
  return pen.points();
}
inline Points square() {
  Pen pen;
  for (int side = 0; side < 4; ++side) pen.line(4).turn(kPi / 2);
  return pen.points();
}
/// A stadium, driven once round to where it began.
inline Points loop() {
  Pen pen;
  pen.line(3).arc(2, kPi).line(6).arc(2, kPi).line(3);
  return pen.points();
}
/// A kilometre: rows of 96 m with U-turns of 1.5 m.
inline Points field() {
  Pen pen;
  for (int row = 0; row < 10; ++row) {
    if (row > 0) pen.arc(1.5, row % 2 == 1 ? kPi : -kPi);
    pen.line(96);
  }
  return pen.points();
}

/// Distance to a polyline.
inline double distance_m(const Points& points, double x_m, double y_m) {
  double best_m2 = INFINITY;
  for (std::size_t i = 0; i + 1 < points.size(); ++i) {
    const track::Vector a{points[i].x_m, points[i].y_m};
    const track::Vector ab = track::Vector{points[i + 1].x_m, points[i + 1].y_m} - a;
    const track::Vector ap = track::Vector{x_m, y_m} - a;
    const double ab_m2 = dot(ab, ab);
    const double t = ab_m2 > 0 ? std::clamp(dot(ap, ab) / ab_m2, 0.0, 1.0) : 0;
    const track::Vector off = ap - t * ab;
    best_m2 = std::min(best_m2, dot(off, off));
  }
  return std::sqrt(best_m2);
}

}  // namespace drover::test
