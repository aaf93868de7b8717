// Spring and damper inside the friction circle; the bend itself is kept inside it too, so that a
// tyre that stops sliding starts to spring back at once.
#include "sim/plant/tyre.h"

#include <algorithm>
#include <cmath>

namespace drover::sim {
namespace {

void limit_length(double& x, double& y, double longest) {
  const double length = std::sqrt(x * x + y * y);
  if (length <= longest) return;
  x *= longest / length;
  y *= longest / length;
}

}  // namespace

Tyre::Force Tyre::step(double slip_ahead_mps, double slip_left_mps, double roll_mps, double load_N,
                       double dt_s) {
  if (!(load_N > 0)) {
    reset();
    return {};
  }
  const double grip_N = config_.friction * load_N;
  // Implicit in the creep, so that no speed makes it overshoot.
  const double kept = 1 / (1 + std::abs(roll_mps) * dt_s / config_.relaxation_m);
  bend_ahead_m_ = (bend_ahead_m_ + slip_ahead_mps * dt_s) * kept;
  bend_left_m_ = (bend_left_m_ + slip_left_mps * dt_s) * kept;
  limit_length(bend_ahead_m_, bend_left_m_, grip_N / config_.stiffness_Npm);

  Force force;
  force.ahead_N = -config_.stiffness_Npm * bend_ahead_m_ - config_.damping_Nspm * slip_ahead_mps;
  force.left_N = -config_.stiffness_Npm * bend_left_m_ - config_.damping_Nspm * slip_left_mps;
  limit_length(force.ahead_N, force.left_N, grip_N);
  return force;
}

Tyre::Force Tyre::step_roller(double axis_rad, double slip_ahead_mps, double slip_left_mps,
                              double rim_mps, double load_N, double dt_s) {
  const double c = std::cos(axis_rad);
  const double s = std::sin(axis_rad);
  const double grip_N =
      step(slip_ahead_mps * c + slip_left_mps * s, 0, rim_mps, load_N, dt_s).ahead_N;
  const double across_mps = slip_left_mps * c - slip_ahead_mps * s;
  // Dry friction of its bearing, which also holds it at rest.
  const double most_N = config_.roller_drag * std::max(load_N, 0.0);
  const double most_m = most_N / config_.stiffness_Npm;
  bend_across_m_ = std::clamp(bend_across_m_ + across_mps * dt_s, -most_m, most_m);
  const double drag_N = std::clamp(
      -config_.stiffness_Npm * bend_across_m_ - config_.damping_Nspm * across_mps, -most_N, most_N);
  return {grip_N * c - drag_N * s, grip_N * s + drag_N * c};
}

}  // namespace drover::sim
