#include "calibrate/recipe.h"

#include <algorithm>
#include <cmath>

#include "drover/angle.h"
#include "drover/command.h"

namespace drover::calibrate {
namespace {

constexpr double kStand_s = 6;
constexpr double kSigns_s = 2;        // at rest, while the signs are judged
constexpr double kSlow_m = 2.6;       // of straight way: more than the signs need
constexpr double kSlowCurve_m = 1.5;  // tighter ones are hard work for wheels that skid
constexpr double kLeg_m = 10;
constexpr double kWayBack_m = 12;  // the circles lead ahead
constexpr double kSteps = 4;       // of speed on a straight
constexpr double kSlow_mps = 0.3;
constexpr double kFast_mps = 0.7;
constexpr double kRound_mps = 0.45;
// Each further round than once, and together half a turn: the way back leads back.
const double kLeft_rad = to_rad(400);
const double kRight_rad = to_rad(-580);
constexpr double kBack = 1.0;  // 1/s: turned back where a straight was left
constexpr double kMostBack_radps = 0.15;
constexpr int kMostRounds = 3;
constexpr double kAround_m = 1;
constexpr double kOff_m = 0.4;  // that the drive may lead elsewhere than by its numbers

/// Where a piece leads, by its numbers.
struct Place {
  double x_m = 0;
  double y_m = 0;
  double yaw_rad = 0;
};

void widen(Area& area, const Place& at) {
  area.ahead_m = std::max(area.ahead_m, at.x_m);
  area.behind_m = std::max(area.behind_m, -at.x_m);
  area.left_m = std::max(area.left_m, at.y_m);
  area.right_m = std::max(area.right_m, -at.y_m);
}

void walk(const Piece& piece, Place& at, Area& area) {
  constexpr int kParts = 100;
  const double way_m =
      piece.way_m > 0 ? piece.way_m : std::abs(piece.turn_rad) * piece.radius_m * kWider;
  for (int i = 0; i < kParts; ++i) {
    const double middle_rad = at.yaw_rad + piece.turn_rad / kParts / 2;
    at.x_m += way_m / kParts * std::cos(middle_rad);
    at.y_m += way_m / kParts * std::sin(middle_rad);
    at.yaw_rad += piece.turn_rad / kParts;
    widen(area, at);
  }
}

Piece stand(std::string_view what, double seconds) {
  Piece piece;
  piece.what = what;
  piece.stand_s = seconds;
  return piece;
}
Piece straight(std::string_view what, double way_m, double slow_mps, double fast_mps) {
  Piece piece;
  piece.what = what;
  piece.way_m = way_m;
  piece.slow_mps = slow_mps;
  piece.fast_mps = fast_mps;
  return piece;
}
Piece curve(std::string_view what, double turn_rad, double radius_m, double mps) {
  Piece piece;
  piece.what = what;
  piece.turn_rad = turn_rad;
  piece.radius_m = radius_m;
  piece.slow_mps = piece.fast_mps = mps;
  return piece;
}

}  // namespace

Recipe::Recipe(const DriveLimits& limits) : limits_(limits) {
  const double mps = std::min(kUnproved_mps, limits.speed_mps);
  pieces_ = {stand("stand", kStand_s), straight("slowly straight on", kSlow_m, mps, mps),
             curve("slowly to the left", to_rad(45), kSlowCurve_m, mps),
             curve("slowly to the right", to_rad(-45), kSlowCurve_m, mps),
             stand("stand: are the signs right?", kSigns_s)};
  slow_pieces_ = pieces_.size();
  add_round();
}

void Recipe::add_round() {
  const double fast_mps = std::min(kFast_mps, limits_.speed_mps);
  const double slow_mps = kSlow_mps / kFast_mps * fast_mps;
  const double round_mps =
      std::min({kRound_mps, limits_.speed_mps, limits_.yaw_rate_radps * kCircle_m});
  if (++rounds_ > 1) pieces_.push_back(curve("turn round", to_rad(-180), kCircle_m, round_mps));
  pieces_.push_back(straight("straight on", kLeg_m, slow_mps, fast_mps));
  pieces_.push_back(curve("circle to the left", kLeft_rad, kCircle_m, round_mps));
  pieces_.push_back(curve("circle to the right", kRight_rad, kCircle_m, round_mps));
  pieces_.push_back(straight("straight back", kWayBack_m, slow_mps, fast_mps));
  pieces_.push_back(stand("stand", kStand_s));
}

bool Recipe::again() {
  if (rounds_ >= kMostRounds) return false;
  add_round();
  return true;
}

double Recipe::done() const {
  if (over()) return 0;
  const Piece& piece = pieces_[at_];
  if (piece.stand_s > 0) return stood_s_;
  return piece.way_m > 0 ? rolled_m_ : std::abs(turned_rad_);
}

double Recipe::of() const {
  if (over()) return 0;
  const Piece& piece = pieces_[at_];
  if (piece.stand_s > 0) return piece.stand_s;
  return piece.way_m > 0 ? piece.way_m : std::abs(piece.turn_rad);
}

void Recipe::look(const Moved& moved) {
  if (over() || asks_for_signs()) return;
  const Piece& piece = pieces_[at_];
  const bool stands = piece.stand_s > 0;
  // In one go: who was pushed about stands anew.
  stood_s_ = moved.still ? stood_s_ + std::max(moved.dt_s, 0.0) : 0;
  if (!stands && std::isfinite(moved.way_m)) rolled_m_ += moved.way_m;
  if (!stands && std::isfinite(moved.turn_rad)) turned_rad_ += moved.turn_rad;
  // A turn the wrong way round is none.
  const double turned_rad = piece.turn_rad < 0 ? -turned_rad_ : turned_rad_;
  const bool there = stands            ? stood_s_ >= piece.stand_s
                     : piece.way_m > 0 ? rolled_m_ >= piece.way_m
                                       : turned_rad >= std::abs(piece.turn_rad);
  if (!there) return;
  ++at_;
  stood_s_ = rolled_m_ = 0;
  // Where nobody looked in time it turned further: what follows begins with that.
  turned_rad_ = proved_ ? turned_rad_ - piece.turn_rad : 0;
}

Twist Recipe::wanted() const {
  if (over() || asks_for_signs()) return {};
  const Piece& piece = pieces_[at_];
  if (piece.stand_s > 0) return {};
  if (!(piece.way_m > 0))
    return {piece.slow_mps, std::copysign(piece.slow_mps / piece.radius_m, piece.turn_rad)};
  const int step = static_cast<int>(std::max(rolled_m_, 0.0) / piece.way_m * kSteps);
  const double mps = step % 2 == 0 ? piece.slow_mps : piece.fast_mps;
  // By a gyro that is mounted the other way round it would turn ever further.
  if (!proved_) return {mps, 0};
  return {mps, std::clamp(-kBack * turned_rad_, -kMostBack_radps, kMostBack_radps)};
}

Area Recipe::area() const {
  Recipe all = *this;
  while (all.again()) {
  }
  Area area;
  Place at;
  double fastest_mps = 0;
  for (const Piece& piece : all.pieces_) {
    walk(piece, at, area);
    fastest_mps = std::max(fastest_mps, piece.fast_mps);
  }
  // Where nobody says more, because all hangs, the last word counts on, and then comes a ramp.
  const double rolls_on_m =
      fastest_mps * to_s(kKeyHeld) + fastest_mps * fastest_mps / (2 * limits_.deceleration_mps2);
  const double around_m = std::max(kAround_m, kOff_m + rolls_on_m);
  area.ahead_m = std::ceil(area.ahead_m + around_m);
  area.behind_m = std::ceil(area.behind_m + around_m);
  area.left_m = std::ceil(area.left_m + around_m);
  area.right_m = std::ceil(area.right_m + around_m);
  return area;
}

}  // namespace drover::calibrate
