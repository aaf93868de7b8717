#include "drivers/ld06/watch.h"

#include <algorithm>
#include <cmath>

#include "drivers/ld06/codec.h"

namespace drover::ld06 {
namespace {

// Weights of one turn in a running mean: over three turns, ten, two minutes, ten minutes. What is
// better is believed soon, what is worse is first of all told.
constexpr double kThreeTurns = 1.0 / 3;
constexpr double kTenTurns = 1.0 / 10;
constexpr double kMinutes = 1.0 / 1200;
constexpr double kTenMinutes = 1.0 / 6000;

void follow(double& mean, double value, double weight) {
  mean += weight * (value - mean);
}

}  // namespace

Watch::Watch(const Settings& settings)
    : sectors_(settings.sectors), least_share_(settings.least_share) {
  reset();
}

void Watch::reset() {
  learned_.clear();
  learned_.resize(sectors_);
  last_.clear();
  same_ = 0;
  first_ = true;
  blind_ = judged_ = 0;
  condition_ = Condition::well;
}

/// Beam by beam, by their bearings: packets are lost on the way, and a motor turns on while what it
/// tells stands still.
bool Watch::is_same(const Scan& raw) const {
  const double near_rad = kPi * std::max(raw.turn_Hz, 1.0) / kPoints_Hz;  // half a beam's distance
  int compared = 0;
  int same = 0;
  std::size_t k = 0;
  for (const ScanPoint& point : raw.points) {
    const auto off_rad = [&](std::size_t i) {
      return std::abs(wrap_rad(last_[i].bearing_rad - point.bearing_rad));
    };
    while (k + 1 < last_.size() && off_rad(k + 1) <= off_rad(k)) ++k;
    if (point.range_m <= 0 || k >= last_.size() || off_rad(k) > near_rad) continue;
    ++compared;
    if (point.range_m == last_[k].range_m && point.intensity == last_[k].intensity) ++same;
  }
  return compared >= kLeastReturns && same >= kSameShare * compared;
}

void Watch::compare(const Scan& raw) {
  same_ = is_same(raw) ? same_ + 1 : 0;
  last_ = raw.points;
}

void Watch::judge(const TurnCounts& counts, Scan& turn) {
  turn_Hz_ = turn.turn_Hz;
  points_ = counts.beams;
  points_due_ = static_cast<int>(std::lround(kPoints_Hz / std::max(turn_Hz_, 1.0)));
  judge_sectors(counts, turn);
  condition_ = whole_turn(counts);
  judge_dirt(counts);
  if (!sees(condition_))
    for (SectorState& sector : turn.sectors) sector = SectorState::unknown;
  first_ = false;
}

Condition Watch::whole_turn(const TurnCounts& counts) const {
  if (std::abs(turn_Hz_ - kTurn_Hz) > kTurnTolerance * kTurn_Hz) return Condition::turn_rate;
  if (counts.returns <= kDarkShare * counts.beams) return Condition::dark;
  if (counts.ring >= kRingShare * counts.beams) return Condition::ring;
  if (counts.own + counts.lens >= kOwnOnlyShare * counts.beams) return Condition::own_only;
  if (same_ >= kFrozenTurns) return Condition::frozen;
  if (blind_ * 2 > judged_) return Condition::blind;
  return blind_ > 0 ? Condition::partly_blind : Condition::well;
}

/// In this turn and in the one before.
bool Watch::has_gap(const SectorCount& count, Sector& sector) const {
  const bool before = sector.gap || first_;
  sector.gap = count.gap_rad * least_share_ > kGap_rad;
  return sector.gap && before;
}

// A beam that never came, because its packet was lost, counts as one that did not come back.
void Watch::judge_sectors(const TurnCounts& counts, Scan& turn) {
  const double due = static_cast<double>(points_due_) / static_cast<double>(sectors_);
  blind_ = judged_ = 0;
  turn.sectors.clear();
  turn.sectors.resize(sectors_);
  for (std::size_t i = 0; i < sectors_; ++i) {
    Sector& sector = learned_[i];
    const double share = std::min(1.0, counts.sectors[i].seen / due);
    if (first_) sector.share = sector.learned = share;
    follow(sector.share, share, kThreeTurns);
    const bool better = sector.share > sector.learned;
    follow(sector.learned, sector.share, better ? kTenTurns : kMinutes);
    const double needed = std::max(least_share_, kBlindShare * sector.learned);
    const bool flickers = !sector.seen && !first_;
    // What needs all of its beams is back with all of them.
    sector.seen = sector.share >= std::min(1 - kBackShare, needed) + (flickers ? kBackShare : 0);
    const bool enough = sector.seen && share >= std::min(kOneTurnShare, least_share_);
    const bool gap = has_gap(counts.sectors[i], sector);
    const bool seen = enough && !gap;
    if (seen) turn.sectors[i] = SectorState::seen_free;
    if (counts.sectors[i].own >= kOwnShare * due) continue;
    if (enough && gap && counts.sectors[i].gap_is_own) continue;
    ++judged_;
    if (seen) continue;
    if (blind_++ == 0)
      blind_bearing_rad_ =
          ((static_cast<double>(i) + 0.5) / static_cast<double>(sectors_) - 0.5) * 2 * kPi;
  }
}

// Dirt that is there when the scanner begins is taken for a part of the robot.
void Watch::judge_dirt(const TurnCounts& counts) {
  const double share = static_cast<double>(counts.own + counts.lens) / std::max(counts.beams, 1);
  if (first_) own_share_ = usual_own_share_ = share;
  follow(own_share_, share, kThreeTurns);
  const bool less = own_share_ < usual_own_share_;
  follow(usual_own_share_, own_share_, less ? kTenTurns : kTenMinutes);
  if (sees(condition_) && own_share_ > usual_own_share_ + kDirtShare) condition_ = Condition::dirty;
}

}  // namespace drover::ld06
