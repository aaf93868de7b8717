// What the simulated chassis of both kinds have in common.
#include "drivers/agilex_v2/chassis.h"

namespace drover::agilex_v2 {
namespace {

/// What turns the gears and motors along when they are not driven.
constexpr double kGearDrag_Nms_per_rad = 1;

}  // namespace

bool set_chassis_fault(std::string_view name, const LowBattery& low, SystemState& state,
                       bool& silent) {
  const bool was_taken = is_taken(state.mode);
  if (name == "silent") {
    silent = true;
  } else if (name == "estop") {
    state.vehicle = Vehicle::estop;
  } else if (name == "exception") {
    state.vehicle = Vehicle::exception;
  } else if (name == "remote") {
    state.mode = Mode::remote;
  } else if (name == "low_battery") {
    state.battery_V = low.battery_V;
    state.error = low.error;
  } else if (name.empty()) {
    silent = false;
    state = {.mode = was_taken ? Mode::standby : state.mode,
             .battery_V = kFull_V,
             .brake_locked = state.brake_locked};
  } else {
    return false;
  }
  return true;
}

void let_go(std::array<Servo, 2>& servos, const Servo& fresh, std::span<Shaft> shafts) {
  servos.fill(fresh);
  for (Shaft& shaft : shafts) {
    shaft.torque_Nm = -kGearDrag_Nms_per_rad * shaft.velocity_radps;
    shaft.energized = false;
  }
}

}  // namespace drover::agilex_v2
