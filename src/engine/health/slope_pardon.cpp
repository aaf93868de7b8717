#include "engine/health/slope_pardon.h"

#include <algorithm>
#include <cmath>

#include "engine/health/creep_watch.h"
#include "engine/still.h"

namespace drover::engine {
namespace {

constexpr double kFaster_mps = 0.3;
constexpr double kRolled_m = 0.3;
// Of the speed that it had: what is slower has braked.
constexpr double kHasBraked = 0.5;
// Of the sine of the slope, whose doing it is however fast it was driven: 0.2 m/s on 15 %.
constexpr double kCreeps_mps = 1.35;
constexpr double kCreepsUnknown_mps = 0.2;  // where nobody knows how steep it is
constexpr double kCreepsUnheard_mps = 0.1;  // it may as well be driven so slowly
constexpr double kAlong = 0.87;             // of its way: within 30 degrees of the heading
// A second shows whether it stands. So long after a stop has to be looked at for longer.
constexpr Duration kLookTwice = std::chrono::seconds(6);

/// Of the way; absent without a heading.
double along(const PathPoint& way, double yaw_rad) {
  return way.x_m * std::cos(yaw_rad) + way.y_m * std::sin(yaw_rad);
}

}  // namespace

bool SlopePardon::stands() const {
  return witness.stood(input.now) ||
         (witness.stands(input.now) && input.now - last.rest_due < kLookTwice);
}

bool SlopePardon::goes(bool wheels_turn) const {
  const bool turns = witness.turns(input.now) && witness.hear(input.now).moving >= 2;
  return wheels_turn || turns || witness.proven_way(input.now);
}

bool SlopePardon::drives_on(const RimMotion& rims) const {
  const bool turns = std::abs(rims.fastest_mps) > kTurns_mps;
  if (!turns && witness.spins_on(input.now)) return true;
  // Frozen encoders may tell the last speed for ever.
  const double half_mps = kHasBraked * std::abs(rims.fastest_mps);
  const bool goes = rims.ahead != 0 || !turns;
  if (goes && (stands() || witness.is_slower(half_mps, input.now))) return false;
  if (turns) {
    if (creeps_down(rims.ahead, std::abs(rims.fastest_mps))) return false;
    // The program before this one may have driven it any way.
    const bool unknown = last.inherited && last.direction == 0 && last.turn == 0;
    const bool up = rims.ahead * input.falls_ahead < 0;
    return unknown || up || rims.fastest_mps * last.direction > 0 || rims.turn * last.turn > 0;
  }
  // Speed and place are one device's: it counts where it does not contradict itself.
  const auto way = witness.proven_way(input.now);
  return way &&
         along(*way, input.yaw_rad) * last.direction > kAlong * std::hypot(way->x_m, way->y_m);
}

/// Told to stand it only brakes, and the ground falls there: slow as it is, a cut lets it go.
bool SlopePardon::creeps_down(double ahead, double mps) const {
  const bool known = std::isfinite(input.falls_ahead);
  const double most_mps = known ? kCreeps_mps * std::abs(input.falls_ahead) : kCreepsUnknown_mps;
  return input.stop_creeps && goes_down(ahead, input.falls_ahead) && mps < most_mps;
}

bool SlopePardon::creeps_unheard() const {
  const double creep_mps = std::min(kHasBraked * last.fastest_mps, kCreepsUnheard_mps);
  return creeps_down(ahead_m(), 0) && witness.is_slower(creep_mps, input.now);
}

/// By the receiver, since rest is due.
double SlopePardon::ahead_m() const {
  return along(witness.way(input.now), input.yaw_rad);
}

bool SlopePardon::rolls() const {
  if (ahead_m() * input.falls_ahead < 0) return false;
  const double drove_mps =
      last.inherited ? std::max(last.fastest_mps, last.seen_mps) : last.fastest_mps;
  if (witness.speed_mps(input.now) > drove_mps + kFaster_mps) return true;
  if (!std::isfinite(input.yaw_rad)) return false;
  return ahead_m() * last.direction < -kRolled_m;
}

}  // namespace drover::engine
