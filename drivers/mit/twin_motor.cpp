#include "drivers/mit/twin_motor.h"

#include <algorithm>
#include <cmath>

#include "drivers/checked_options.h"

namespace drover::mit {

OptionSpec time_constant_row() {
  return {.name = "time_constant_s",
          .default_value = 0.001,
          .min = 0,
          .max = 1,
          .text = "from wanted to actual torque"};
}

OptionSpec ambient_row() {
  return {.name = "ambient_degC", .default_value = 25.0, .min = 0, .max = 100, .text = "air"};
}

OptionSpec boot_row() {
  return {.name = "boot_s",
          .default_value = 0.3,
          .min = 0,
          .max = 60,
          .text = "silence after the supply comes back"};
}

void read_twin(const Options& options, std::span<const OptionSpec> table, TwinSettings& twin) {
  const CheckedOptions checked(options, table);
  twin.time_constant_s = checked.number("time_constant_s");
  twin.ambient_degC = checked.number("ambient_degC");
  twin.boot_time = checked.seconds("boot_s");
}

void TwinMotor::move(double dt_s, bool on, const MitCommand& command, Shaft& shaft) {
  const double turns = wrong_sign ? -sign : sign;
  if (!stuck) {
    told.position_rad = shaft.position_rad * turns + zero_rad;
    told.velocity_radps = shaft.velocity_radps * turns;
  } else {
    told.velocity_radps = 0;
  }
  if (on) {
    const double law_Nm = command.stiffness_Nmprad * (command.position_rad - told.position_rad) +
                          command.damping_Nmsprad * (command.velocity_radps - told.velocity_radps) +
                          command.torque_Nm;
    const double share = time_constant_s > 0 ? 1 - std::exp(-dt_s / time_constant_s) : 1.0;
    told.torque_Nm += (std::clamp(law_Nm, -t_max_Nm, t_max_Nm) - told.torque_Nm) * share;
  } else {
    told.torque_Nm = 0;
  }
  shaft.torque_Nm = told.torque_Nm * (torque_reversed ? -turns : turns);
  shaft.energized = on;
}

bool TwinMotor::set_fault(std::string_view name) {
  if (name == "stuck_encoder") {
    stuck = true;
  } else if (name == "wrong_sign") {
    wrong_sign = true;
  } else if (name == "torque_reversed") {
    torque_reversed = true;
  } else {
    return false;
  }
  return true;
}

}  // namespace drover::mit
