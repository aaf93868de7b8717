// How chassis say a speed on their wires: whole millimetres, or thousandths of a radian, a second.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>

namespace drover {

/// Towards zero: a ramp down to rest never asks for more than it was told. Beyond what fits the
/// most that does; what is no number is 0.
inline std::int16_t thousandths(double value) {
  if (!std::isfinite(value)) return 0;
  constexpr double kMost = std::numeric_limits<std::int16_t>::max();
  constexpr double kRounding = 1e-7;  // 0.57 * 1000 is a little less than 570
  const double size = std::floor(std::abs(value) * 1000 + kRounding);
  return static_cast<std::int16_t>(std::copysign(std::min(size, kMost), value));
}

}  // namespace drover
