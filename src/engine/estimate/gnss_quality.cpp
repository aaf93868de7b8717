// What a quality is worth, and where an antenna is over the base.
#include <algorithm>
#include <cmath>

#include "engine/estimate/model_gnss.h"

namespace drover::engine::estimate {

GnssClass class_of(const GnssPosition& position, const EstimateConfig& config) {
  switch (position.quality) {
    case FixQuality::none:
    case FixQuality::estimated:
    case FixQuality::manual:
    case FixQuality::simulator: return GnssClass::none;
    case FixQuality::rtk_fixed:
      return position.correction_age_s > config.max_correction_age_s ? GnssClass::floating
                                                                     : GnssClass::fixed;
    case FixQuality::rtk_float: return GnssClass::floating;
    case FixQuality::dgps: return GnssClass::dgps;
    case FixQuality::single:
    case FixQuality::pps: break;
  }
  return GnssClass::single;  // an unknown number is never better than 1
}

double floor_sigma_m(GnssClass quality, const EstimateConfig& config) {
  switch (quality) {
    case GnssClass::fixed: return config.sigma_fixed_m;
    case GnssClass::floating: return config.sigma_float_m;
    case GnssClass::dgps: return config.sigma_dgps_m;
    case GnssClass::none:
    case GnssClass::single: break;
  }
  return config.sigma_single_m;
}

double sigma_m(GnssClass quality, double gst_sigma_m, const EstimateConfig& config) {
  const double floor = floor_sigma_m(quality, config);
  const bool worse = gst_sigma_m > floor && std::isfinite(gst_sigma_m);
  return config.gnss_inflation * (worse ? gst_sigma_m : floor);
}

LeverArm lever_arm(double roll_rad, double pitch_rad, const AntennaConfig& antenna) {
  const double over_m = antenna.y_m * std::sin(roll_rad) + antenna.z_m * std::cos(roll_rad);
  return {.ahead_m = antenna.x_m * std::cos(pitch_rad) + over_m * std::sin(pitch_rad),
          .left_m = antenna.y_m * std::cos(roll_rad) - antenna.z_m * std::sin(roll_rad)};
}

}  // namespace drover::engine::estimate
