// Seeded noise for simulated devices: the same numbers on every machine.
#pragma once

#include <cstdint>

namespace drover {

/// SplitMix64 (Steele, Lea, Flood 2014): small, fast, and good enough for noise.
class Random final {
 public:
  explicit Random(std::uint64_t seed) : state_(seed) {}
  std::uint64_t bits();
  double uniform();  ///< [0, 1)
  /// Mean 0, variance 1, bounded by 6: a sum of twelve uniforms, so that no library function's last
  /// digit matters.
  double normal();

 private:
  std::uint64_t state_;
};

/// A first-order Gauss-Markov process of variance 1: noise that remembers for `tau_s`.
class Drift final {
 public:
  Drift(double tau_s, Random& random) : tau_s_(tau_s), value_(random.normal()) {}
  double step(double elapsed_s, Random& random);

 private:
  double tau_s_;
  double value_;
};

/// A receiver's error on one axis, of variance 1: mostly drifting, a little white.
class AxisError final {
 public:
  AxisError(double tau_s, Random& random) : drift_(tau_s, random) {}
  double step(double elapsed_s, Random& random);

 private:
  Drift drift_;
};

}  // namespace drover
