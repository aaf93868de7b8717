// The law of MIT mode on a simulated motor's shaft.
#pragma once

#include <string_view>

#include "drivers/mit/frame.h"
#include "drover/twin.h"

namespace drover::mit {

struct TwinMotor {
  double sign = 1;
  double zero_rad = 0;
  double t_max_Nm = 0;
  double time_constant_s = 0;    ///< from wanted to actual torque
  bool stuck = false;            ///< its encoder
  bool wrong_sign = false;       ///< encoder and torque both: it believes itself right
  bool torque_reversed = false;  ///< its torque alone, against what it is told and what it tells
  /// At the motor, as its encoder tells.
  Motion told;

  /// Known: "stuck_encoder", "wrong_sign", "torque_reversed". False: it is none of a motor's.
  bool set_fault(std::string_view name);
  void mend() { stuck = wrong_sign = torque_reversed = false; }
  /// With its power stage `on` it follows `command`, and so does the shaft; else both are free.
  void move(double dt_s, bool on, const MitCommand& command, Shaft& shaft);
};

}  // namespace drover::mit
