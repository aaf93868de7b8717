// A robot that is driven along a track in closed loop, whoever steers it: gate, drives that lag,
// skidding wheels and a pose with noise; and how near to the track the truth was.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <vector>

#include "engine/base/kinematics.h"
#include "engine/config.h"
#include "support/plant_2d.h"
#include "support/tracks.h"

namespace drover::test {

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
  /// Of the wheels' set points, behind the gate.
  double rms_jerk_mps3 = 0;
  double max_jerk_mps3 = 0;
  Pose end;
  std::vector<Pose> poses;  ///< as steered by; where asked for
};

struct DriveSetup {
  double speed_mps = 0.5;
  double x_m = 0, y_m = 0, yaw_rad = 0;
  double cap_mps = 10;
  double max_rim_mps = 1.5;
  bool keep_poses = false;
  engine::LimitsConfig limits{};
  engine::NavigateConfig navigate{};
  PlantConfig plant{};
};

/// What who steers wants.
struct Steered {
  Twist twist;
  bool arrived = false;
};

/// Second differences of the sides' speeds.
class JerkMeter final {
 public:
  void add(std::array<double, 2> side_mps, double dt_s) {
    for (std::size_t i = 0; i < 2; ++i) {
      const double a_mps2 = (side_mps[i] - last_mps_[i]) / dt_s;
      const double jerk_mps3 = (a_mps2 - last_mps2_[i]) / dt_s;
      last_mps_[i] = side_mps[i];
      last_mps2_[i] = a_mps2;
      max_mps3_ = std::max(max_mps3_, std::abs(jerk_mps3));
      square_sum_ += jerk_mps3 * jerk_mps3;
      ++count_;
    }
  }
  double max_mps3() const { return max_mps3_; }
  double rms_mps3() const { return std::sqrt(square_sum_ / std::max(count_, 1.0)); }

 private:
  std::array<double, 2> last_mps_{};
  std::array<double, 2> last_mps2_{};
  double max_mps3_ = 0;
  double square_sum_ = 0;
  double count_ = 0;
};

/// Drives until arrival and one second more, at 200 Hz. `steer(pose, dt_s)` gives a Steered.
template <class Steer>
Drive drive(const Path& path, std::uint32_t target, const DriveSetup& setup, Plant2d& plant,
            Steer&& steer) {
  constexpr double kTick_s = 0.005;
  constexpr double kSlowest_mps = 0.1;  // mean; slower is stuck
  const engine::BaseConfig base;
  TwistRamp gate(setup.limits);
  Drive result;
  JerkMeter jerk;
  std::vector<double> off;
  double square_m2 = 0;
  double yaw_changes_radps = 0;
  double last_radps = 0;
  double length_m = 0;
  for (std::size_t i = 0; i + 1 < path.points.size(); ++i)
    length_m += std::hypot(path.points[i + 1].x_m - path.points[i].x_m,
                           path.points[i + 1].y_m - path.points[i].y_m);
  const int most_ticks = static_cast<int>((400 + length_m / kSlowest_mps) / kTick_s);
  int rest = 200;
  int ticks = 0;
  for (; ticks < most_ticks && rest > 0; ++ticks) {
    const Pose pose = plant.estimate();
    if (setup.keep_poses) result.poses.push_back(pose);
    Steered steered;
    if (!result.arrived) steered = steer(pose, kTick_s);
    result.arrived = result.arrived || steered.arrived;
    if (result.arrived) {
      steered.twist = {};
      --rest;
    }
    const Twist twist = gate.step(steered.twist, kTick_s);
    yaw_changes_radps += std::abs(twist.wz_radps - last_radps);
    last_radps = twist.wz_radps;
    const engine::WheelSpeeds wheels =
        wheels_from_twist(sides_of(base), 1.0, twist, setup.max_rim_mps);
    jerk.add({wheels.left_radps * base.wheel_radius_m, wheels.right_radps * base.wheel_radius_m},
             kTick_s);
    plant.step(wheels, kTick_s);
    const Pose& truth = plant.truth();
    result.driven_m += truth.vx_mps * kTick_s;
    result.fastest_mps = std::max(result.fastest_mps, truth.vx_mps);
    result.most_lateral_mps2 =
        std::max(result.most_lateral_mps2, std::abs(truth.vx_mps * truth.wz_radps));
    if (ticks % 20 != 0) continue;
    off.push_back(distance_m(path.points, truth.x_m, truth.y_m));
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
  result.rms_jerk_mps3 = jerk.rms_mps3();
  result.max_jerk_mps3 = jerk.max_mps3();
  return result;
}

}  // namespace drover::test
