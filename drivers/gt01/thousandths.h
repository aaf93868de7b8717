// How both wires say a speed: whole millimetres, or thousandths of a radian, a second.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>

namespace drover::gt01 {

/// Beyond what fits the most that does; what is no number is 0.
inline std::int16_t thousandths(double value) {
  if (!std::isfinite(value)) return 0;
  constexpr double kMost = std::numeric_limits<std::int16_t>::max();
  return static_cast<std::int16_t>(std::clamp(std::round(value * 1000), -kMost, kMost));
}

}  // namespace drover::gt01
