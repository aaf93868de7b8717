// Tracks drawn with a pen and recorded as operators do, and a robot that drives them.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <random>
#include <vector>

#include "drover/angle.h"
#include "engine/base/kinematics.h"
#include "engine/navigate/tracker.h"
#include "support/plant_2d.h"

namespace drover::engine {

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

/// Distance to a polyline.
inline double distance_m(const Points& points, double x_m, double y_m) {
  double best_m = INFINITY;
  for (std::size_t i = 0; i + 1 < points.size(); ++i) {
    const track::Vector a{points[i].x_m, points[i].y_m};
    const track::Vector ab = track::Vector{points[i + 1].x_m, points[i + 1].y_m} - a;
    const track::Vector ap = track::Vector{x_m, y_m} - a;
    const double ab_m2 = dot(ab, ab);
    const double t = ab_m2 > 0 ? std::clamp(dot(ap, ab) / ab_m2, 0.0, 1.0) : 0;
    best_m = std::min(best_m, length(ap - t * ab));
  }
  return best_m;
}

struct Drive {
  bool arrived = false;
  double rms_m = 0;  ///< off the recorded points' polyline, of the truth
  double p95_m = 0;
  double max_m = 0;
  double final_m = 0;  ///< from the target, at rest
  double driven_m = 0;
  double time_s = 0;
  double fastest_mps = 0;
  double most_lateral_mps2 = 0;
  double mean_yaw_acceleration_radps2 = 0;  ///< of the set points: how much they jitter
  Pose end;
};

struct DriveSetup {
  double speed_mps = 0.5;
  double x_m = 0, y_m = 0, yaw_rad = 0;
  double cap_mps = 10;
  LimitsConfig limits{};
  NavigateConfig navigate{};
  test::PlantConfig plant{};
};

/// Drives until arrival and one second more, at 200 Hz.
inline Drive drive(const Path& path, std::uint32_t target, const DriveSetup& setup) {
  constexpr double kTick_s = 0.005;
  const BaseConfig base;
  test::Plant2d plant(base, setup.plant, setup.x_m, setup.y_m, setup.yaw_rad);
  test::TwistRamp gate(setup.limits);
  Tracker tracker(setup.navigate, setup.limits);
  tracker.begin(path, target, setup.speed_mps, plant.estimate());
  Drive result;
  std::vector<double> off;
  double square_m2 = 0;
  double yaw_changes_radps = 0;
  double last_radps = 0;
  int rest = 200;
  int ticks = 0;
  for (; ticks < 200 * 400 && rest > 0; ++ticks) {
    const Pose pose = plant.estimate();
    const TrackProgress progress = tracker.locate(pose);
    result.arrived = result.arrived || progress.arrived;
    Twist wanted;
    if (!result.arrived) wanted = tracker.follow(pose, progress, setup.cap_mps, from_s(kTick_s));
    if (result.arrived) --rest;
    const Twist twist = gate.step(wanted, kTick_s);
    yaw_changes_radps += std::abs(twist.wz_radps - last_radps);
    last_radps = twist.wz_radps;
    plant.step(wheels_from_twist(sides_of(base), 1.0, twist, 1.5), kTick_s);
    result.driven_m += plant.truth().vx_mps * kTick_s;
    result.fastest_mps = std::max(result.fastest_mps, plant.truth().vx_mps);
    result.most_lateral_mps2 =
        std::max(result.most_lateral_mps2, std::abs(plant.truth().vx_mps * plant.truth().wz_radps));
    if (ticks % 20 != 0) continue;
    off.push_back(distance_m(path.points, plant.truth().x_m, plant.truth().y_m));
    square_m2 += off.back() * off.back();
  }
  std::sort(off.begin(), off.end());
  result.rms_m = std::sqrt(square_m2 / static_cast<double>(off.size()));
  result.p95_m = off[off.size() * 95 / 100];
  result.max_m = off.back();
  result.end = plant.truth();
  const PathPoint& goal = path.points[target];
  result.final_m = std::hypot(result.end.x_m - goal.x_m, result.end.y_m - goal.y_m);
  result.time_s = ticks * kTick_s;
  result.mean_yaw_acceleration_radps2 = yaw_changes_radps / result.time_s;
  return result;
}

}  // namespace drover::engine
