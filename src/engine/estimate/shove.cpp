#include "engine/estimate/shove.h"

#include <algorithm>
#include <cmath>

namespace drover::engine::estimate {
namespace {

constexpr double kUsual_s = 2.0;
constexpr double kLeaks_s = 0.12;
constexpr double kShoved_mps = 0.12;  // faster than a base rocks on rough ground
constexpr double kQuiet_mps2 = 0.6;
constexpr Duration kQuietFor = std::chrono::milliseconds(150);
constexpr Duration kLongest = std::chrono::seconds(1);
// Sideways it rests again, by what adding up once gets wrong: m/s, and of the fastest.
constexpr double kAtRest_mps = 0.1;
constexpr double kAtRest = 0.35;
// What adding up twice gets wrong, one sigma: of the way, and in any case.
constexpr double kShare = 0.25;
constexpr double kAnyway_m = 0.015;

void end(Shove& shove, Time now) {
  shove.since = shove.quiet = kNever;
  shove.ended = now;
  shove.left_mps = 0;
}

void move(Shove& shove, Belief& belief, double left_m) {
  const double c = std::cos(belief.mean[kYaw]);
  const double s = std::sin(belief.mean[kYaw]);
  belief.mean[kX] -= left_m * s;
  belief.mean[kY] += left_m * c;
  shove.left_m += left_m;
  const double variance_m2 = square(kShare * shove.left_m) + square(kAnyway_m);
  const double more_m2 = variance_m2 - shove.variance_m2;
  if (!(more_m2 > 0)) return;
  shove.variance_m2 = variance_m2;
  Matrix& p = belief.covariance;
  p[kX][kX] += more_m2 * s * s;
  p[kY][kY] += more_m2 * c * c;
  p[kX][kY] -= more_m2 * s * c;
  p[kY][kX] = p[kX][kY];
}

}  // namespace

void follow(Shove& shove, Belief& belief, double left_mps2, double dt_s, bool may_begin, Time now) {
  shove.left_mps += (left_mps2 - shove.usual_mps2) * dt_s;
  if (!shove.holds()) {
    shove.usual_mps2 += dt_s / kUsual_s * (left_mps2 - shove.usual_mps2);
    shove.left_mps *= std::exp(-dt_s / kLeaks_s);
    if (!may_begin || std::abs(shove.left_mps) < kShoved_mps) return;
    shove.since = now;
    shove.quiet_m = shove.left_m = shove.variance_m2 = shove.fastest_mps = 0;
  }
  if (std::abs(shove.left_mps) > std::abs(shove.fastest_mps)) shove.fastest_mps = shove.left_mps;
  // It has come to rest sideways: what is felt from here on is another motion, as a turn.
  if (shove.left_mps * shove.fastest_mps <= 0) return end(shove, now);
  const bool pushed = std::abs(left_mps2 - shove.usual_mps2) > kQuiet_mps2;
  if (pushed) {
    shove.quiet = kNever;
    shove.quiet_m = 0;
  } else if (shove.quiet == kNever) {
    shove.quiet = now;
  }
  const double left_m = shove.left_mps * dt_s;
  if (!pushed) shove.quiet_m += left_m;
  move(shove, belief, left_m);
  const bool quiet = shove.quiet != kNever && now - shove.quiet >= kQuietFor;
  if (!quiet && now - shove.since < kLongest) return;
  // No base goes on sliding: what was felt was the sensor's tilt.
  const bool slides =
      std::abs(shove.left_mps) > std::max(kAtRest_mps, kAtRest * std::abs(shove.fastest_mps));
  // It rests since nothing pushes it.
  move(shove, belief, slides ? -shove.left_m : -shove.quiet_m);
  end(shove, now);
}

}  // namespace drover::engine::estimate
