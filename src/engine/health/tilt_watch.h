// Whether the base stands as upright as it may, and whether gravity points down at all.
#pragma once

#include "drover/measurement.h"
#include "drover/time.h"
#include "engine/config.h"

namespace drover::engine {

/// Two questions. Is the base tilted beyond the limit (roll and pitch as fused from gyro and
/// gravity)? And does the inertial sensor feel gravity along its z axis at all: one that is mounted
/// upside down, or with a wrong mounting rotation, does not, and neither does a robot on its side.
class TiltWatch final {
 public:
  explicit TiltWatch(const HealthConfig& config) : config_(config) {}

  /// As measured, in the axes of base_link.
  void on_sample(const ImuSample& sample, Time at);
  /// `roll_rad`, `pitch_rad` absent: unknown, and no reason to stop.
  void update(Time now, double roll_rad, double pitch_rad);
  /// Why nothing may move; empty when all is well.
  const Reason& reason() const { return reason_; }

 private:
  HealthConfig config_;
  double up_mps2_ = kAbsent;     ///< along z, smoothed
  double force_mps2_ = kAbsent;  ///< magnitude, smoothed
  Time sample_at_ = kNever;
  bool wrong_axis_ = false;  ///< gravity, when it was felt last
  Time tilted_since_ = kNever;
  Reason reason_;
};

}  // namespace drover::engine
