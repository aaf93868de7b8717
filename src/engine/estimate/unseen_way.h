// The way since the last RTK fix that was believed. How much of it the wheels slipped nobody has
// seen: a bound has to have room for it, because no source shows it before the next fix.
#pragma once

#include <cmath>

namespace drover::engine::estimate {

struct UnseenWay {
  double way_m = 0;  ///< either direction
  // Of it what led east, north and both at once: it sums up to the way.
  double ee_m = 0;
  double en_m = 0;
  double nn_m = 0;

  /// A step of dead reckoning.
  void advance(double east_m, double north_m) {
    const double long_m = std::hypot(east_m, north_m);
    if (!(long_m > 0)) return;
    way_m += long_m;
    ee_m += east_m * east_m / long_m;
    en_m += east_m * north_m / long_m;
    nn_m += north_m * north_m / long_m;
  }
  /// Of an error along it so much is left.
  void keep(double share) {
    way_m *= share;
    ee_m *= share;
    en_m *= share;
    nn_m *= share;
  }
  /// Of what came since `before` so much is left.
  void keep_since(const UnseenWay& before, double share) {
    way_m = before.way_m + share * (way_m - before.way_m);
    ee_m = before.ee_m + share * (ee_m - before.ee_m);
    en_m = before.en_m + share * (en_m - before.en_m);
    nn_m = before.nn_m + share * (nn_m - before.nn_m);
  }
  /// The most of it that may lead aside of who has this heading now: ahead of him none does.
  double aside_m(double yaw_rad) const {
    const double c = std::cos(yaw_rad);
    const double s = std::sin(yaw_rad);
    const double across_m = ee_m * s * s - 2 * en_m * s * c + nn_m * c * c;
    return across_m > 0 ? std::sqrt(way_m * across_m) : 0.0;
  }
};

}  // namespace drover::engine::estimate
