// The way by wheels and gyro alone: what no receiver moves, and so never jumps.
#pragma once

#include "drover/snapshot.h"
#include "engine/config.h"
#include "engine/estimate/estimator.h"

namespace drover::engine {

/// Sums up the estimate's speeds, in which a fix may refine the wheels' scale and the gyro's zero,
/// but never the place.
class OdometryTrack final {
 public:
  explicit OdometryTrack(const EstimateConfig& config) : config_(config) {}

  /// `estimate` is of `now`.
  const Odometry& step(Time now, const Estimate& estimate);

 private:
  void advance(double dt_s, const Estimate& estimate);

  EstimateConfig config_;
  Odometry way_;
};

}  // namespace drover::engine
