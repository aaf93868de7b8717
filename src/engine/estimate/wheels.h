// The latest rim speed of each wheel, and what they say together about the motion of the base.
#pragma once

#include <array>

#include "drover/measurement.h"
#include "drover/time.h"
#include "engine/config.h"
#include "engine/estimate/filter.h"

namespace drover::engine::estimate {

inline constexpr std::size_t kWheelsPerSide = 8;
inline constexpr std::size_t kWheels = 2 * kWheelsPerSide;  ///< left ones first

class Wheels final {
 public:
  void set(std::size_t wheel, double rim_mps, Time at);
  /// The motion at `at`. A wheel that has been silent for longer than `stale` is left out; a side
  /// with no wheel left makes the motion unknown.
  WheelMotion motion(Time at, Duration stale) const;
  /// The next instant after `at` when a wheel that counts now will have gone stale, or the far
  /// future.
  Time next_stale(Time at, Duration stale) const;

 private:
  struct Wheel {
    double rim_mps = 0;
    Time at = kNever;
  };
  std::array<Wheel, kWheels> wheels_{};
};

/// Which wheel an axis of the base is; kWheels when it is none.
std::size_t wheel_of(const BaseConfig& base, AxisId axis);

}  // namespace drover::engine::estimate
