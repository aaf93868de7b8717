#include "engine/estimate/dispute.h"

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
constexpr Duration kGone = std::chrono::seconds(2);
constexpr Duration kRenewed = std::chrono::seconds(60);
constexpr double kSamePlace = 4.0;  // sigmas of a position

Dispute::Offset minus(const Dispute::Offset& a, const Dispute::Offset& b) {
  return {a.east_m - b.east_m, a.north_m - b.north_m};
}

}  // namespace

double Dispute::Offset::m() const {
  return std::hypot(east_m, north_m);
}

void Dispute::begin(const Offset& offset, Time since) {
  *this = {};
  since_ = heard_ = since;
  jump_ = late_ = last_ = offset;
}

void Dispute::lose_fix() {
  lost_ = holds();
  renewed_ = kNever;
}

/// At first, what is near again was an outlier, or a mast that swayed.
bool Dispute::came_back(const Offset& offset, double two_sigma_m, Time now) const {
  const double near_m = kNear * jump_.m();
  const Offset step = minus(offset, late_);
  const bool stepped =
      !lost_ && std::hypot(step.east_m + jump_.east_m, step.north_m + jump_.north_m) < near_m;
  const bool known = two_sigma_m < kWellKnown * jump_.m() || now - since_ < kOutlier;
  return stepped || (known && offset.m() < near_m);
}

void Dispute::follow(const Offset& offset, Time now) {
  const Offset step = minus(offset, late_);
  const double share = step.m() > kAway * jump_.m() ? kNewestAway : kNewest;
  late_.east_m += share * step.east_m;
  late_.north_m += share * step.north_m;
  if (now - since_ > kOutlier || step.m() > kAway * jump_.m()) return;
  ++first_;
  jump_.east_m += (offset.east_m - jump_.east_m) / (first_ + 1);
  jump_.north_m += (offset.north_m - jump_.north_m) / (first_ + 1);
}

Dispute::Verdict Dispute::hear(const Offset& offset, bool inside, double two_sigma_m,
                               double noise_m, Time now) {
  if (now - heard_ > kGone) lose_fix();
  heard_ = now;
  last_ = offset;
  if (inside && came_back(offset, two_sigma_m, now)) return Verdict::came_back;
  follow(offset, now);
  if (!lost_) return Verdict::undecided;
  const double allowed_m = std::hypot(kSamePlace * noise_m, two_sigma_m);
  if (renewed_ == kNever || minus(offset, renewed_at_).m() > allowed_m) {
    renewed_ = now;
    renewed_at_ = offset;
  }
  return now - renewed_ >= kRenewed ? Verdict::renewed : Verdict::undecided;
}

}  // namespace drover::engine::estimate
