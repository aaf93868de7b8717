// How far a receiver's position may be off.
#pragma once

#include <algorithm>
#include <cmath>

#include "engine/estimate/model_gnss.h"

namespace drover::engine {

/// One sigma of east or north, the larger, m: what the receiver tells, and no less than its kind of
/// fix has. For who compares places of the last seconds: old corrections err alike in both, and the
/// margin is the comparer's own (the filter adds `gnss_inflation`).
inline double place_sigma_m(GnssPosition position, const EstimateConfig& config) {
  position.correction_age_s = kAbsent;
  double sigma_m = estimate::floor_sigma_m(estimate::class_of(position, config), config);
  for (const double told_m : {position.sigma_east_m, position.sigma_north_m}) {
    if (std::isfinite(told_m)) sigma_m = std::max(sigma_m, told_m);
  }
  return sigma_m;
}

}  // namespace drover::engine
