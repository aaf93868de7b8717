// A simulated battery: charge, voltage and temperature follow from the power that is drawn.
#pragma once

#include "drover/twin.h"

namespace drover::sim {

struct BatteryModel {
  double capacity_Ah = 40;
  double soc_percent = 90;  ///< at the start
  double cells = 8;         ///< of lithium iron phosphate, in series
  double resistance_Ohm = 0.02;
  double idle_W = 25;    ///< computers, drives at rest
  double charger_A = 8;  ///< what the charger gives
};

class Battery {
 public:
  explicit Battery(const BatteryModel& model);
  /// `wheels_W`: mechanical power of the wheels; what they give back charges.
  void step(double dt_s, double wheels_W);
  void set_soc(double percent) { truth_.soc_percent = percent; }
  void set_charger(bool connected) { truth_.charger_connected = connected; }
  const BatteryTruth& truth() const { return truth_; }

 private:
  BatteryModel model_;
  BatteryTruth truth_;
};

}  // namespace drover::sim
