#include "engine/estimate/motion_watch.h"

#include <algorithm>
#include <cmath>

#include "drover/angle.h"

namespace drover::engine::estimate {
namespace {

constexpr Duration kBriefest = std::chrono::milliseconds(350);
constexpr Duration kBrief = std::chrono::milliseconds(750);
// Slip is told when the ways differ by more than this and this share of the way; it is over below
// half of it.
constexpr double kSlip_m = 0.05;
constexpr double kSlipShare = 0.25;
constexpr double kSlipGate = 3.0;   // sigmas of the two positions
constexpr double kJumpShare = 0.6;  // of the gap between two positions: not the wheels' doing

constexpr Duration kLasting = std::chrono::seconds(24);
constexpr Duration kShortestDrift = std::chrono::seconds(3);
constexpr double kDriftGate = 4.0;  // sigmas
constexpr double kDrift_m = 0.10;   // less is no drift
constexpr double kBackGate = 2.0;   // sigmas within which it is back
constexpr Duration kBackFor = std::chrono::seconds(10);
constexpr double kStraight = 0.8;  // chord over way
// Soil takes its share of the way, and another one a few metres on: along the way a slow drift
// cannot be told from it.
constexpr double kScaleShare = 0.02;
// The antenna line is mounted with an error, which shows as a course beside the heading; it is
// learned over so many metres, and stays the same to this.
constexpr double kCrabWay_m = 3.0;
constexpr double kMostCrabWay_m = 60.0;
constexpr double kCrab_rad = 0.0025;

Leg begin(const BaseFix& fix, Time now) {
  Leg leg;
  leg.since = now;
  leg.x_m = fix.x_m;
  leg.y_m = fix.y_m;
  leg.sigma_m = fix.sigma_m;
  return leg;
}

void begin_brief(MotionWatch& watch, const BaseFix& fix, Time now) {
  watch.brief = begin(fix, now);
  watch.last_gap_m = watch.last_east_m = watch.last_north_m = watch.largest_step_m = 0;
}

/// How far the fix is away from dead reckoning.
struct Apart {
  double along_m = 0;
  double across_m = 0;  ///< left of the way
  bool straight = false;
};

Apart apart(const Leg& leg, const BaseFix& fix) {
  const double east_m = fix.x_m - leg.x_m - leg.east_m;
  const double north_m = fix.y_m - leg.y_m - leg.north_m;
  const double chord_m = std::hypot(leg.east_m, leg.north_m);
  if (!(chord_m > kStraight * leg.way_m) || !(chord_m > 0)) {
    return {.along_m = east_m, .across_m = north_m};
  }
  const double c = leg.east_m / chord_m;
  const double s = leg.north_m / chord_m;
  return {
      .along_m = east_m * c + north_m * s, .across_m = north_m * c - east_m * s, .straight = true};
}

/// In sigmas, squared.
double drift_in_sigmas2(const MotionWatch& watch, const Leg& leg, const Belief& belief,
                        const Apart& apart, double sigma_m, const EstimateConfig& config) {
  const double unlearned = kCrabWay_m / (kCrabWay_m + watch.crab_way_m);
  const double yaw_variance = belief.covariance[kYaw][kYaw] + square(kCrab_rad) +
                              square(to_rad(config.heading_sigma_deg)) * unlearned;
  const double scale_variance = belief.covariance[kScale][kScale] + square(kScaleShare);
  const double rest =
      square(leg.sigma_m) + square(sigma_m) + square(config.turning_shift_m) * leg.turn_rad;
  const double along =
      rest + square(config.odometry_along_m) * leg.way_m + scale_variance * square(leg.way_m);
  const double across =
      rest + square(config.odometry_across_m) * leg.way_m + yaw_variance * square(leg.way_m);
  if (!apart.straight) {  // no direction is along
    return (square(apart.along_m) + square(apart.across_m)) / std::max(along, across);
  }
  const double crab_m = watch.crab_rad * leg.way_m;
  return square(apart.along_m) / along + square(apart.across_m - crab_m) / across;
}

void learn_crab(MotionWatch& watch, const Leg& leg, const Apart& apart) {
  if (!apart.straight || leg.way_m < kCrabWay_m) return;
  watch.crab_rad +=
      leg.way_m / (watch.crab_way_m + leg.way_m) * (apart.across_m / leg.way_m - watch.crab_rad);
  watch.crab_way_m = std::min(watch.crab_way_m + leg.way_m, kMostCrabWay_m);
}

}  // namespace

double MotionWatch::slip_mps() const {
  return slipping() ? std::abs(wheel_mps - receiver_mps) : 0.0;
}

void MotionWatch::advance(double east, double north, double way, double turn) {
  brief.advance(east, north, way, turn);
  for (Leg& leg : lasting) leg.advance(east, north, way, turn);
}

void MotionWatch::forget() {
  const MotionWatch old = *this;
  *this = MotionWatch{};
  crab_rad = old.crab_rad;
  crab_way_m = old.crab_way_m;
}

void MotionWatch::pause() {
  const MotionWatch old = *this;
  forget();
  if (!old.drifted) return;
  drifted = true;
  drift_m = old.drift_m;
  lasting[0] = old.lasting[0];
}

void MotionWatch::lose() {
  pause();
  lasting = {};
}

void watch_slip(MotionWatch& watch, Belief& belief, const BaseFix& fix, Time now) {
  Leg& leg = watch.brief;
  if (leg.since == kNever || now - leg.since > 2 * kBrief) {
    begin_brief(watch, fix, now);
    watch.slip_since = kNever;
    return;
  }
  const double wheels_m = std::hypot(leg.east_m, leg.north_m);
  const double receiver_m = std::hypot(fix.x_m - leg.x_m, fix.y_m - leg.y_m);
  const double gap_m = wheels_m - receiver_m;
  // By its place, not its length: a jump back by more than the way so far looks like little of it.
  const double east_m = fix.x_m - leg.x_m - leg.east_m;
  const double north_m = fix.y_m - leg.y_m - leg.north_m;
  watch.largest_step_m = std::max(
      watch.largest_step_m, std::hypot(east_m - watch.last_east_m, north_m - watch.last_north_m));
  watch.last_east_m = east_m;
  watch.last_north_m = north_m;
  watch.last_gap_m = gap_m;
  const Duration age = now - leg.since;
  if (age < kBriefest) return;
  // Fixes that still settle after an outage wander by more than wheels slip.
  const double noise_m = kSlipGate * std::hypot(leg.sigma_m, fix.sigma_m);
  const double most_m = std::max(kSlip_m, noise_m) + kSlipShare * wheels_m;
  const bool creeping = watch.largest_step_m < kJumpShare * std::abs(gap_m);
  watch.wheel_mps = wheels_m / to_s(age);
  watch.receiver_mps = receiver_m / to_s(age);
  if (!watch.slipping() && std::abs(gap_m) > most_m && creeping) {
    watch.slip_since = leg.since;
    const double c = std::cos(belief.mean[kYaw]);
    const double s = std::sin(belief.mean[kYaw]);
    Matrix& p = belief.covariance;
    p[kX][kX] += square(gap_m * c);
    p[kY][kY] += square(gap_m * s);
    p[kX][kY] += square(gap_m) * c * s;
    p[kY][kX] = p[kX][kY];
  } else if (std::abs(gap_m) < most_m / 2 && age >= kBrief) {
    watch.slip_since = kNever;
  }
  // What the wheels spun away is no drift.
  if (watch.slipping() && !watch.drifted) watch.lasting = {};
  if (age < kBrief) return;
  watch.slipped_m = watch.slipping() ? watch.slipped_m + std::abs(gap_m) : 0;
  begin_brief(watch, fix, now);
}

void watch_drift(MotionWatch& watch, const Belief& belief, const BaseFix& fix, Time now,
                 bool stands, const EstimateConfig& config) {
  Leg& older = watch.lasting[0];
  Leg& younger = watch.lasting[1];
  if (watch.lost_track()) return;
  if (older.since == kNever) {
    older = begin(fix, now);
    return;
  }
  const Apart drift = apart(older, fix);
  const double drift_m = std::hypot(drift.along_m, drift.across_m);
  const double sigmas2 = drift_in_sigmas2(watch, older, belief, drift, fix.sigma_m, config);
  if (watch.drifted) {
    watch.drift_m = drift_m;
    const bool back = stands && (drift_m <= kDrift_m || sigmas2 <= square(kBackGate));
    if (!back) watch.back_since = kNever;
    if (back && watch.back_since == kNever) watch.back_since = now;
    if (back && now - watch.back_since >= kBackFor) watch.forget();
    return;
  }
  const bool drifts = now - older.since >= kShortestDrift && drift_m > kDrift_m &&
                      !watch.slipping() && sigmas2 > square(kDriftGate);
  if (drifts) {
    if (watch.drift_since == kNever) watch.drift_since = now;
    watch.drift_m = drift_m;
    watch.drifted = now - watch.drift_since >= from_s(config.jump_time_s);
    return;
  }
  watch.drift_since = kNever;
  if (now - older.since > kLasting && younger.since != kNever) {
    learn_crab(watch, older, drift);
    older = younger;
    younger = begin(fix, now);
  } else if (younger.since == kNever && now - older.since > kLasting / 2) {
    younger = begin(fix, now);
  }
}

}  // namespace drover::engine::estimate
