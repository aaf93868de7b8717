#include "engine/estimate/model_gnss.h"

#include <algorithm>
#include <cmath>

#include "drover/angle.h"
#include "engine/estimate/antenna_learning.h"
#include "engine/estimate/antenna_tilt.h"
#include "engine/estimate/fix_jumps.h"

namespace drover::engine::estimate {
namespace {

// The share of the fixed sigma under which a position is never claimed to be known: a fix that
// comes and goes has the same multipath error each time, so averaging its spells proves nothing.
constexpr double kFloorShare = 0.8;
// From one fix to the next, settled ones, so much of what the base moves otherwise than its wheels
// is left at the most: before long that is seen as slip.
constexpr double kLagsBehind = 0.5;
// A fix that was found again is where dead reckoning is.
constexpr double kNearGate = 3.0;  // sigmas
constexpr double kGoesBeside = 0.25;
// Positions of a receiver that tells any are not farther apart.
constexpr Duration kNextFix = std::chrono::milliseconds(1200);
// The wheel scale changes by no more than this share in a metre: what changes it faster is slip.
constexpr double kScalePerMetre = 0.002;

/// Filters in the receiver let the error of the worse quality fade after the better one is shown:
/// until then the position is taken for as bad as that.
AntennaPosition settled(AntennaPosition position, const State& state,
                        const EstimateConfig& config) {
  const GnssTrack& gnss = state.gnss;
  if (gnss.improved == kNever || !(config.fix_settle_s > 0)) return position;
  const double age = to_s(state.time - gnss.improved) / config.fix_settle_s;
  const double left_m = age < 20 ? gnss.old_sigma_m * std::exp(-age) : 0.0;
  position.sigma_x_m = std::hypot(position.sigma_x_m, left_m);
  position.sigma_y_m = std::hypot(position.sigma_y_m, left_m);
  return position;
}

/// The error has a size and, relative to it, a value that wanders: a new size scales it.
void scale_bias(Belief& belief, std::size_t i, double factor) {
  belief.mean[i] *= factor;
  for (std::size_t k = 0; k < kStates; ++k) belief.covariance[i][k] *= factor;
  for (std::size_t k = 0; k < kStates; ++k) belief.covariance[k][i] *= factor;
}

/// Follows the size of the error; another class has another error, of which nothing is known.
/// Returns the position with the sigma to be used.
AntennaPosition follow_quality(State& state, const AntennaPosition& position,
                               const EstimateConfig& config) {
  GnssTrack& gnss = state.gnss;
  const bool changed = position.quality != gnss.quality;
  if (changed && gnss.quality != GnssClass::none) {
    const double before_m = std::max(gnss.sigma_x_m, gnss.sigma_y_m);
    if (before_m > larger_sigma_m(position)) {
      gnss.improved = state.time;
      gnss.old_sigma_m = before_m;
    }
  }
  const AntennaPosition used = settled(position, state, config);
  if (changed) {
    gnss.quality = used.quality;
    state.belief.reset(kBiasX, 0, used.sigma_x_m);
    state.belief.reset(kBiasY, 0, used.sigma_y_m);
  } else {
    scale_bias(state.belief, kBiasX, used.sigma_x_m / gnss.sigma_x_m);
    scale_bias(state.belief, kBiasY, used.sigma_y_m / gnss.sigma_y_m);
  }
  gnss.told_sigma = used.told_sigma;
  gnss.sigma_x_m = used.sigma_x_m;
  gnss.sigma_y_m = used.sigma_y_m;
  return used;
}

/// Believed or not: from then on it is decided what it is worth.
void note_found(State& state, const AntennaPosition& position) {
  GnssTrack& gnss = state.gnss;
  if (position.quality != GnssClass::fixed) return;
  const bool lost = gnss.quality != GnssClass::fixed || state.time - gnss.heard > kFixGone;
  if (lost) gnss.found = state.time;
  gnss.heard = state.time;
}

/// Another receiver has errors of its own, and an antenna. Where the base is stays as it was: what
/// the new one says must fit to that, as anything that it says later.
void hand_over(State& state, std::uint8_t receiver, const EstimateConfig& config) {
  GnssTrack& gnss = state.gnss;
  gnss.receiver = receiver;
  gnss.quality = GnssClass::none;
  gnss.improved = kNever;
  gnss.jumps = {};
  gnss.dispute = {};
  if (state.has_position) {
    gnss.unconfirmed_m = 0;
    gnss.unbelieved = {};
    gnss.unbelieved_m = 0;
  }
  forget_fit(state, config);
  state.watch.forget();
  state.course = {};
}

/// In the map, from base_link.
struct TurnedArm {
  double x_m = 0;
  double y_m = 0;
};

void place(State& state, const AntennaPosition& position, double arm_x_m, double arm_y_m,
           double extra_variance) {
  const double sigma_x = std::sqrt(square(position.sigma_x_m) + extra_variance);
  const double sigma_y = std::sqrt(square(position.sigma_y_m) + extra_variance);
  state.belief.reset(kX, position.x_m - arm_x_m, sigma_x);
  state.belief.reset(kY, position.y_m - arm_y_m, sigma_y);
  state.belief.reset(kBiasX, 0, position.sigma_x_m);
  state.belief.reset(kBiasY, 0, position.sigma_y_m);
  // The place is wrong by just as much as the position it was taken from.
  Matrix& p = state.belief.covariance;
  p[kX][kBiasX] = p[kBiasX][kX] = -square(position.sigma_x_m);
  p[kY][kBiasY] = p[kBiasY][kY] = -square(position.sigma_y_m);
  state.has_position = true;
  state.reckoned = {};
  state.unseen = {};
  state.way_unknown = false;
  if (position.quality == GnssClass::fixed) state.gnss.fixed = state.time;
}

/// Where the base was believed to be was wrong.
void place_anew(State& state, const AntennaPosition& position, const TurnedArm& arm,
                double extra_variance) {
  place(state, position, arm.x_m, arm.y_m, extra_variance);
  state.gnss.jumps.accepted();
  state.watch.pause();
}

/// A base with one antenna finds its heading while it drives.
void find_heading(State& state, const AntennaPosition& position, const LeverArm& arm,
                  const EstimateConfig& config) {
  const bool may = !state.has_heading && position.quality == GnssClass::fixed;
  if (!may) {
    state.course = {};
    return;
  }
  const auto found = heading_of_course(state.course, position.x_m, position.y_m,
                                       larger_sigma_m(position), arm, state.time, config);
  if (!found) return;
  state.belief.reset(kYaw, found->yaw_rad, found->sigma_rad);
  state.has_heading = true;
  state.has_position = false;  // found again with the arm turned the right way
  state.course = {};
}

/// Remembers a refused position. True when it is to be believed after all: the base has stood
/// since before the new place appeared, and the place has repeated for long enough.
bool refuse(State& state, const AntennaPosition& position, const Dispute::Offset& beside,
            double noise_m, bool fixed, const EstimateConfig& config) {
  GnssTrack& gnss = state.gnss;
  const bool standing = state.standing_since != kNever;
  const bool same_place =
      standing && std::hypot(position.x_m - gnss.place_x_m, position.y_m - gnss.place_y_m) <
                      config.gate_sigma * noise_m;
  gnss.jumps.refused(state.time, same_place, !standing && !state.way_unknown);
  gnss.contradiction_m = beside.m();
  ++state.refused;
  if (gnss.jumps.new_place()) {
    gnss.place_x_m = position.x_m;
    gnss.place_y_m = position.y_m;
  }
  const Duration patience = from_s(config.jump_time_s);
  if (fixed && gnss.jumps.began_moving() && gnss.jumps.disagrees(patience)) {
    gnss.dispute.begin(beside, gnss.jumps.since(), slipped_meanwhile(state, beside, config),
                       state.time);
    state.fit.pause();
  }
  return standing && gnss.jumps.settled(patience);
}

Ground ground_of(const State& state, const EstimateConfig& config) {
  Ground ground;
  ground.stands = state.standing_since != kNever;
  // Roll is positive with the left side up.
  if (state.gyro.fresh(state.time, from_s(config.imu_stale_s)))
    ground.slope_rad = state.gyro.roll_rad;
  return ground;
}

/// For those who watch ways: what only seems to move because the antenna is elsewhere is no drift.
BaseFix base_fix(const State& state, const AntennaPosition& position, const TurnedArm& arm) {
  const bool elsewhere = state.fit.arm_wrong();
  const double ahead_m = elsewhere ? state.fit.ahead_m() : 0;
  const double left_m = elsewhere ? state.fit.left_m() : 0;
  const double c = std::cos(state.belief.mean[kYaw]);
  const double s = std::sin(state.belief.mean[kYaw]);
  return {.x_m = position.x_m - arm.x_m - ahead_m * c + left_m * s,
          .y_m = position.y_m - arm.y_m - ahead_m * s - left_m * c,
          .sigma_m = larger_sigma_m(position)};
}

/// By how much dead reckoning may be off is seen by a position as well as that is known itself.
/// Fixes tell more together; the error of a poor position stays.
void rest_on(State& state, const AntennaPosition& position, const EstimateConfig& config) {
  Reckoned& way = state.reckoned;
  const double seen_m = larger_sigma_m(position);
  const double off_m = state.mount_sigma_rad(config) * std::hypot(way.east_m, way.north_m);
  if (!(off_m > 0)) return;
  const bool fixed = position.quality == GnssClass::fixed;
  const double left = fixed ? 1 / std::hypot(1.0, off_m / seen_m) : std::min(seen_m / off_m, 1.0);
  way.east_m *= left;
  way.north_m *= left;
}

/// Whichever of two places is right: positions that keep their distance to dead reckoning tell how
/// that goes on, and where it is it is known as well as when they began to.
void go_beside(State& state, const EstimateConfig& config) {
  GnssTrack& gnss = state.gnss;
  Belief& belief = state.belief;
  const bool leads = gnss.dispute.may_lead(belief.mean[kYaw], config.unseen_slip_share);
  if (!gnss.dispute.steady() || !leads) {
    gnss.disputed_xx_m2 = belief.covariance[kX][kX];
    gnss.disputed_yy_m2 = belief.covariance[kY][kY];
    gnss.disputed_unseen = state.unseen;
    gnss.disputed_reckoned = state.reckoned;
    return;
  }
  const Dispute::Offset astray = gnss.dispute.astray();
  const Dispute::Offset by{kGoesBeside * astray.east_m, kGoesBeside * astray.north_m};
  belief.mean[kX] += by.east_m;
  belief.mean[kY] += by.north_m;
  gnss.dispute.put_right(by);
  belief.limit_variance(kX, gnss.disputed_xx_m2 + square(gnss.sigma_x_m));
  belief.limit_variance(kY, gnss.disputed_yy_m2 + square(gnss.sigma_y_m));
  state.unseen.keep_since(gnss.disputed_unseen, 1 - kGoesBeside);
  state.reckoned = gnss.disputed_reckoned;
}

/// How much of an error of the place is left when it is corrected by this.
double left_after(const Belief& belief, const Vector& row, std::size_t axis, double variance_m2) {
  Vector place{};
  place[axis] = 1;
  const double share = belief.project(place, row) / (belief.project(row, row) + variance_m2);
  return 1 - std::clamp(share, 0.0, 1.0);
}

/// There were fixes until the place began to be another one.
bool goes_on_coming(const State& state) {
  const GnssTrack& gnss = state.gnss;
  if (gnss.believed == kNever) return false;
  const Time other = gnss.jumps.running() ? gnss.jumps.since() : state.time;
  return other - gnss.believed <= kNextFix;
}

/// A fix that is believed, so far beside where the base was when its wheels fell silent: somebody
/// pushed it there, or the receiver is elsewhere. From one fix to the next nobody pushes it far;
/// what was lost meanwhile is like any place that a base at rest is found at.
void doubt_way(State& state, double beside_m) {
  GnssTrack& gnss = state.gnss;
  if (gnss.believed == kNever || beside_m < kSameFix_m) return;
  if (goes_on_coming(state)) {
    gnss.unconfirmed_m = std::max(gnss.unconfirmed_m, beside_m);
  } else {
    gnss.replaced = state.time;
    gnss.replaced_m = beside_m;
  }
}

/// Of what lies between a position and what is expected of it, m2.
struct Expected {
  double xx = 0;
  double xy = 0;
  double yy = 0;
};

/// The gate. How the antenna line is mounted is no state: what that may bend the way since the last
/// fix, or a guessed tilt moved the place by, comes on top.
bool passes(const State& state, Expected expected, double dx_m, double dy_m, double sigmas,
            const EstimateConfig& config) {
  const double mount_rad = state.mount_sigma_rad(config);
  const double bent_x_m = -mount_rad * state.reckoned.north_m;
  const double bent_y_m = mount_rad * state.reckoned.east_m;
  expected.xx += square(bent_x_m);
  expected.xy += bent_x_m * bent_y_m;
  expected.yy += square(bent_y_m);
  expected.xx += square(state.gnss.guessed_m);
  expected.yy += square(state.gnss.guessed_m);
  const double determinant = expected.xx * expected.yy - square(expected.xy);
  const double distance2 =
      (expected.yy * dx_m * dx_m - 2 * expected.xy * dx_m * dy_m + expected.xx * dy_m * dy_m) /
      determinant;
  return distance2 <= square(sigmas);
}

}  // namespace

void apply(State& state, const AntennaPosition& measured, const Twist& twist,
           const EstimateConfig& config) {
  const double speed_mps = std::hypot(twist.vx_mps, twist.vy_mps);
  if (measured.receiver != state.gnss.receiver) hand_over(state, measured.receiver, config);
  note_found(state, measured);
  const AntennaPosition position = in_time(state, follow_quality(state, measured, config), twist);
  Belief& belief = state.belief;
  const TiltedArm tilted =
      tilted_arm(state.gyro, belief.mean[kYaw], antenna_of(config, state.gnss.receiver), config);
  find_heading(state, position, tilted.arm, config);
  const double c = std::cos(belief.mean[kYaw]);
  const double s = std::sin(belief.mean[kYaw]);
  const double lever_m = std::hypot(tilted.arm.ahead_m, tilted.arm.left_m);
  // Without heading the antenna is somewhere around base_link.
  const bool oriented = state.has_heading;
  const double arm_x = oriented ? tilted.arm.ahead_m * c - tilted.arm.left_m * s : 0;
  const double arm_y = oriented ? tilted.arm.ahead_m * s + tilted.arm.left_m * c : 0;
  const double sways_m2 = (oriented ? 0 : square(lever_m)) + tilted.variance_m2 +
                          square(speed_mps * config.gnss_timing_sigma_s);
  const double extra = sways_m2 + square(tilted.guessed_m);
  const double variance_x = square(config.gnss_white_share * position.sigma_x_m) + extra;
  const double variance_y = square(config.gnss_white_share * position.sigma_y_m) + extra;
  const double turned_m2 = square(lever_m) * belief.covariance[kYaw][kYaw];
  const double place_variance = variance_x + (oriented ? turned_m2 : 0);
  if (!state.has_position) {
    place(state, position, arm_x, arm_y, place_variance);
    state.gnss.guessed_m = tilted.guessed_m;
    return;
  }
  const bool fixed = position.quality == GnssClass::fixed && oriented;
  const BaseFix fix = base_fix(state, position, {arm_x, arm_y});
  if (!fixed) {
    state.watch.lose_fix();
  } else {
    watch_slip(state.watch, belief, fix, state.time, config);
  }

  Vector row_x{};
  row_x[kX] = row_x[kBiasX] = 1;
  row_x[kYaw] = -arm_y;
  Vector row_y{};
  row_y[kY] = row_y[kBiasY] = 1;
  row_y[kYaw] = arm_x;
  const double dx = position.x_m - (belief.mean[kX] + arm_x + belief.mean[kBiasX]);
  const double dy = position.y_m - (belief.mean[kY] + arm_y + belief.mean[kBiasY]);
  const double sxx = belief.project(row_x, row_x) + variance_x;
  const double syy = belief.project(row_y, row_y) + variance_y;
  const double sxy = belief.project(row_x, row_y);
  const Expected expected{.xx = sxx, .xy = sxy, .yy = syy};
  const bool inside = passes(state, expected, dx, dy, config.gate_sigma, config);
  const bool near = std::hypot(dx, dy) < kSameFix_m ||
                    passes(state, expected, dx, dy, std::min(kNearGate, config.gate_sigma), config);
  if (!fixed) {
    state.gnss.dispute.lose_fix();
  } else {
    switch (judge_jump(state,
                       {.offset = {dx, dy},
                        .inside = inside,
                        .near = near,
                        .sigma_m = fix.sigma_m,
                        .sways_m2 = sways_m2,
                        .speed_mps = speed_mps,
                        .arm = tilted.arm},
                       config)) {
      case FixVerdict::plain: break;
      case FixVerdict::waits: return;
      case FixVerdict::doubted: ++state.refused; return go_beside(state, config);
      case FixVerdict::renewed:
        state.gnss.guessed_m = tilted.guessed_m;
        return place_anew(state, position, {arm_x, arm_y}, place_variance);
    }
  }
  if (!inside) {
    const bool settled = refuse(state, position, {dx, dy}, larger_sigma_m(position), fixed, config);
    // Which of two places is right is no question for a poor position.
    if (!settled || (!fixed && state.gnss.dispute.holds())) return;
    if (fixed && (state.way_unknown ? goes_on_coming(state) : found_again(state)))
      state.gnss.unconfirmed_m = std::hypot(dx, dy);
    if (fixed) state.gnss.believed = kNever;  // the next one is not found again, but the same
    state.gnss.replaced = state.time;
    state.gnss.replaced_m = std::hypot(dx, dy);
    state.gnss.guessed_m = tilted.guessed_m;
    place_anew(state, position, {arm_x, arm_y}, place_variance);
    return;
  }
  if (fixed && state.way_unknown) doubt_way(state, std::hypot(dx, dy));
  state.gnss.jumps.accepted();
  if (fixed) {
    state.gnss.believed = state.time;
    state.way_unknown = false;
    state.gnss.fixed = state.time;
    const bool was_wrong = state.fit.arm_wrong();
    learn_fit(state, measured, {.arm_x_m = arm_x, .arm_y_m = arm_y}, twist, config);
    if (state.fit.arm_wrong() != was_wrong) state.watch.pause();
    watch_drift(state.watch, state.mounting, belief, fix, state.time, ground_of(state, config),
                config);
  }
  const double scale_way_m = fixed ? state.unseen.way_m : state.gnss.corrected_way_m;
  const double scale_most = state.watch.slipping() ? 0.0 : kScalePerMetre * scale_way_m;
  state.gnss.corrected_way_m = 0;
  rest_on(state, position, config);
  const double left_x = left_after(belief, row_x, kX, variance_x);
  const double left_y = left_after(belief, row_y, kY, variance_y);
  const double left = std::max(left_x, left_y);
  // Another tilt than was guessed is another one with the next position, too. Along the way, where
  // wheels may slip, positions are followed sooner than across.
  const auto guessed_m = [&](double share) {
    return share * state.gnss.guessed_m + (1 - share) * tilted.guessed_m;
  };
  state.gnss.guessed_m = std::max(guessed_m(left_x), guessed_m(left_y));
  if (fixed) {
    state.unseen.keep(has_settled(state, config) ? std::min(left, kLagsBehind) : left);
  }
  const double scale_variance = belief.covariance[kScale][kScale];
  const Vector before = belief.mean;
  belief.correct(row_x, dx, variance_x);
  // The first correction has moved the state; what is left starts from there.
  const auto left_y_m = [&] {
    return dy - (belief.mean[kY] - before[kY]) - (belief.mean[kBiasY] - before[kBiasY]) -
           arm_x * wrap_rad(belief.mean[kYaw] - before[kYaw]);
  };
  belief.correct(row_y, left_y_m(), variance_y);
  if (fixed) {
    state.gnss.beside_x_m = dx - (belief.mean[kX] - before[kX]) -
                            (belief.mean[kBiasX] - before[kBiasX]) +
                            arm_y * wrap_rad(belief.mean[kYaw] - before[kYaw]);
    state.gnss.beside_y_m = left_y_m();
    state.gnss.arm = tilted.arm;
    state.gnss.arm_guessed = tilted.guessed_m > 0;
  }
  if (state.watch.slipping()) belief.floor_variance(kScale, scale_variance);
  belief.mean[kScale] =
      std::clamp(belief.mean[kScale], before[kScale] - scale_most, before[kScale] + scale_most);
  const double floor = square(kFloorShare * config.sigma_fixed_m);
  belief.floor_variance(kX, floor);
  belief.floor_variance(kY, floor);
  correct_mounting(state, tilted.arm, config);
  correct_lateness(state, twist);
}

}  // namespace drover::engine::estimate
