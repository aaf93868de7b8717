// One step of a set point on its way.
#pragma once

#include <algorithm>
#include <cmath>

namespace drover::engine {

/// Towards `target` by at most `step`.
inline double approach(double value, double target, double step) {
  return std::abs(target - value) <= step ? target : value + std::copysign(step, target - value);
}
/// Nearer to rest, or as it is.
inline double no_more_than(double wanted, double measured) {
  return std::copysign(std::min(std::abs(wanted), wanted * measured > 0 ? std::abs(measured) : 0.0),
                       wanted);
}

}  // namespace drover::engine
