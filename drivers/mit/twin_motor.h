// The law of MIT mode on a simulated motor's shaft.
#pragma once

#include <span>
#include <string_view>

#include "drivers/mit/joint.h"
#include "drover/options.h"
#include "drover/twin.h"

namespace drover::mit {

/// The simulated motor's own numbers, of any maker.
struct TwinSettings {
  Ranges ranges;                   ///< that stand in it; of its torque, and the most that it gives
  double time_constant_s = 0.001;  ///< from wanted to actual torque
  double ambient_degC = 25;
  Duration boot_time{};  ///< silence after the supply comes back
};

// Rows of its option table; read_twin() reads them, and none of the ranges.
OptionSpec time_constant_row();
OptionSpec ambient_row();
OptionSpec boot_row();
void read_twin(const Options& options, std::span<const OptionSpec> table, TwinSettings& twin);

struct TwinMotor {
  TwinMotor(const Joint& joint, const TwinSettings& twin)
      : sign(joint.sign),
        zero_rad(joint.zero_rad),
        t_max_Nm(twin.ranges.t_max_Nm),
        time_constant_s(twin.time_constant_s) {}

  double sign;
  double zero_rad;
  double t_max_Nm;
  double time_constant_s;
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
