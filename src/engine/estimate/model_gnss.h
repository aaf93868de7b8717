// How a GNSS position corrects the state: antenna lever arm, noise by quality, gate and jumps.
#pragma once

#include "engine/config.h"
#include "engine/estimate/state.h"

namespace drover::engine::estimate {

/// A position of the antenna in `map`, prepared for the filter.
struct AntennaPosition {
  double x_m = 0;
  double y_m = 0;
  GnssClass quality = GnssClass::none;
  double sigma_x_m = 0;
  double sigma_y_m = 0;
  bool told_sigma = false;    ///< the receiver says how well it knows
  std::uint8_t receiver = 0;  ///< whose
};

inline double larger_sigma_m(const AntennaPosition& position) {
  return position.sigma_x_m > position.sigma_y_m ? position.sigma_x_m : position.sigma_y_m;
}

/// The class whose error a quality has. Dead reckoning of the receiver, manual input and its
/// simulator mode are no measurements; an RTK fix with old corrections is a float.
GnssClass class_of(const GnssPosition& position, const EstimateConfig& config);
double floor_sigma_m(GnssClass quality, const EstimateConfig& config);
/// The receiver's own sigma (GST) but not less than the floor of the class, times gnss_inflation,
/// because receivers are optimists. That the error lasts (multipath: 30 to 300 s) is not a matter
/// of its size: the filter carries it as a state of its own.
double sigma_m(GnssClass quality, double gst_sigma_m, const EstimateConfig& config);

/// Where the antenna is over base_link, in horizontal axes of a base that is tilted like this.
LeverArm lever_arm(double roll_rad, double pitch_rad, const AntennaConfig& antenna);

/// Applies the position to a state that stands at the position's own time.
void apply(State& state, const AntennaPosition& measured, const Twist& twist,
           const EstimateConfig& config);

}  // namespace drover::engine::estimate
