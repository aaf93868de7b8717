// How a Hunter's wheels are steered: the angle of the inner one.
#include "drivers/agilex_v2/steering.h"

#include <algorithm>
#include <cmath>

namespace drover::agilex_v2 {

double Steering::radpm(double inner_rad) const {
  const double size_rad = std::min(std::abs(inner_rad), most_rad);
  // The inner wheel's curve is narrower by half the track: 1 / (L / tan + w / 2).
  const double slope = std::tan(size_rad);
  return std::copysign(slope / (wheelbase_m + track_m / 2 * slope), inner_rad);
}

double Steering::inner_rad(double radpm) const {
  const double size = std::abs(radpm);
  const double inner_m = 1 - track_m / 2 * size;
  const double size_rad = inner_m > 0 ? std::atan(wheelbase_m * size / inner_m) : most_rad;
  return std::copysign(std::min(size_rad, most_rad), radpm);
}

double Steering::middle_rad(double inner_rad) const {
  return std::atan(wheelbase_m * radpm(inner_rad));
}

}  // namespace drover::agilex_v2
