// The first gate: the only way a wanted motion becomes a commanded one.
#include "engine/gate/target_gate.h"

#include <algorithm>
#include <cmath>

#include "engine/gate/approach.h"

namespace drover::engine {
namespace {

/// How far a base may be turned beside its curve while its wheels are still on their way there.
constexpr double kAstray_rad = 0.05;

}  // namespace

std::string_view text(TargetRefusal refusal) {
  switch (refusal) {
    case TargetRefusal::none: return "";
    case TargetRefusal::nobody: return "nobody drives";
    case TargetRefusal::stop: return "a stop is in force";
    case TargetRefusal::stale: return "the wanted speed is too old";
    case TargetRefusal::not_finite: return "the wanted speed is not a number";
  }
  return "";
}

TargetGate::TargetGate(const LimitsConfig& limits, Duration max_age, const BodyLimits& body)
    : limits_(limits), max_age_(max_age), body_(body) {}

void TargetGate::reset() {
  twist_ = {};
  acceleration_mps2_ = aside_mps2_ = 0;
}

Twist TargetGate::choose(Time now, std::span<const Offer> offers) {
  const Offer* best = nullptr;
  for (const Offer& offer : offers) {
    if (best == nullptr || offer.owner < best->owner) best = &offer;
  }
  if (best == nullptr || best->owner == Owner::nobody) {
    refusal_ = TargetRefusal::nobody;
    return {};
  }
  if (best->owner == Owner::estop) {
    refusal_ = TargetRefusal::stop;
    return {};
  }
  if (now - best->issued > max_age_ || best->issued > now) {
    refusal_ = TargetRefusal::stale;
    return {};
  }
  const auto& [vx_mps, wz_radps, vy_mps] = best->target;
  if (!std::isfinite(vx_mps) || !std::isfinite(wz_radps) || !std::isfinite(vy_mps)) {
    refusal_ = TargetRefusal::not_finite;
    ++not_finite_;
    return {};
  }
  refusal_ = TargetRefusal::none;
  if (!body_.pivots) return on_curve(best->target);
  const double turn_radps =
      std::clamp(wz_radps, -limits_.max_yaw_rate_radps, limits_.max_yaw_rate_radps);
  if (!body_.sideways || vy_mps == 0)
    return {std::clamp(vx_mps, -limits_.max_speed_mps, limits_.max_speed_mps), turn_radps};
  const double speed_mps = std::hypot(vx_mps, vy_mps);
  const double share = limits_.max_speed_mps / std::max(speed_mps, limits_.max_speed_mps);
  return {share * vx_mps, turn_radps, share * vy_mps};
}

void TargetGate::slow_to(const Twist& measured) {
  twist_.vx_mps = no_more_than(twist_.vx_mps, measured.vx_mps);
  twist_.vy_mps = no_more_than(twist_.vy_mps, measured.vy_mps);
  twist_.wz_radps = no_more_than(twist_.wz_radps, measured.wz_radps);
}

void TargetGate::find_wheels(double curvature_radpm) {
  if (!at_rest() || !std::isfinite(curvature_radpm)) return;
  radpm_ = std::clamp(curvature_radpm, -body_.most_radpm(), body_.most_radpm());
}

/// What a base that steers can do of it: no turn on the spot, and on its way to another curve no
/// faster than leaves it near that.
Twist TargetGate::on_curve(const Twist& wanted) {
  if (!(std::abs(wanted.vx_mps) > 0)) return {};
  const double most_radpm = body_.most_radpm();
  wanted_radpm_ = std::clamp(wanted.wz_radps / wanted.vx_mps, -most_radpm, most_radpm);
  const double away_radpm = wanted_radpm_ - radpm_;
  const double tightest_radpm = std::max(std::abs(wanted_radpm_), std::abs(radpm_));
  double most_mps = limits_.max_speed_mps;
  if (tightest_radpm > 0)
    most_mps = std::min(most_mps, limits_.max_yaw_rate_radps / tightest_radpm);
  // Of a change at full rate: curvature * speed * time / 2 is what it turns beside it.
  if (away_radpm != 0)
    most_mps = std::min(most_mps,
                        2 * kAstray_rad * body_.curvature_rate_radpms / (away_radpm * away_radpm));
  const double vx_mps = std::clamp(wanted.vx_mps, -most_mps, most_mps);
  return {vx_mps, vx_mps * wanted_radpm_};
}

/// One of the two parts of a speed, which has a share of what both may accelerate by.
void TargetGate::follow_way(double& mps, double& mps2, double target, double share,
                            double dt_s) const {
  // The speed is taken as positive in the direction of present motion, so that slowing down and
  // speeding up have each their limit; through zero it goes in two steps.
  const double sign = mps < 0 || (mps == 0 && target < 0) ? -1.0 : 1.0;
  const double v_mps = sign * mps;
  const double target_mps = std::max(sign * target, 0.0);
  const double change_mps = target_mps - v_mps;
  const double limit_mps2 =
      share * (change_mps > 0 ? limits_.acceleration_mps2 : limits_.deceleration_mps2);
  // Acceleration that can still be taken back in time, with the jerk there is.
  const double j = share * limits_.jerk_mps3;
  const double wanted_mps2 =
      std::copysign(std::min(limit_mps2, std::sqrt(2 * j * std::abs(change_mps))), change_mps);
  // What worked the other way ends at once: no more speed once less is wanted.
  double a_mps2 = sign * mps2;
  if (a_mps2 * change_mps < 0) a_mps2 = 0;
  a_mps2 = approach(a_mps2, wanted_mps2, j * dt_s);
  const double next_mps = v_mps + a_mps2 * dt_s;
  const bool there = change_mps > 0 ? next_mps >= target_mps : next_mps <= target_mps;
  mps = sign * (there ? target_mps : next_mps);
  mps2 = there ? 0 : sign * a_mps2;
}

void TargetGate::follow(const Twist& target, double dt_s) {
  const double ahead_mps = std::abs(target.vx_mps - twist_.vx_mps);
  const double aside_mps = std::abs(target.vy_mps - twist_.vy_mps);
  const double both_mps = std::hypot(ahead_mps, aside_mps);
  const auto share = [&](double part_mps) { return both_mps > 0 ? part_mps / both_mps : 1.0; };
  follow_way(twist_.vx_mps, acceleration_mps2_, target.vx_mps, share(ahead_mps), dt_s);
  if (body_.sideways) follow_way(twist_.vy_mps, aside_mps2_, target.vy_mps, share(aside_mps), dt_s);
  if (!body_.pivots) {
    if (!is_zero(target))
      radpm_ = approach(radpm_, wanted_radpm_, body_.curvature_rate_radpms * dt_s);
    twist_.wz_radps = radpm_ * twist_.vx_mps;
    return;
  }
  twist_.wz_radps =
      approach(twist_.wz_radps, target.wz_radps, limits_.yaw_acceleration_radps2 * dt_s);
}

void TargetGate::ramp_down(double dt_s) {
  const double before_mps = std::copysign(std::hypot(twist_.vx_mps, twist_.vy_mps), twist_.vx_mps);
  const double now_mps = approach(before_mps, 0, limits_.deceleration_mps2 * dt_s);
  acceleration_mps2_ = aside_mps2_ = 0;
  if (twist_.vy_mps != 0) {
    twist_.vx_mps *= now_mps / before_mps;
    twist_.vy_mps *= now_mps / before_mps;
  } else {
    twist_.vx_mps = now_mps;
  }
  if (!body_.pivots) {
    twist_.wz_radps = radpm_ * twist_.vx_mps;
    return;
  }
  // Turning ends with driving, so that the base stays on its curve.
  const double kept = std::abs(before_mps) > 1e-3 ? now_mps / before_mps : 0.0;
  twist_.wz_radps =
      approach(twist_.wz_radps, kept * twist_.wz_radps, limits_.yaw_acceleration_radps2 * dt_s);
}

const Twist& TargetGate::step(Time now, Duration dt, std::span<const Offer> offers, Stop stop) {
  const Twist target = choose(now, offers);
  const bool estop = std::any_of(offers.begin(), offers.end(),
                                 [](const Offer& o) { return o.owner == Owner::estop; });
  if (stop == Stop::immediate || estop) {
    refusal_ = TargetRefusal::stop;
    reset();
    return twist_;
  }
  const double dt_s = std::max(to_s(dt), 0.0);
  if (stop == Stop::controlled) refusal_ = TargetRefusal::stop;
  if (refusal_ == TargetRefusal::none) {
    follow(target, dt_s);
  } else {
    ramp_down(dt_s);
  }
  return twist_;
}

}  // namespace drover::engine
