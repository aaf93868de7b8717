// The same for the DAMIAO motors of the arm on can1, ids 1 to 3, read by hand.
//
// Source: DM_Control_Python (DM_CAN.py) and its README. It shares nothing with the driver on
// purpose.
#pragma once

#include <cstddef>
#include <optional>
#include <string>

#include "drover/can_frame.h"

namespace drover::mission::damiao {

inline constexpr std::size_t kMotors = 3;
/// What the last bit of a position, a stiffness and a torque is worth.
inline constexpr double kLeast_rad = 25.0 / 65535;
inline constexpr double kLeast_Nmprad = 500.0 / 4095;
inline constexpr double kLeast_Nm = 56.0 / 4095;

/// What a motor is told to do: torque = stiffness (position - p) + damping (velocity - v) + torque.
struct SetPoint {
  std::size_t joint = 0;  ///< from 0
  double position_rad = 0;
  double velocity_radps = 0;
  double stiffness = 0;
  double damping = 0;
  double torque_Nm = 0;
  /// It slows what moves, and nothing else.
  bool only_damps() const {
    return stiffness == 0 && damping > 0 && velocity_radps == 0 && torque_Nm == 0;
  }
};
std::optional<SetPoint> set_point(const CanFrame& frame);

/// What a motor tells of itself.
struct Answer {
  std::size_t joint = 0;
  int status = 0;  ///< 1: enabled
  double position_rad = 0;
  double velocity_radps = 0;
  double torque_Nm = 0;
};
std::optional<Answer> answer(const CanFrame& frame);

/// As mission::forbidden.
std::string forbidden(const CanFrame& frame);

}  // namespace drover::mission::damiao
