// How fast a base may be that has so far to go before it has to stand.
#pragma once

#include <algorithm>
#include <cmath>

namespace drover::engine {

/// From the moment that something is known to the base's braking, and how it brakes.
struct StopChain {
  double reaction_s = 0;    ///< at the old speed: the next answer, the cycle, the drives
  double deceleration = 1;  ///< m/s^2, or rad/s^2 of a turn
};

/// Of the deceleration: how what is seen from afar is come to.
inline constexpr double kGentle = 0.5;

/// m/s with `way` in m, rad/s in rad; 0 when there is none, or it is no number.
inline double permitted_speed(double way, const StopChain& chain) {
  if (!(way > 0)) return 0;
  const double coasts = chain.deceleration * chain.reaction_s;
  return std::sqrt(coasts * coasts + 2 * chain.deceleration * way) - coasts;
}

/// The way that a stop from this speed takes, the inverse.
inline double stop_way(double speed, const StopChain& chain) {
  return std::abs(speed) * chain.reaction_s + speed * speed / (2 * chain.deceleration);
}

}  // namespace drover::engine
