// The way since the last RTK fix that was believed. How much of it the wheels slipped nobody has
// seen: a bound has to have room for it, because no source shows it before the next fix.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>

#include "drover/angle.h"

namespace drover::engine::estimate {

struct UnseenWay {
  double way_m = 0;   ///< in both gears
  double east_m = 0;  ///< where it led in all
  double north_m = 0;
  // Of it what led east, north and both at once: it sums up to the way.
  double ee_m = 0;
  double en_m = 0;
  double nn_m = 0;
  // How far it went to and fro along each of four directions, from east on to the left.
  std::array<double, 4> to_and_fro_m{};

  /// A step of dead reckoning.
  void advance(double step_east_m, double step_north_m) {
    const double long_m = std::hypot(step_east_m, step_north_m);
    if (!(long_m > 0)) return;
    way_m += long_m;
    east_m += step_east_m;
    north_m += step_north_m;
    ee_m += step_east_m * step_east_m / long_m;
    en_m += step_east_m * step_north_m / long_m;
    nn_m += step_north_m * step_north_m / long_m;
    for (std::size_t i = 0; i < to_and_fro_m.size(); ++i)
      to_and_fro_m[i] += std::abs(kEast[i] * step_east_m + kNorth[i] * step_north_m);
  }
  /// Of an error along it so much is left.
  void keep(double share) { keep_since({}, share); }
  /// Of what came since `before` so much is left.
  void keep_since(const UnseenWay& before, double share) {
    const auto keep = [share](double& now, double then) { now = then + share * (now - then); };
    keep(way_m, before.way_m);
    keep(east_m, before.east_m);
    keep(north_m, before.north_m);
    keep(ee_m, before.ee_m);
    keep(en_m, before.en_m);
    keep(nn_m, before.nn_m);
    for (std::size_t i = 0; i < to_and_fro_m.size(); ++i)
      keep(to_and_fro_m[i], before.to_and_fro_m[i]);
  }
  /// The most of it that may lead aside of who has this heading now: ahead of him none does.
  double aside_m(double yaw_rad) const {
    const double c = std::cos(yaw_rad);
    const double s = std::sin(yaw_rad);
    const double across_m = ee_m * s * s - 2 * en_m * s * c + nn_m * c * c;
    return across_m > 0 ? std::sqrt(way_m * across_m) : 0.0;
  }
  /// Of what went to and fro along this direction the part in it, and the part against it.
  double in_m(double yaw_rad) const { return std::max(along_m(yaw_rad) + led_m(yaw_rad), 0.0) / 2; }
  double against_m(double yaw_rad) const {
    return std::max(along_m(yaw_rad) - led_m(yaw_rad), 0.0) / 2;
  }
  /// Whether who slipped by at most this share of any part of it is so far from where it leads, to
  /// within `known_m`: in no direction is he farther behind than all that led there allows.
  bool slips_to(double off_east_m, double off_north_m, double share, double known_m) const {
    for (std::size_t i = 0; i < to_and_fro_m.size(); ++i) {
      const double led = kEast[i] * east_m + kNorth[i] * north_m;
      const double behind_m = -kEast[i] * off_east_m - kNorth[i] * off_north_m;
      if (behind_m > share * (to_and_fro_m[i] + led) / 2 + known_m) return false;
      if (-behind_m > share * (to_and_fro_m[i] - led) / 2 + known_m) return false;
    }
    return true;
  }

 private:
  static constexpr double kDiagonal = 0.70710678118654752;
  static constexpr std::array<double, 4> kEast{1, kDiagonal, 0, -kDiagonal};
  static constexpr std::array<double, 4> kNorth{0, kDiagonal, 1, kDiagonal};

  double along_m(double yaw_rad) const { return aside_m(yaw_rad + kPi / 2); }
  double led_m(double yaw_rad) const {
    return east_m * std::cos(yaw_rad) + north_m * std::sin(yaw_rad);
  }
};

}  // namespace drover::engine::estimate
