#include "engine/estimate/motion_watch.h"

#include <algorithm>
#include <cmath>

#include "drover/angle.h"

namespace drover::engine::estimate {
namespace {

// Wheels that spun so much more than the base moved look the same as a place that drifts along the
// way.
constexpr double kSlipSuspected_m = 0.5;

constexpr Duration kLasting = std::chrono::seconds(24);
constexpr Duration kShortestDrift = std::chrono::seconds(3);
constexpr double kDriftGate = 3.0;  // sigmas: to look costs a few seconds
constexpr double kDrift_m = 0.10;   // so near it is back
constexpr double kBackGate = 2.0;   // sigmas within which it is back
constexpr Duration kBackFor = std::chrono::seconds(10);
constexpr double kStraight = 0.8;  // chord over way
constexpr double kPoorFix = 1.5;   // times the sigma of one that came later
// Soil takes its share of the way, and another one a few metres on: along the way a slow drift
// cannot be told from it.
constexpr double kScaleShare = 0.02;
constexpr double kBentShare = 0.5;
constexpr double kCrab_rad = 0.0025;  // course beside the heading, whatever it comes from

constexpr double kSuspected_m = 0.20;
constexpr double kSlowestSlip_mps = 0.02;
constexpr Duration kStopWithin = std::chrono::seconds(4);  // otherwise nobody looks
// A drift as fast as the suspected one goes twice as far in a look as fixes wander meanwhile.
constexpr double kWandered = 3.0;  // sigmas of a fix
constexpr Duration kShortestLook = std::chrono::seconds(3);
constexpr Duration kLongestLook = std::chrono::seconds(20);
constexpr int kFirstFixes = 5;
constexpr double kBlend = 0.2;                  // of the newest fix into where it stands by now
constexpr double kSameDirection_rad = kPi / 4;  // what a look found holds so far
constexpr double kSidewaysWay_m = 3.0;          // shorter ones show little but noise
constexpr double kSlope_rad = 0.025;            // to a side: the likeliest cause, from here on
constexpr double kMostSlideShare = 1.2;
constexpr double kUsualSlideShare = 0.5;
// How much a look tells of it: of the way before the last metres a part was on another ground.
constexpr double kRecentWeight = 0.9;
constexpr double kOlderWeight = 0.5;
constexpr double kUnexplained_rad = 0.025;
constexpr double kOpposite_rad = 0.01;
constexpr double kBack_rad = 2 * kPi / 3;   // no other way than back
constexpr double kUnknownSlope_rad = 0.03;  // under a field robot

constexpr double kStudyWay_m = 5.0;
constexpr double kDoubtful_m = 0.12;
constexpr double kShortLesson_m = 1.5;
constexpr double kStudyStraight = 0.98;  // chord over way
constexpr double kSlideShare = 0.5;      // wheels slide down a slope by so much of it

/// How far the fix is away from dead reckoning.
struct Apart {
  double east_m = 0;
  double north_m = 0;

  double m() const { return std::hypot(east_m, north_m); }
};

Apart apart(const Leg& leg, const BaseFix& fix) {
  return {.east_m = fix.x_m - leg.x_m - leg.east_m, .north_m = fix.y_m - leg.y_m - leg.north_m};
}

/// A leg that hardly bends.
struct Straight {
  double chord_m = 0;  ///< 0: it bends
  double course_rad = 0;
  double across_m = 0;  ///< the fix, left of it
};

Straight straight(const Leg& leg, const BaseFix& fix, double least_share) {
  const double chord_m = std::hypot(leg.east_m, leg.north_m);
  if (!(chord_m > least_share * leg.way_m) || !(chord_m > 0)) return {};
  const Apart gap = apart(leg, fix);
  return {.chord_m = chord_m,
          .course_rad = std::atan2(leg.north_m, leg.east_m),
          .across_m = (gap.north_m * leg.east_m - gap.east_m * leg.north_m) / chord_m};
}

/// Of a gap between fixes and dead reckoning that nothing is wrong with, m2.
struct Spread {
  double ee = 0;
  double en = 0;
  double nn = 0;
};

Spread expected(const Leg& leg, const Belief& belief, double sigma_m,
                const EstimateConfig& config) {
  const double yaw = belief.covariance[kYaw][kYaw] + square(kCrab_rad);
  const double ee = leg.spread_ee_m;
  const double en = leg.spread_en_m;
  const double nn = leg.spread_nn_m;
  // Of a way there and back soil takes another share on each, but hardly all of it on one.
  const double straight = ee + nn > 0 ? std::hypot(leg.east_m, leg.north_m) / (ee + nn) : 1.0;
  const double soil = kScaleShare * (kBentShare + (1 - kBentShare) * straight);
  const double scale = belief.covariance[kScale][kScale] + square(soil);
  const double rest =
      square(leg.sigma_m) + square(sigma_m) + square(config.turning_shift_m) * leg.turn_rad;
  const double along = square(config.odometry_along_m);
  const double across = square(config.odometry_across_m);
  // The scale acts along the way, the heading across it.
  return {.ee = rest + along * ee + across * nn + scale * (ee * ee + en * en) +
                yaw * (nn * nn + en * en),
          .en = (along - across) * en + (scale - yaw) * en * (ee + nn),
          .nn = rest + along * nn + across * ee + scale * (nn * nn + en * en) +
                yaw * (ee * ee + en * en)};
}

/// In sigmas, squared.
double in_sigmas2(const Apart& apart, const Spread& spread) {
  const double determinant = spread.ee * spread.nn - square(spread.en);
  return (spread.nn * square(apart.east_m) - 2 * spread.en * apart.east_m * apart.north_m +
          spread.ee * square(apart.north_m)) /
         determinant;
}

/// What the look showed, and what is usual before any did.
double slide_share(double before, const Look& look) {
  const double seen = before - look.across_m / look.fall_m;
  const double usual = before > 0 ? before : kUsualSlideShare;
  const double weight = look.recent ? kRecentWeight : kOlderWeight;
  return std::clamp(usual + weight * (seen - usual), 0.0, kMostSlideShare);
}

/// It was no drift, so it was the ground or the mounting: by the youngest leg that shows it. Where
/// it stands on a slope it was that one; `slope_rad` is NaN when nobody knows.
Sideways sideways_of(const MotionWatch& watch, double slope_rad) {
  Sideways sideways = watch.sideways;
  const Look& look = watch.look;
  if (!(look.chord_m > 0)) return sideways;
  const double more_rad = look.across_m / look.chord_m;
  if (std::abs(slope_rad) > kSlope_rad) {
    if (look.fall_m * slope_rad > 0) sideways.slide_share = slide_share(sideways.slide_share, look);
    return sideways;
  }
  // Just off a slope it was the slope, or how that was felt: nothing for this ground.
  if (std::abs(look.fall_m) > kSlope_rad * look.chord_m) return sideways;
  sideways.crab_rad = watch.crab_rad(look.course_rad, kAbsent) + more_rad;
  sideways.course_rad = look.course_rad;
  sideways.any_direction = std::abs(slope_rad) <= kSlope_rad;
  return sideways;
}

/// A base on level ground whose antenna line is known, or that went aside to the other hand of it
/// on the way back: nothing of the robot does that, and a place may well drift only while it moves.
bool unexplained(const MotionWatch& watch, const Mounting& mounting, double slope_rad,
                 const EstimateConfig& config) {
  const Look& look = watch.look;
  const bool level =
      std::abs(slope_rad) <= kSlope_rad && std::abs(look.fall_m) <= kSlope_rad * look.chord_m;
  if (!level || !(look.chord_m > 0)) return false;
  const double seen_rad = look.across_m / look.chord_m;
  const double crab_rad = watch.crab_rad(look.course_rad, kAbsent) + seen_rad;
  if (mounting.proved(config))
    return std::abs(crab_rad) > kUnexplained_rad + 3 * mounting.sigma_rad(config);
  const Sideways& before = watch.sideways;
  const bool back = std::abs(wrap_rad(look.course_rad - before.course_rad)) > kBack_rad;
  return before.any_direction && back && before.crab_rad * crab_rad < 0 &&
         std::min(std::abs(before.crab_rad), std::abs(crab_rad)) > kOpposite_rad;
}

/// Without way when it was too short or no straight one.
StraightLeg lesson_of(const Leg& leg, const Belief& belief, const BaseFix& fix,
                      const EstimateConfig& config) {
  const Straight gap = straight(leg, fix, kStudyStraight);
  if (leg.way_m < kShortLesson_m || gap.chord_m == 0) return {};
  const double slid_m =
      kSlideShare * (std::isfinite(leg.fall_m) ? leg.fall_m : kUnknownSlope_rad * leg.way_m);
  const Spread spread = expected(leg, belief, fix.sigma_m, config);
  const double c = leg.east_m / gap.chord_m;
  const double s = leg.north_m / gap.chord_m;
  const double across_m2 = spread.ee * s * s - 2 * spread.en * s * c + spread.nn * c * c;
  return {.way_m = leg.way_m,
          .course_rad = gap.course_rad,
          .across_m = gap.across_m,
          .variance_m2 = across_m2 + square(slid_m)};
}

void suspect(MotionWatch& watch, const StraightLeg& lesson, const BaseFix& fix, Time now) {
  const Leg& older = watch.lasting[0];
  const Apart gap = apart(older, fix);
  const double rate_mps = gap.m() / to_s(now - older.since);
  watch.look = {.since = now,
                .east = gap.east_m / gap.m(),
                .north = gap.north_m / gap.m(),
                .rate_mps = rate_mps,
                .lesson = lesson,
                .moving = now};
  watch.study = {};
  const Leg& recent = watch.recent[0];
  watch.look.recent = recent.way_m >= kSidewaysWay_m && recent.since > older.since;
  const Leg& leg = watch.look.recent ? recent : older;
  const Straight found = straight(leg, fix, kStraight);
  watch.look.across_m = found.across_m;
  watch.look.chord_m = found.chord_m;
  watch.look.course_rad = found.course_rad;
  watch.look.fall_m = leg.fall_m;
}

/// Whoever slips goes less far than his wheels, on and on; or the place drifts along the way.
void suspect_slip(MotionWatch& watch, Time now) {
  const Leg& leg = watch.brief;
  const double wheels_m = std::hypot(leg.east_m, leg.north_m);
  const double ahead = watch.receiver_mps > watch.wheel_mps ? 1 : -1;
  if (!(wheels_m > 0)) return;
  const double rate_mps = std::max(watch.slip_mps(), kSlowestSlip_mps);
  watch.look = {.since = now,
                .along = true,
                .east = ahead * leg.east_m / wheels_m,
                .north = ahead * leg.north_m / wheels_m,
                .rate_mps = rate_mps,
                .lesson = {},
                .moving = now};
  watch.study = {};
}

/// Nothing that stands is taken aside by its mounting, by the ground or by its wheels.
void look_on(MotionWatch& watch, Mounting& mounting, const BaseFix& fix, Time now,
             const Ground& ground, const EstimateConfig& config) {
  Look& look = watch.look;
  if (!ground.stands) {
    if (look.moving == kNever) look.moving = now;
    look.resting = kNever;
    watch.drifted = !look.along && now - look.moving > kStopWithin;
    if (watch.drifted) look = {};
    return;
  }
  look.moving = kNever;
  const double at_m = fix.x_m * look.east + fix.y_m * look.north;
  if (look.resting == kNever) {
    look.resting = now;
    look.fixes = 0;
    look.first_m = 0;
  }
  look.sigma_m +=
      look.fixes == 0 ? fix.sigma_m - look.sigma_m : kBlend * (fix.sigma_m - look.sigma_m);
  if (++look.fixes <= kFirstFixes) {
    look.first_m += (at_m - look.first_m) / look.fixes;
    look.by_now_m = look.first_m;
    return;
  }
  look.by_now_m += kBlend * (at_m - look.by_now_m);
  const Duration looked = now - look.resting;
  if (looked < kShortestLook) return;
  const Duration takes =
      std::clamp(from_s(2 * kWandered * look.sigma_m / look.rate_mps), kShortestLook, kLongestLook);
  if (look.by_now_m - look.first_m > kWandered * look.sigma_m ||
      (looked >= takes && unexplained(watch, mounting, ground.slope_rad, config))) {
    watch.drifted = true;
    look = {};
  } else if (looked >= takes) {
    watch.sideways = sideways_of(watch, ground.slope_rad);
    if (look.lesson.way_m > 0) learn(mounting, look.lesson, config);
    watch.lasting = {};
    // No drift, but perhaps a jump that nobody saw, which stays.
    if (!look.along) watch.stayed_m = std::max(watch.stayed_m, watch.gap_m);
    watch.gap_m = watch.unseen_slip_m = 0;
    look = {};
  }
}

/// What is beside the heading now shows in the last metres: before, it may have been another
/// ground, or the tilt was not known yet.
void follow_recent(MotionWatch& watch, const BaseFix& fix, Time now) {
  auto& [older, younger] = watch.recent;
  if (older.since == kNever) older = begin_leg(fix, now);
  if (older.way_m >= kSidewaysWay_m && younger.since == kNever) younger = begin_leg(fix, now);
  if (younger.way_m < kSidewaysWay_m) return;
  older = younger;
  younger = begin_leg(fix, now);
}

void study(MotionWatch& watch, Mounting& mounting, const Belief& belief, const BaseFix& fix,
           Time now, const EstimateConfig& config) {
  Leg& leg = watch.study;
  if (watch.slipping()) leg = {};
  if (leg.since == kNever) leg = begin_leg(fix, now);
  // What may turn out to be a drift teaches nothing before it was looked at.
  if (leg.way_m < kStudyWay_m || watch.gap_m > kDoubtful_m) return;
  const StraightLeg lesson = lesson_of(leg, belief, fix, config);
  if (lesson.way_m > 0) learn(mounting, lesson, config);
  leg = begin_leg(fix, now);
}

}  // namespace

double MotionWatch::crab_rad(double yaw_rad, double slope_rad) const {
  const bool holds = sideways.any_direction ||
                     std::abs(wrap_rad(yaw_rad - sideways.course_rad)) < kSameDirection_rad;
  const double slid_rad = std::isfinite(slope_rad) ? sideways.slide_share * slope_rad : 0.0;
  return (holds ? sideways.crab_rad : 0.0) - slid_rad;
}

void Leg::advance(const Step& step) {
  east_m += step.east_m;
  north_m += step.north_m;
  way_m += step.way_m;
  turn_rad += step.turn_rad;
  fall_m += step.slope_rad * step.way_m;
  const double long_m = std::hypot(step.east_m, step.north_m);
  if (!(long_m > 0)) return;
  spread_ee_m += square(step.east_m) / long_m;
  spread_en_m += step.east_m * step.north_m / long_m;
  spread_nn_m += square(step.north_m) / long_m;
}

void MotionWatch::advance(Step step, double crab_rad) {
  study.advance(step);
  const double east_m = step.east_m;
  step.east_m -= crab_rad * step.north_m;
  step.north_m += crab_rad * east_m;
  brief.advance(step);
  for (Leg& leg : lasting) leg.advance(step);
  for (Leg& leg : recent) leg.advance(step);
}

void Leg::turn(double rad) {
  const double east = east_m;
  east_m -= rad * north_m;
  north_m += rad * east;
}

/// What a look found beside the heading was this, as far as it goes.
void MotionWatch::turn_heading(double yaw_rad, double by_rad) {
  study.turn(by_rad);
  const bool found = crab_rad(yaw_rad, kAbsent) != 0;
  if (sideways.crab_rad != 0) sideways.crab_rad -= by_rad;
  if (found) return;
  brief.turn(by_rad);
  for (Leg& leg : lasting) leg.turn(by_rad);
  for (Leg& leg : recent) leg.turn(by_rad);
}

void MotionWatch::pause() {
  const MotionWatch old = *this;
  forget();
  sideways = old.sideways;
  gap_m = old.gap_m;
  stayed_m = old.stayed_m;
  if (!old.drifted && !old.looks()) return;
  drifted = old.drifted;
  drift_m = old.drift_m;
  lasting[0] = old.lasting[0];
  look = old.look;
}

/// The ways go on: what comes back is compared with where it was, however often it goes.
void MotionWatch::lose_fix() {
  brief = study = {};
  stuck_since = kNever;
  look.resting = kNever;
}

void MotionWatch::lose() {
  pause();
  lasting = {};
  look = {};
}

void watch_drift(MotionWatch& watch, Mounting& mounting, const Belief& belief, const BaseFix& fix,
                 Time now, const Ground& ground, const EstimateConfig& config) {
  Leg& older = watch.lasting[0];
  Leg& younger = watch.lasting[1];
  if (watch.lost_track()) return;
  // A leg that began with a fix that had not settled yet would tell of that.
  const bool poor = older.sigma_m > kPoorFix * fix.sigma_m && !watch.drifted && !watch.looks();
  if (older.since == kNever || poor) {
    older = begin_leg(fix, now);
    younger = watch.study = {};
    watch.recent = {older, {}};
    watch.gap_m = 0;
    return;
  }
  const Apart gap = apart(older, fix);
  const double sigmas2 = in_sigmas2(gap, expected(older, belief, fix.sigma_m, config));
  watch.gap_m = gap.m();
  if (watch.drifted) {
    watch.drift_m = watch.gap_m;
    const bool back = ground.stands && (watch.drift_m <= kDrift_m || sigmas2 <= square(kBackGate));
    if (!back) watch.back_since = kNever;
    if (back && watch.back_since == kNever) watch.back_since = now;
    if (back && now - watch.back_since >= kBackFor) watch.forget();
    return;
  }
  if (watch.looks()) {
    look_on(watch, mounting, fix, now, ground, config);
    if (watch.drifted) watch.drift_m = gap.m();
    return;
  }
  if (watch.slipping() && watch.unseen_slip_m > kSlipSuspected_m) {
    suspect_slip(watch, now);
    return;
  }
  const bool drifts = now - older.since >= kShortestDrift && watch.gap_m >= kSuspected_m &&
                      !watch.slipping() && sigmas2 > square(kDriftGate);
  if (!drifts) watch.drift_since = kNever;
  if (drifts && watch.drift_since == kNever) watch.drift_since = now;
  study(watch, mounting, belief, fix, now, config);
  follow_recent(watch, fix, now);
  if (drifts) {
    if (now - watch.drift_since < from_s(config.jump_time_s)) return;
    watch.drift_since = kNever;
    suspect(watch, lesson_of(watch.study, belief, fix, config), fix, now);
    return;
  }
  if (now - older.since > kLasting && younger.since != kNever) {
    older = younger;
    younger = begin_leg(fix, now);
  } else if (younger.since == kNever && now - older.since > kLasting / 2) {
    younger = begin_leg(fix, now);
  }
}

}  // namespace drover::engine::estimate
