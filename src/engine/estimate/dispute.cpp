#include "engine/estimate/dispute.h"

#include <algorithm>
#include <cmath>

namespace drover::engine::estimate {
namespace {

// Of the jump: nearer to the one place than to the other, with room for noise.
constexpr double kNear = 0.4;
constexpr double kWellKnown = 0.3;    // dead reckoning's two sigma
constexpr double kNewest = 0.2;       // of the newest position into where they are of late
constexpr double kNewestAway = 0.02;  // likewise, of one that is as far away as so much of the jump
constexpr double kAway = 0.5;
constexpr Duration kOutlier = std::chrono::seconds(1);
constexpr Duration kRenewed = std::chrono::seconds(60);
constexpr double kSamePlace = 4.0;     // sigmas of a position
constexpr double kWheelsAgree = 0.03;  // of the way
constexpr double kHeld_m = 0.06;       // so near positions keep their distance
constexpr double kHeldSigmas = 5.0;
constexpr double kLeads_m = 0.2;  // beside what slips: more is a receiver that drifts

Dispute::Offset plus(const Dispute::Offset& a, const Dispute::Offset& b) {
  return {a.east_m + b.east_m, a.north_m + b.north_m};
}

Dispute::Offset minus(const Dispute::Offset& a, const Dispute::Offset& b) {
  return {a.east_m - b.east_m, a.north_m - b.north_m};
}

}  // namespace

double Dispute::Offset::m() const {
  return std::hypot(east_m, north_m);
}

double Dispute::Offset::ahead_m(double yaw_rad) const {
  return east_m * std::cos(yaw_rad) + north_m * std::sin(yaw_rad);
}

double Dispute::Offset::left_m(double yaw_rad) const {
  return north_m * std::cos(yaw_rad) - east_m * std::sin(yaw_rad);
}

void Dispute::begin(const Offset& offset, Time since, bool found_again, Time now) {
  *this = {};
  found_again_ = found_again;
  since_ = since;
  heard_ = now;
  jump_ = late_ = last_ = offset;
}

void Dispute::came_from(const Offset& last) {
  from_ = last;
  jump_ = minus(last_, from_);
}

double Dispute::apart_m() const {
  return std::max(last_.m(), minus(from_, put_right_).m());
}

void Dispute::lose_fix() {
  lost_ = found_again_ = holds();
  held_since_ = kNever;
  steady_ = false;
}

Dispute::Offset Dispute::astray() const {
  return minus(last_, held_);
}

void Dispute::put_right(const Offset& by) {
  late_ = minus(late_, by);
  last_ = minus(last_, by);
  put_right_ = plus(put_right_, by);
}

void Dispute::advance(double east_m, double north_m) {
  const double way_m = std::hypot(east_m, north_m);
  way_m_ += way_m;
  unheard_m_ += way_m;
  gone_.advance(east_m, north_m);
}

double Dispute::led_aside_m(double yaw_rad) const {
  return std::abs(put_right_.left_m(yaw_rad));
}

bool Dispute::may_lead(double yaw_rad, double slip_share) const {
  const double along_m = std::abs(put_right_.ahead_m(yaw_rad));
  const double least_m = std::min(kHeld_m + kWheelsAgree * gone_.way_m, kLeads_m);
  return along_m <= least_m + slip_share * gone_.way_m &&
         led_aside_m(yaw_rad) <= least_m + slip_share * gone_.aside_m(yaw_rad);
}

Time Dispute::decided_at() const {
  return holds() && renews_ ? heard_ + kRenewed - held_for_ : kNever;
}

/// Another jump is another distance.
void Dispute::hold(const Offset& offset, double noise_m, bool settled, Time now) {
  steady_ = false;
  if (!settled) held_since_ = kNever;
  if (!settled) return;
  const bool near = minus(offset, held_).m() <= std::max(kHeld_m, kHeldSigmas * noise_m);
  if (near) away_since_ = kNever;
  if (!near && away_since_ == kNever) away_since_ = now;
  if (held_since_ == kNever || (!near && now - away_since_ >= kOutlier)) {
    held_ = offset;
    held_since_ = now;
    held_count_ = 1;
    away_since_ = kNever;
    return;
  }
  if (!near) return;
  steady_ = now - held_since_ >= kOutlier;
  if (steady_) return;
  ++held_count_;
  held_.east_m += (offset.east_m - held_.east_m) / held_count_;
  held_.north_m += (offset.north_m - held_.north_m) / held_count_;
}

/// At first, what is near again was an outlier, or a mast that swayed; and where it came from was
/// one when it is nearer than that.
bool Dispute::came_back(const Offset& offset, double two_sigma_m, Time now) const {
  const Offset step = minus(offset, late_);
  const bool stepped = !lost_ && plus(step, jump_).m() < kNear * jump_.m();
  const double beside_m = plus(jump_, from_).m();
  const bool known = two_sigma_m < kWellKnown * beside_m && offset.m() < kNear * beside_m;
  const bool outlier =
      now - since_ < kOutlier && offset.m() < kNear * std::max(beside_m, from_.m());
  return stepped || known || outlier;
}

void Dispute::follow(const Offset& offset, Time now) {
  const Offset step = minus(offset, late_);
  const double share = step.m() > kAway * jump_.m() ? kNewestAway : kNewest;
  late_.east_m += share * step.east_m;
  late_.north_m += share * step.north_m;
  if (now - since_ > kOutlier || step.m() > kAway * jump_.m()) return;
  ++first_;
  jump_.east_m += (offset.east_m - from_.east_m - jump_.east_m) / (first_ + 1);
  jump_.north_m += (offset.north_m - from_.north_m - jump_.north_m) / (first_ + 1);
}

/// With wheels and gyro, since it was found; and where it was, since the last position.
bool Dispute::may_hold(const Offset& by_wheels, double allowed_m) const {
  const double crept_m = minus(by_wheels, renewed_at_).m();
  const double stepped_m = minus(by_wheels, by_wheels_).m();
  return renews_ && crept_m <= allowed_m + kWheelsAgree * way_m_ &&
         stepped_m <= std::max(allowed_m, kHeld_m) + kWheelsAgree * unheard_m_;
}

Dispute::Verdict Dispute::hear(const Offset& offset, bool inside, double two_sigma_m,
                               double noise_m, bool settled, bool stands, Time now) {
  if (now - heard_ > kFixGone) lose_fix();
  const Duration since = held_since_ == kNever ? Duration{} : now - heard_;
  heard_ = now;
  const Offset before = plus(last_, put_right_);
  last_ = offset;
  if (inside && came_back(offset, two_sigma_m, now)) return Verdict::came_back;
  follow(offset, now);
  hold(offset, noise_m, settled, now);
  if (!found_again_) return Verdict::undecided;
  const Offset by_wheels = plus(offset, put_right_);
  const double allowed_m = std::hypot(kSamePlace * noise_m, two_sigma_m);
  const bool holds = may_hold(by_wheels, allowed_m);
  const bool elsewhere = minus(by_wheels, before).m() > std::max(allowed_m, kHeld_m);
  by_wheels_ = by_wheels;
  unheard_m_ = 0;
  held_for_ += since;
  if (!holds) {
    moved_at_rest_ = moved_at_rest_ || (stands && (renews_ || elsewhere));
    renews_ = true;
    held_for_ = {};
    renewed_at_ = by_wheels;
    way_m_ = 0;
  }
  return held_for_ >= kRenewed ? Verdict::renewed : Verdict::undecided;
}

}  // namespace drover::engine::estimate
