// The speed that is published: of what wheels and receiver say the worse, since somebody who reads
// 0 walks up to the robot.
#pragma once

#include <array>

#include "drover/time.h"

namespace drover::engine {

struct SpeedInput {
  Time now = kNever;
  double wheels_mps = 0;       ///< of the base, ahead positive; NaN while nobody knows
  double fastest_rim_mps = 0;  ///< of any wheel on the ground
  double receiver_mps = 0;     ///< without a sign; 0: it says nothing
  Time receiver_at = kNever;   ///< when it was measured
  double direction = 0;        ///< sign in which the base was driven last; 0: it never was
};

/// A receiver tells of a moment ago, and smooths: after a stop it still says the speed before. So
/// it counts only where it is faster than any wheel has been since then; frozen encoders were not.
class WorstSpeed final {
 public:
  /// Once a cycle. m/s, ahead positive; the wheels' own where they explain all.
  double update(const SpeedInput& input);

 private:
  double fastest_since(Time from) const;

  static constexpr Duration kSlice = std::chrono::milliseconds(50);
  struct Slice {
    Time begin = kNever;
    double fastest_mps = 0;
  };
  std::array<Slice, 20> slices_{};  ///< a second, longer than a receiver counts as fresh
  std::size_t newest_ = 0;
};

}  // namespace drover::engine
