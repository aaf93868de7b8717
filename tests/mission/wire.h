// What a frame on the robot's bus is: ODrive CANSimple of firmware 0.6, read by hand.
//
// Source: ODrive documentation "CAN Protocol" for firmware 0.6. It shares nothing with the driver
// on purpose: an error there must not hide here.
#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "drover/can_frame.h"

namespace drover::mission {

/// Nodes of the field robot's four wheels.
inline constexpr std::uint8_t kFirstNode = 1;
inline constexpr std::uint8_t kLastNode = 4;

/// A Set_Input_Vel frame; or one wheel's share of what another maker's frame says.
struct WheelCommand {
  std::uint8_t node = 0;
  float velocity_turnps = 0;
  float torque_Nm = 0;
  /// Anything but exact zeros; not a number counts as motion.
  bool moves() const { return !(velocity_turnps == 0.0F && torque_Nm == 0.0F); }
};
std::optional<WheelCommand> wheel_command(const CanFrame& frame);

/// Empty when the frame is one that a drive sends, or one that a gateway may send to a wheel:
/// set point, velocity mode, closed loop or idle, clear errors, polls of error, torques,
/// temperature and supply. Otherwise what is wrong with it.
std::string forbidden(const CanFrame& frame);

}  // namespace drover::mission
