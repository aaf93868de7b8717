// One step of a set point on its way.
#pragma once

#include <cmath>

namespace drover::engine {

/// Towards `target` by at most `step`.
inline double approach(double value, double target, double step) {
  return std::abs(target - value) <= step ? target : value + std::copysign(step, target - value);
}

}  // namespace drover::engine
