// Noise generators of the simulated devices.
#include "drivers/noise.h"

#include <cmath>

namespace drover {

std::uint64_t Random::bits() {
  state_ += 0x9E3779B97F4A7C15U;
  std::uint64_t z = state_;
  z = (z ^ (z >> 30U)) * 0xBF58476D1CE4E5B9U;
  z = (z ^ (z >> 27U)) * 0x94D049BB133111EBU;
  return z ^ (z >> 31U);
}

double Random::uniform() {
  return static_cast<double>(bits() >> 11U) * 0x1.0p-53;
}

double Random::normal() {
  double sum = -6;
  for (int i = 0; i < 12; ++i) sum += uniform();
  return sum;
}

double Drift::step(double elapsed_s, Random& random) {
  const double keep = std::exp(-elapsed_s / tau_s_);
  value_ = keep * value_ + std::sqrt(1 - keep * keep) * random.normal();
  return value_;
}

double AxisError::step(double elapsed_s, Random& random) {
  constexpr double kDriftShare = 0.9;  // of the variance
  const double drift = drift_.step(elapsed_s, random);
  return std::sqrt(kDriftShare) * drift + std::sqrt(1 - kDriftShare) * random.normal();
}

}  // namespace drover
