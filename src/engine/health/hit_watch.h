// Whether something hit the robot, or it something: an acceleration that no drive gives.
#pragma once

#include "drover/measurement.h"
#include "drover/time.h"
#include "engine/config.h"

namespace drover::engine {

/// Across the ground. What lasts is gravity (a slope), or a drive's: it is taken off. One sample
/// alone counts only of a sensor that tells no more within a hit: a wheel that takes hold jerks,
/// too.
class HitWatch final {
 public:
  explicit HitWatch(const HealthConfig& config) : limit_mps2_(config.hit_mps2) {}

  /// As measured, in the axes of base_link; a saturated one counts with what it says.
  void on_sample(const ImuSample& sample, Time at);
  /// Why nothing may move, for a second after the last hit; empty when nothing hit it.
  const Reason& reason(Time now);

 private:
  double limit_mps2_;   ///< 0: nobody looks
  bool above_ = false;  ///< the last sample was
  double lasting_x_mps2_ = 0;
  double lasting_y_mps2_ = 0;
  Time sample_at_ = kNever;
  Time hit_at_ = kNever;
  double hardest_mps2_ = 0;  ///< of this hit
  Reason reason_;
};

}  // namespace drover::engine
