// The same for four RoboMaster motors, numbers 1 to 4, read by hand.
//
// Source: RoboMaster C610 User Guide 2019.03 p.8, CAN_receive.c of the maker's board examples. It
// shares nothing with the driver on purpose.
#pragma once

#include <array>
#include <optional>
#include <string>

#include "drover/can_frame.h"

namespace drover::mission::robomaster {

inline constexpr std::size_t kMotors = 4;

/// What makes a motor turn cannot be seen in a current alone: one against the turn brakes, one that
/// lets it back slowly, where it went against that same current, holds, and less than friction
/// moves nothing. So it reads what the motors tell, too.
class Bus {
 public:
  /// Of a command: the current of each motor that drives it, in A; 0 of one that does not.
  std::optional<std::array<float, kMotors>> drives_A(const CanFrame& frame);

 private:
  /// What a motor told.
  struct Told {
    int rpm = 0;
    int angle = 0;
    int counts = 0;  ///< asked for last
    int away = 0;    ///< in parts of a turn, since that has its sign
  };
  static void take(Told& told, int angle, int rpm);
  static bool drives(Told& told, int counts);

  std::array<Told, kMotors> told_{};
};

/// A command in which each current is zero: what the guard sends.
bool is_zero(const CanFrame& frame);

/// As mission::forbidden.
std::string forbidden(const CanFrame& frame);

}  // namespace drover::mission::robomaster
