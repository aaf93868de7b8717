// The gyro's bias about all three axes, learned while the base stands.
#pragma once

#include <array>

#include "drover/measurement.h"
#include "drover/time.h"

namespace drover::engine::estimate {

/// The mean of at least two seconds of standing wheels and steady rates; the newest one counts.
class RestBias final {
 public:
  void update(const Vector3& rate_radps, Time at, bool standing);
  bool known() const { return known_; }
  const Vector3& bias_radps() const { return bias_radps_; }
  /// One sigma of the mean about z.
  double sigma_radps() const { return sigma_radps_; }

 private:
  void begin(const std::array<double, 3>& rate, Time at);

  Time since_ = kNever;
  Time last_ = kNever;
  double count_ = 0;
  std::array<double, 3> first_{};  ///< sums are taken from here, for their digits
  std::array<double, 3> sum_{};
  std::array<double, 3> sum2_{};
  bool known_ = false;
  Vector3 bias_radps_;
  double sigma_radps_ = kAbsent;
};

}  // namespace drover::engine::estimate
