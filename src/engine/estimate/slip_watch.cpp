// Wheels that roll more than the base moves, within a second.
#include <algorithm>
#include <cmath>

#include "engine/estimate/motion_watch.h"

namespace drover::engine::estimate {
namespace {

constexpr Duration kBriefest = std::chrono::milliseconds(350);
constexpr Duration kBrief = std::chrono::milliseconds(750);
// Slip is told when the ways differ by more than this and this share of the way; it is over below
// half of it.
constexpr double kSlip_m = 0.03;
constexpr double kSlipShare = 0.1;
constexpr double kStandingSlip_m = 0.05;  // without way of the wheels: the base slides on them
constexpr double kSlipGate = 3.0;         // sigmas of the two positions
constexpr double kJumpShare = 0.6;        // of the gap between two positions: not the wheels' doing
constexpr double kStuckShare = 0.4;       // of the wheels' way
constexpr double kSlipForgiven = 0.05;    // of a way without slip

void begin_brief(MotionWatch& watch, const Belief& belief, const BaseFix& fix, Time now) {
  watch.brief = begin_leg(fix, now);
  watch.scale_before = {belief.mean[kScale], watch.scale_before[0]};
  watch.last_gap_m = watch.last_east_m = watch.last_north_m = watch.largest_step_m = 0;
}

/// One sigma of what lies between two fixes of the same place within a second: of their slow error
/// only what settles after an outage.
double wandered_m(const Leg& leg, const BaseFix& fix, const EstimateConfig& config) {
  const double white_m = config.gnss_white_share * std::hypot(leg.sigma_m, fix.sigma_m);
  return std::hypot(white_m, std::max(leg.sigma_m - fix.sigma_m, 0.0));
}

/// How far the ways of wheels and receiver may differ when nothing slips.
double most_apart_m(const Leg& leg, const BaseFix& fix, double wheels_m,
                    const EstimateConfig& config) {
  if (wheels_m < kSlip_m)
    return std::max(kStandingSlip_m, kSlipGate * std::hypot(leg.sigma_m, fix.sigma_m));
  return std::max(kSlip_m, kSlipGate * wandered_m(leg, fix, config)) + kSlipShare * wheels_m;
}

/// Of what the brief leg tells along its way.
void forgive_along(MotionWatch& watch, double share) {
  if (!std::isfinite(share)) return;
  const auto forgive = [&](Leg& leg) {
    leg.east_m -= share * watch.brief.east_m;
    leg.north_m -= share * watch.brief.north_m;
  };
  for (Leg& leg : watch.lasting) forgive(leg);
  for (Leg& leg : watch.recent) forgive(leg);
}

}  // namespace

double MotionWatch::slip_mps() const {
  return slipping() ? std::abs(wheel_mps - receiver_mps) : 0.0;
}

void watch_slip(MotionWatch& watch, Belief& belief, const BaseFix& fix, Time now,
                const EstimateConfig& config) {
  Leg& leg = watch.brief;
  if (leg.since == kNever || now - leg.since > 2 * kBrief) {
    begin_brief(watch, belief, fix, now);
    watch.stuck_since = kNever;
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
  const double most_m = most_apart_m(leg, fix, wheels_m, config);
  const bool creeping = watch.largest_step_m < kJumpShare * std::abs(gap_m);
  watch.wheel_mps = wheels_m / to_s(age);
  watch.receiver_mps = receiver_m / to_s(age);
  const bool slipped = watch.slipping();
  if (!watch.slipping() && std::abs(gap_m) > most_m && creeping) {
    watch.slip_since = leg.since;
    // What it taught meanwhile was none of the wheels.
    if (watch.scale_before[1] > 0) belief.mean[kScale] = watch.scale_before[1];
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
  const bool stuck = watch.slipping() && watch.receiver_mps < kStuckShare * watch.wheel_mps;
  if (!stuck) watch.stuck_since = kNever;
  if (stuck && watch.stuck_since == kNever) watch.stuck_since = leg.since;
  if (age < kBrief && !(slipped && !watch.slipping())) return;
  // What the wheels spun away is no drift, unless it goes on where they stand; how far the place is
  // aside of the way still counts.
  if (slipped || watch.slipping()) forgive_along(watch, gap_m / wheels_m);
  watch.slipped_m = watch.slipping() ? watch.slipped_m + std::abs(gap_m) : 0;
  watch.unseen_slip_m += watch.slipping() ? std::abs(gap_m) : -kSlipForgiven * wheels_m;
  watch.unseen_slip_m = std::max(watch.unseen_slip_m, 0.0);
  begin_brief(watch, belief, fix, now);
}

}  // namespace drover::engine::estimate
