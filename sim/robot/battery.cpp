#include "sim/robot/battery.h"

#include <algorithm>

namespace drover::sim {
namespace {

constexpr double kDriveEfficiency = 0.75;
constexpr double kAmbient_degC = 22;
constexpr double kHeat_degC_per_W = 0.5;
constexpr double kSlow_s = 600;  ///< of the temperature

/// Of a cell without load: flat, and steep at the end.
double open_cell_V(double soc_percent) {
  const double flat = 3.2 + 0.0013 * soc_percent;
  return soc_percent < 8 ? flat - 0.05 * (8 - soc_percent) : flat;
}

}  // namespace

Battery::Battery(const BatteryModel& model) : model_(model) {
  truth_.capacity_Ah = model.capacity_Ah;
  truth_.soc_percent = model.soc_percent;
  truth_.temperature_degC = kAmbient_degC;
  step(0, 0);
}

void Battery::step(double dt_s, double wheels_W) {
  const double open_V = model_.cells * open_cell_V(truth_.soc_percent);
  const double drives_W = wheels_W > 0 ? wheels_W / kDriveEfficiency : wheels_W * kDriveEfficiency;
  const double charger_A =
      truth_.charger_connected && truth_.soc_percent < 100 ? model_.charger_A : 0;
  truth_.current_A = charger_A - (model_.idle_W + drives_W) / open_V;
  truth_.voltage_V = open_V + truth_.current_A * model_.resistance_Ohm;
  const double charge_Ah = truth_.current_A * dt_s / 3600;
  truth_.soc_percent =
      std::clamp(truth_.soc_percent + 100 * charge_Ah / model_.capacity_Ah, 0.0, 100.0);
  const double loss_W = truth_.current_A * truth_.current_A * model_.resistance_Ohm;
  const double goal_degC = kAmbient_degC + kHeat_degC_per_W * loss_W;
  truth_.temperature_degC += (goal_degC - truth_.temperature_degC) * std::min(dt_s / kSlow_s, 1.0);
}

}  // namespace drover::sim
