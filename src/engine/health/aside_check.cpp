// The first way aside of a base that goes sideways, by its wheels and by the receiver.
#include "engine/health/aside_check.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "engine/base/kinematics.h"
#include "engine/health/ground_way.h"
#include "engine/health/place_sigma.h"
#include "engine/still.h"

namespace drover::engine {
namespace {

constexpr double kFirstAside_mps = 0.05;
constexpr Duration kStillAside = std::chrono::seconds(1);
constexpr int kMeanOfPlaces = 5;
constexpr double kRestsAside_mps = 0.005;  // aside
// As of the first way ahead: two positions in succession, or one.
constexpr double kAsideSigmas = 2.5;
constexpr double kAsideSigmasAtOnce = 5.0;
constexpr double kWrongAsideFrom_m = 0.04;
constexpr double kWrongAsideShare = 0.5;  // of what the wheels say
constexpr double kProvedAsideFrom_m = 0.15;
constexpr double kProvedAsideShare = 0.5;
// A heading that is some degrees off makes each way ahead a way aside, too: where much more is gone
// ahead than aside the comparison begins anew.
constexpr double kAheadBeside_m = 0.3;
constexpr double kAheadBesideShare = 15;
constexpr double kAsideJumps_m = 0.05;
constexpr double kAsideJumpSigmas = 5.0;
constexpr double kMostAsideOfWheels = 3.0;  // goes a base of what its wheels say

double length_of_m(const PathPoint& way) {
  return std::hypot(way.x_m, way.y_m);
}

PathPoint way_between(const PathPoint& from, const PathPoint& to) {
  return {to.x_m - from.x_m, to.y_m - from.y_m};
}

}  // namespace

AsideCheck::AsideCheck(const EngineConfig& config)
    : estimate_(config.estimate),
      first_m_(config.navigate.first_way_m),
      proved_(!(first_m_ > 0) || !limits(kinematics_of(config.base)).sideways),
      antenna_(antenna_of(config.estimate, kMaxOfKind)) {}

void AsideCheck::forget_receiver(const AntennaConfig& antenna) {
  antenna_ = antenna;
  marks_.clear();
  places_ = odd_places_ = 0;
  has_origin_ = fresh_position_ = false;
}

void AsideCheck::on_position(const GnssPosition& position, Time at) {
  if (proved_) return;
  const bool usable = position.quality == FixQuality::rtk_fixed &&
                      std::isfinite(position.latitude_deg) && std::isfinite(position.longitude_deg);
  if (!usable) {
    places_ = odd_places_ = 0;
    fresh_position_ = false;
    return;
  }
  if (!has_origin_) origin_ = position;
  has_origin_ = true;
  position_ = position;
  position_at_ = at;
  fresh_position_ = true;
}

void AsideCheck::look_from(const PathPoint& place, const Mark& wheels) {
  from_ = place;
  places_ = 1;
  began_ = wheels;
  odd_places_ = 0;
}

/// Another integer solution, or a heading that is found: the comparison begins anew behind it.
bool AsideCheck::jumps(const PathPoint& place, const Mark& wheels, double sigma_m) {
  const double gone_m = length_of_m(way_between(last_, place));
  const double aside_m = length_of_m(way_between(compared_.aside, wheels.aside));
  return gone_m >
         kMostAsideOfWheels * aside_m + std::max(kAsideJumpSigmas * sigma_m, kAsideJumps_m);
}

void AsideCheck::judge(const PathPoint& place, const Mark& wheels, double sigma_m) {
  const PathPoint by_wheels = way_between(began_.aside, wheels.aside);
  const PathPoint seen = way_between(from_, place);
  const double wheels_m = length_of_m(by_wheels);
  if (!(wheels_m > kWrongAsideFrom_m)) return;
  const double along_m = (seen.x_m * by_wheels.x_m + seen.y_m * by_wheels.y_m) / wheels_m;
  const bool against = -along_m > std::max(kWrongAsideFrom_m, kWrongAsideShare * wheels_m);
  odd_places_ = against && -along_m > kAsideSigmas * sigma_m ? odd_places_ + 1 : 0;
  if (odd_places_ >= 2 || (odd_places_ == 1 && -along_m > kAsideSigmasAtOnce * sigma_m)) {
    const bool left = by_wheels.y_m * std::cos(yaw_rad_) - by_wheels.x_m * std::sin(yaw_rad_) > 0;
    fault_.format(
        "it goes to the %s where its wheels say %s: is the front wheel first in "
        "groups.base.left/right, are the rollers' axes an X from above?",
        left ? "right" : "left", left ? "left" : "right");
    return;
  }
  proved_ = rolled_m_ >= first_m_ && wheels_m > kProvedAsideFrom_m &&
            along_m > kProvedAsideShare * wheels_m;
}

void AsideCheck::compare() {
  fresh_position_ = false;
  const Mark* wheels = marks_.at(position_at_);
  if (wheels == nullptr) return;
  const PathPoint place = way_between(wheels->place, ground_way(origin_, position_));
  const double sigma_m = place_sigma_m(position_, estimate_);
  const double step_m = length_of_m(way_between(compared_.aside, wheels->aside));
  const bool rests = step_m <= kRestsAside_mps * std::max(to_s(wheels->at - compared_.at), 0.0);
  if (places_ == 0 || jumps(place, *wheels, sigma_m)) look_from(place, *wheels);
  last_ = place;
  compared_ = *wheels;
  const double aside_m = length_of_m(way_between(began_.aside, wheels->aside));
  if (rests) {
    // What it went before it rests is no part of the next way.
    if (goes_) look_from(place, *wheels);
    goes_ = false;
    const double share = 1.0 / std::min(++places_, kMeanOfPlaces);
    from_.x_m += share * (place.x_m - from_.x_m);
    from_.y_m += share * (place.y_m - from_.y_m);
    began_ = *wheels;
    return;
  }
  goes_ = true;
  if (wheels->ahead_m - began_.ahead_m > kAheadBeside_m + kAheadBesideShare * aside_m)
    return look_from(place, *wheels);
  judge(place, *wheels, sigma_m);
}

void AsideCheck::step(const AsideInput& input) {
  if (proved_) return;
  if (!input.still) still_since_ = kNever;
  if (input.still && still_since_ == kNever) still_since_ = input.now;
  if (input.still && !fault_.empty() && input.now - still_since_ >= kStillAside) {
    fault_.clear();
    places_ = odd_places_ = 0;
    rolled_m_ = 0;
  }
  const double dt_s = std::max(to_s(input.dt), 0.0);
  yaw_rad_ = input.yaw_rad;
  rolled_m_ += std::abs(input.body.vy_mps) * dt_s;
  ahead_m_ += std::abs(input.body.vx_mps) * dt_s;
  if (!std::isfinite(yaw_rad_)) {
    places_ = odd_places_ = 0;
    return;
  }
  const double c = std::cos(yaw_rad_);
  const double s = std::sin(yaw_rad_);
  way_.x_m += input.body.vx_mps * c * dt_s;
  way_.y_m += input.body.vx_mps * s * dt_s;
  aside_.x_m -= input.body.vy_mps * s * dt_s;
  aside_.y_m += input.body.vy_mps * c * dt_s;
  const PathPoint arm{antenna_.x_m * c - antenna_.y_m * s, antenna_.x_m * s + antenna_.y_m * c};
  marks_.remember({input.now, {way_.x_m + arm.x_m, way_.y_m + arm.y_m}, aside_, ahead_m_});
  if (fresh_position_ && fault_.empty()) compare();
}

double AsideCheck::cap_mps() const {
  const bool gone = proved_ || (fault_.empty() && rolled_m_ >= first_m_);
  return gone ? std::numeric_limits<double>::infinity() : kFirstAside_mps;
}

Twist AsideCheck::slowed(const Twist& wanted) const {
  const double share =
      std::min(1.0, cap_mps() / std::max(std::abs(wanted.vy_mps), kFirstAside_mps));
  return {share * wanted.vx_mps, share * wanted.wz_radps, share * wanted.vy_mps};
}

Twist AsideCheck::bounded(const Twist& wanted) const {
  Twist twist = wanted;
  twist.vy_mps = std::clamp(wanted.vy_mps, -cap_mps(), cap_mps());
  return twist;
}

double AsideCheck::rim_cap_mps(const Twist& stream) const {
  return goes_sideways(stream) ? cap_mps() : std::numeric_limits<double>::infinity();
}

Reason AsideCheck::slowly(const Twist& asked) const {
  Reason why;
  if (!fault_.empty() || !(std::abs(asked.vy_mps) > cap_mps())) return why;
  // Never "0.00 m are left".
  why.format(
      "slowly: the way aside by the wheels and by the receiver is compared on its first %.3g "
      "m, %.2f m are left",
      first_m_, std::max(first_m_ - rolled_m_, 0.01));
  return why;
}

}  // namespace drover::engine
