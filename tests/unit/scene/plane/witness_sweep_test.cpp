// Sweeps among random poles against a robot that is put down every millimetre of its way: its
// distance from a pole is that of a point from a rectangle, and nothing of the product is used.
#include <gtest/gtest.h>

#include <cstdlib>
#include <random>

#include "scene/plane/sweep.h"
#include "tests/unit/scene/plane/shapes.h"

namespace drover::scene {
namespace {

constexpr double kMargin_m = 0.03;
constexpr double kPole_m = 0.01;
/// In the middle of a side that is 0.9 m long, when a corner 0.57 m from the centre turns by 1 cm:
/// 0.45 m * sin(0.5 deg).
constexpr double kHullIsWider_m = 0.004;

struct Pole {
  double x_m = 0;
  double y_m = 0;
};

/// From the skin of the robot with its margin: negative inside.
double gap_m(const Pole& pole, double x_m, double y_m, double yaw_rad) {
  const double c = std::cos(yaw_rad);
  const double s = std::sin(yaw_rad);
  const double ahead_m = c * (pole.x_m - x_m) + s * (pole.y_m - y_m);
  const double left_m = -s * (pole.x_m - x_m) + c * (pole.y_m - y_m);
  const double dx_m = std::max(std::abs(ahead_m) - 0.45, 0.0);
  const double dy_m = std::max(std::abs(left_m) - 0.35, 0.0);
  return std::hypot(dx_m, dy_m) - kMargin_m - kPole_m;
}

struct Twist {
  double v_mps = 0;
  double wz_radps = 0;
};

/// The first moment at which the robot is within `near_m` of a pole, by Euler's steps of 0.1 ms.
double moment_s(const std::vector<Pole>& poles, Twist twist, double until_s, double near_m) {
  constexpr double kTick_s = 1e-4;
  double x_m = 0;
  double y_m = 0;
  double yaw_rad = 0;
  for (double t_s = 0; t_s < until_s; t_s += kTick_s) {
    for (const Pole& pole : poles)
      if (gap_m(pole, x_m, y_m, yaw_rad) <= near_m) return t_s;
    const double middle_rad = yaw_rad + 0.5 * kTick_s * twist.wz_radps;
    x_m += kTick_s * twist.v_mps * std::cos(middle_rad);
    y_m += kTick_s * twist.v_mps * std::sin(middle_rad);
    yaw_rad += kTick_s * twist.wz_radps;
  }
  return until_s;
}

TEST(WitnessedSweeps, StopBeforeTheFirstPoleAndNotMuch) {
  std::mt19937 random(11);
  std::uniform_real_distribution<> unit(-1, 1);
  const char* asked = std::getenv("DROVER_LONG");
  const int scenes = asked && *asked ? 20'000 : 200;
  int blocked = 0;
  for (int i = 0; i < scenes; ++i) {
    std::vector<Pole> poles;
    Field field;
    while (poles.size() < 12) {
      const Pole pole{2 * unit(random), 1.5 * unit(random)};
      if (gap_m(pole, 0, 0, 0) < 0.01) continue;
      poles.push_back(pole);
      field.put(std::to_string(poles.size()),
                area_of(cylinder(1, kPole_m), pose(pole.x_m, pole.y_m, 0.5), kRobot));
    }
    const Twist twist{i % 4 == 0 ? 0 : unit(random), 1.5 * unit(random)};
    const double until_s = 1;
    const auto steps = arc_steps({0, 0, 0}, twist.v_mps * until_s, twist.wz_radps * until_s,
                                 stride_m(footprint()));
    const FreeWay way = first_contact(field, footprint(kMargin_m), steps);
    const double driven_s = twist.v_mps != 0 ? way.free_m / std::abs(twist.v_mps)
                                             : way.free_rad / std::abs(twist.wz_radps);
    // Nothing is touched until there; and what ended the way is within the resolution, or would
    // be passed as closely as the hull of a last step is wide.
    EXPECT_LE(driven_s, moment_s(poles, twist, until_s, 0) + 2e-4) << "scene " << i;
    if (!way.blocked) continue;
    ++blocked;
    const double corner_mps = std::abs(twist.v_mps) + std::abs(twist.wz_radps) * 0.6;
    EXPECT_GE(driven_s, moment_s(poles, twist, until_s, kHullIsWider_m) - 0.011 / corner_mps - 2e-4)
        << "scene " << i;
  }
  EXPECT_GT(blocked, scenes / 4);
  EXPECT_LT(blocked, scenes * 3 / 4);
}

}  // namespace
}  // namespace drover::scene
