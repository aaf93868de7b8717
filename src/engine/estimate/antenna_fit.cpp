#include "engine/estimate/antenna_fit.h"

#include <algorithm>
#include <cmath>

#include "drover/angle.h"
#include "engine/estimate/filter.h"

namespace drover::engine::estimate {
namespace {

constexpr Duration kStretch = std::chrono::milliseconds(1500);
constexpr Duration kTooLong = std::chrono::seconds(3);
// Before anything was learned, one sigma.
constexpr double kArm_m = 0.1;
constexpr double kWheelShare = 0.03;
const double kCrab_deg = 2.5;
// How much ground and tyres change from one stretch to the next, and the clock.
constexpr double kShareWalk = 0.002;
const double kCrabWalk_deg = 0.3;
constexpr double kLateWalk_s = 0.002;
constexpr double kFitGate = 5.0;  // sigmas: it slipped, or jumped
constexpr double kTells = 0.2;    // of the arm: so much of it is seen in a stretch's turn
constexpr int kMostMissed = 5;    // about 7 s of turns
constexpr double kMostLate_s = 0.4;
constexpr double kLateKnown_s = 0.04;
constexpr double kLateLeast_s = 0.03;
// What several changes of speed do not agree on has at least such a sigma, also as a share of it.
constexpr double kUnproved_s = 0.05;
constexpr double kUnprovedShare = 0.3;
constexpr double kChange_mps = 0.15;
constexpr double kHardlyTurns_rad = 0.1;
constexpr Duration kOtherChange = std::chrono::seconds(3);
constexpr double kAgree_s = 0.07;
constexpr std::size_t kMustAgree = 3;
constexpr double kArmKnown_m = 0.03;
constexpr double kArmWrong_m = 0.05;
constexpr double kCertain = 4.0;  // sigmas
constexpr double kLikely = 2.0;
constexpr double kRolled_m = 0.02;

}  // namespace

AntennaFit::AntennaFit(const EstimateConfig& config) {
  covariance_[kAhead][kAhead] = covariance_[kLeft][kLeft] = square(kArm_m);
  covariance_[kLate][kLate] = square(config.gnss_late_sigma_s);
  covariance_[kShare][kShare] = square(kWheelShare);
  covariance_[kCrab][kCrab] = square(to_rad(kCrab_deg));
}

void AntennaFit::advance(double east_m, double north_m, double way_m, double turn_rad) {
  if (from_.time == kNever) return;
  east_m_ += east_m;
  north_m_ += north_m;
  way_m_ += way_m;
  turn_rad_ += turn_rad;
}

void AntennaFit::hear(const AntennaPoint& point, const EstimateConfig& config) {
  const bool known = from_.time != kNever;
  if (known && point.time - from_.time < kStretch) return;
  if (waits_.to.time != kNever) learn(waits_, config);
  waits_ = {};
  if (known && point.time - from_.time < kTooLong && way_m_ > kRolled_m)
    waits_ = {from_, point, east_m_, north_m_, way_m_, turn_rad_};
  from_ = point;
  east_m_ = north_m_ = way_m_ = turn_rad_ = 0;
}

void AntennaFit::learn(const Stretch& stretch, const EstimateConfig& config) {
  const AntennaPoint& from = stretch.from;
  const AntennaPoint& to = stretch.to;
  const double dt_s = to_s(to.time - from.time);
  const double dc = std::cos(to.yaw_rad) - std::cos(from.yaw_rad);
  const double ds = std::sin(to.yaw_rad) - std::sin(from.yaw_rad);
  const Row east{dc, -ds, from.vx_mps - to.vx_mps, stretch.east_m, -stretch.north_m};
  const Row north{ds, dc, from.vy_mps - to.vy_mps, stretch.north_m, stretch.east_m};
  const double east_m = to.x_m - from.x_m - stretch.east_m - (to.arm_x_m - from.arm_x_m);
  const double north_m = to.y_m - from.y_m - stretch.north_m - (to.arm_y_m - from.arm_y_m);
  const double slow = 2 * (1 - std::exp(-dt_s / config.gnss_correlation_s));
  const double variance_m2 = square(to.white_m) + square(from.white_m) + slow * square(to.slow_m) +
                             square(config.odometry_along_m) * stretch.way_m +
                             square(config.turning_shift_m) * stretch.turn_rad;
  covariance_[kShare][kShare] += square(kShareWalk);
  covariance_[kCrab][kCrab] += square(to_rad(kCrabWalk_deg));
  covariance_[kLate][kLate] += square(kLateWalk_s) * (config.gnss_late_sigma_s > 0 ? 1 : 0);
  note_change(stretch);
  least_doubt_s_ = std::min(config.gnss_late_sigma_s,
                            std::max(kUnproved_s, kUnprovedShare * std::abs(mean_[kLate])));
  const auto misses = [&](const Row& row, double measured_m) {
    double expected_m = 0;
    for (std::size_t i = 0; i < kNumbers; ++i) expected_m += row[i] * mean_[i];
    return square(measured_m - expected_m) > square(kFitGate) * (variance_of(row) + variance_m2);
  };
  const bool missed = misses(east, east_m) || misses(north, north_m);
  if (std::hypot(dc, ds) > kTells) turns_missed_ = missed ? turns_missed_ + 1 : 0;
  if (turns_missed_ > kMostMissed) forget_arm();
  if (missed) return;
  correct(east, east_m, variance_m2);
  correct(north, north_m, variance_m2);
  mean_[kLate] = std::clamp(mean_[kLate], -kMostLate_s, kMostLate_s);
}

/// What a change of speed alone tells of the delay, by what else is known. A stretch along which it
/// only turns tells as much of the arm.
void AntennaFit::note_change(const Stretch& stretch) {
  const AntennaPoint& from = stretch.from;
  const AntennaPoint& to = stretch.to;
  const double c = std::cos(to.yaw_rad);
  const double s = std::sin(to.yaw_rad);
  const double slower_mps = (from.vx_mps - to.vx_mps) * c + (from.vy_mps - to.vy_mps) * s;
  const bool straight = stretch.turn_rad < kHardlyTurns_rad;
  if (!straight || std::abs(slower_mps) < kChange_mps) return;
  const double seen_m = (to.x_m - from.x_m - (to.arm_x_m - from.arm_x_m)) * c +
                        (to.y_m - from.y_m - (to.arm_y_m - from.arm_y_m)) * s;
  const double rolled_m = stretch.east_m * c + stretch.north_m * s;
  const double late_s = (seen_m - rolled_m * (1 + mean_[kShare])) / slower_mps;
  Change& last = changes_[(next_change_ + changes_.size() - 1) % changes_.size()];
  // The rest of the same one.
  if (last.at != kNever && to.time - last.at < kOtherChange) return;
  changes_[next_change_] = {to.time, late_s};
  next_change_ = (next_change_ + 1) % changes_.size();
  judge_changes();
  // One of both was none: it is open again.
  if (!proved_ && std::abs(late_s - mean_[kLate]) > kAgree_s)
    covariance_[kLate][kLate] = square(late_doubt_s());
}

/// Most of them agree, with each other and with what was learned.
void AntennaFit::judge_changes() {
  std::size_t heard = 0;
  std::size_t agree = 0;
  double middle_s = 0;
  for (const Change& change : changes_) {
    if (change.at == kNever) continue;
    ++heard;
    std::size_t with = 0;
    for (const Change& other : changes_)
      with += other.at != kNever && std::abs(other.late_s - change.late_s) < kAgree_s ? 1 : 0;
    if (with > agree) middle_s = change.late_s;
    agree = std::max(agree, with);
  }
  proved_ =
      agree >= kMustAgree && 2 * agree > heard && std::abs(middle_s - mean_[kLate]) < kAgree_s;
}

void AntennaFit::recall_late(double late_s, double sigma_s) {
  // What proved it then counts like changes of speed that were seen now.
  for (next_change_ = 0; next_change_ < kMustAgree; ++next_change_)
    changes_[next_change_] = {Time{}, late_s};
  proved_ = true;
  mean_[kLate] = late_s;
  covariance_[kLate][kLate] = square(sigma_s);
}

void AntennaFit::recall_arm(double ahead_m, double left_m, double sigma_m) {
  mean_[kAhead] = ahead_m;
  mean_[kLeft] = left_m;
  covariance_[kAhead][kAhead] = covariance_[kLeft][kLeft] = square(sigma_m);
}

void AntennaFit::forget_arm() {
  turns_missed_ = 0;
  for (const std::size_t i : {std::size_t{kAhead}, std::size_t{kLeft}}) {
    for (std::size_t k = 0; k < kNumbers; ++k) covariance_[i][k] = covariance_[k][i] = 0;
    covariance_[i][i] = square(kArm_m);
    mean_[i] = 0;
  }
}

double AntennaFit::variance_of(const Row& row) const {
  double sum = 0;
  for (std::size_t r = 0; r < kNumbers; ++r)
    for (std::size_t c = 0; c < kNumbers; ++c) sum += row[r] * covariance_[r][c] * row[c];
  return sum;
}

void AntennaFit::correct(const Row& row, double measured_m, double variance_m2) {
  Row spread{};
  for (std::size_t r = 0; r < kNumbers; ++r)
    for (std::size_t c = 0; c < kNumbers; ++c) spread[r] += covariance_[r][c] * row[c];
  double total = variance_m2;
  double innovation_m = measured_m;
  for (std::size_t i = 0; i < kNumbers; ++i) {
    total += row[i] * spread[i];
    innovation_m -= row[i] * mean_[i];
  }
  if (!(total > 0)) return;
  for (std::size_t r = 0; r < kNumbers; ++r) {
    mean_[r] += spread[r] / total * innovation_m;
    for (std::size_t c = 0; c < kNumbers; ++c) covariance_[r][c] -= spread[r] * spread[c] / total;
  }
}

double AntennaFit::late_sigma_s() const {
  return std::sqrt(std::max(covariance_[kLate][kLate], 0.0));
}

double AntennaFit::late_doubt_s() const {
  return proved_ ? late_sigma_s() : std::max(late_sigma_s(), least_doubt_s_);
}

bool AntennaFit::late_known() const {
  return late_doubt_s() <= kLateKnown_s &&
         std::abs(late_s()) > std::max(kCertain * late_sigma_s(), kLateLeast_s);
}

double AntennaFit::arm_sigma_m() const {
  return std::sqrt(std::max({covariance_[kAhead][kAhead], covariance_[kLeft][kLeft], 0.0}));
}

double AntennaFit::arm_doubt_m(double sigmas, const EstimateConfig& config) const {
  const double seen_m = std::hypot(ahead_m(), left_m()) + sigmas * arm_sigma_m();
  return std::min(sigmas * config.antenna_sigma_m, seen_m);
}

bool AntennaFit::arm_right(const EstimateConfig& config) const {
  return arm_doubt_m(kLikely, config) <= kArmWrong_m;
}

bool AntennaFit::arm_wrong() const {
  return arm_sigma_m() <= kArmKnown_m &&
         std::hypot(ahead_m(), left_m()) > std::max(kCertain * arm_sigma_m(), kArmWrong_m);
}

}  // namespace drover::engine::estimate
