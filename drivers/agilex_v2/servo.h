// The velocity loop of a simulated chassis' motor.
#pragma once

#include <algorithm>

namespace drover::agilex_v2 {

/// Turns at its speed, with a memory of how much torque that takes: with it, it holds on a slope.
struct Servo {
  double integral_Nm_per_rad = 30;
  double proportional_Nms_per_rad = 6;
  double effort_Nm = 0;

  double torque_Nm(double error_radps, double dt_s, double most_Nm) {
    effort_Nm = std::clamp(effort_Nm + integral_Nm_per_rad * error_radps * dt_s, -most_Nm, most_Nm);
    return std::clamp(proportional_Nms_per_rad * error_radps + effort_Nm, -most_Nm, most_Nm);
  }
};

}  // namespace drover::agilex_v2
