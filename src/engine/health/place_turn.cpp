// A turn by the wheels beside where the antenna goes.
#include "engine/health/place_turn.h"

#include <cmath>

#include "drover/angle.h"

namespace drover::engine {
namespace {

// As of the ways: two places in succession, or one.
constexpr double kTurnSigmas = 2.5;
constexpr double kTurnSigmasAtOnce = 5.0;
// Soil and skidding wheels take up most of a turn, in the worst case.
constexpr double kTurnsAtLeast = 0.2;  // of what the wheels say
constexpr double kNoTurnFrom = 4.5;    // sigmas that a whole turn would be aside
// What wheels say of a turn is some ten percent off, which becomes more the farther it goes.
constexpr double kFarthest_m = 1.5;
const double kWidest_rad = to_rad(45);
// How well a heading is known with which a task begins, and that a wheel a little larger than the
// other bends the way.
const double kHeading_rad = to_rad(2.0);

/// How far to the left the antenna is, of a base that went so and turned so.
double antenna_left_m(double left_m, double turn_rad, const AntennaConfig& antenna) {
  return left_m + antenna.x_m * std::sin(turn_rad) + antenna.y_m * (std::cos(turn_rad) - 1);
}

}  // namespace

void PlaceTurn::begin() {
  *this = {};
}

void PlaceTurn::count(Verdict what, bool clear) {
  if (what != Verdict::open && (clear || what == last_)) verdict_ = what;
  last_ = what;
}

void PlaceTurn::look(const WheelsWay& wheels, const PathPoint& antenna_went,
                     const AntennaConfig& antenna, double sigma_m) {
  const bool far = antenna_went.x_m * antenna_went.x_m > kFarthest_m * kFarthest_m;
  if (verdict_ != Verdict::open || far || std::abs(wheels.turn_rad) > kWidest_rad) return;
  const double as_told_m = antenna_left_m(wheels.left_m, wheels.turn_rad, antenna);
  const double mirrored_m = antenna_left_m(-wheels.left_m, -wheels.turn_rad, antenna);
  const double half_m = (as_told_m - mirrored_m) / 2;
  const double aside_m = antenna_went.y_m - (as_told_m + mirrored_m) / 2;
  const double sigma = std::hypot(sigma_m, antenna_went.x_m * kHeading_rad);
  const double share = half_m != 0 ? aside_m / half_m : 0.0;
  wheels_rad_ = wheels.turn_rad;
  turned_rad_ = share * wheels.turn_rad;
  const bool seen = std::abs(aside_m) > kTurnSigmas * sigma;
  const bool clear = std::abs(aside_m) > kTurnSigmasAtOnce * sigma;
  // What the wheels turned by little is no turn, however far aside it went.
  const bool turned = std::abs(half_m) > kTurnSigmas * sigma;
  if (turned && seen && std::abs(share) > kTurnsAtLeast) {
    count(share > 0 ? Verdict::right : Verdict::against, clear);
  } else {
    const bool none = std::abs(half_m) > kNoTurnFrom * sigma && std::abs(share) < kTurnsAtLeast;
    count(none ? Verdict::not_at_all : Verdict::open, false);
  }
}

}  // namespace drover::engine
