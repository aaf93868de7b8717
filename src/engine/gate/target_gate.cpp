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
  acceleration_mps2_ = 0;
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
  if (!std::isfinite(best->target.vx_mps) || !std::isfinite(best->target.wz_radps)) {
    refusal_ = TargetRefusal::not_finite;
    ++not_finite_;
    return {};
  }
  refusal_ = TargetRefusal::none;
  if (!body_.pivots) return on_curve(best->target);
  return {
      std::clamp(best->target.vx_mps, -limits_.max_speed_mps, limits_.max_speed_mps),
      std::clamp(best->target.wz_radps, -limits_.max_yaw_rate_radps, limits_.max_yaw_rate_radps)};
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

void TargetGate::follow(const Twist& target, double dt_s) {
  // The speed is taken as positive in the direction of present motion, so that slowing down and
  // speeding up have each their limit; through zero it goes in two steps.
  const double sign = twist_.vx_mps < 0 || (twist_.vx_mps == 0 && target.vx_mps < 0) ? -1.0 : 1.0;
  const double v_mps = sign * twist_.vx_mps;
  const double target_mps = std::max(sign * target.vx_mps, 0.0);
  const double change_mps = target_mps - v_mps;
  const double limit_mps2 = change_mps > 0 ? limits_.acceleration_mps2 : limits_.deceleration_mps2;
  // Acceleration that can still be taken back in time, with the jerk there is.
  const double j = limits_.jerk_mps3;
  const double wanted_mps2 =
      std::copysign(std::min(limit_mps2, std::sqrt(2 * j * std::abs(change_mps))), change_mps);
  // What worked the other way ends at once: no more speed once less is wanted.
  double a_mps2 = sign * acceleration_mps2_;
  if (a_mps2 * change_mps < 0) a_mps2 = 0;
  a_mps2 = approach(a_mps2, wanted_mps2, j * dt_s);
  const double next_mps = v_mps + a_mps2 * dt_s;
  const bool there = change_mps > 0 ? next_mps >= target_mps : next_mps <= target_mps;
  twist_.vx_mps = sign * (there ? target_mps : next_mps);
  acceleration_mps2_ = there ? 0 : sign * a_mps2;
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
  const double before_mps = twist_.vx_mps;
  twist_.vx_mps = approach(before_mps, 0, limits_.deceleration_mps2 * dt_s);
  acceleration_mps2_ = 0;
  if (!body_.pivots) {
    twist_.wz_radps = radpm_ * twist_.vx_mps;
    return;
  }
  // Turning ends with driving, so that the base stays on its curve.
  const double kept = std::abs(before_mps) > 1e-3 ? twist_.vx_mps / before_mps : 0.0;
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
