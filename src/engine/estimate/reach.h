// How far the base could still drive by dead reckoning before its position or heading is too
// uncertain.
#pragma once

#include "engine/config.h"
#include "engine/estimate/filter.h"

namespace drover::engine::estimate {

/// What the heading may be wrong by beside the belief, and the way that this bends already.
struct HeadingDoubt {
  double sigma_rad = 0;
  double east_m = 0;
  double north_m = 0;

  /// Two sigma of position and heading by both.
  double two_sigma_m(const Belief& belief) const;
  double two_sigma_rad(const Belief& belief) const;
};

/// Metres at the present kind of driving (slowly straight ahead when it stands) until two
/// sigma reach bound_run_m or bound_yaw_deg; not more than about 100.
double metres_left(Belief belief, HeadingDoubt doubt, BodyMotion body, GyroMotion gyro,
                   double bias_sigma_x_m, double bias_sigma_y_m, const EstimateConfig& config);

}  // namespace drover::engine::estimate
