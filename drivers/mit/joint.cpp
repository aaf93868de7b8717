#include "drivers/mit/joint.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace drover::mit {
namespace {

constexpr double kSlow_radps = 0.1;
constexpr double kFaster_radps = 0.3;
constexpr Duration kAtLast = std::chrono::milliseconds(1000);

}  // namespace

CanFrame Joint::damp_frame() const {
  MitCommand damp;
  damp.damping_Nmsprad = damping_Nmsprad;
  return encode_mit(id, damp, ranges);
}

StopRecipe Joint::stop_recipe() const {
  StopRecipe recipe;
  StopRound round;
  static_cast<void>(round.frames.push_back(damp_frame()));
  static_cast<void>(recipe.rounds.push_back(round));
  recipe.period = kStopPeriod;
  // It holds only about a position, and who knows only the recipe knows none.
  recipe.ends = StopEnds::damps;
  return recipe;
}

ImpedanceRange Joint::range() const {
  return {.min_rad = -ranges.p_max_rad - zero_rad * sign,
          .max_rad = ranges.p_max_rad - zero_rad * sign,
          .velocity_radps = ranges.v_max_radps,
          .effort_Nm = max_effort_Nm,
          .stiffness_Nmprad = kStiffnessMax_Nmprad,
          .damping_Nmsprad = kDampingMax_Nmsprad};
}

double Joint::setpoint_radps(const CanFrame& frame) const {
  const auto raw = decode_mit_raw(frame, id);
  if (!raw) return kAbsent;
  const MitCommand mit = scale(*raw, ranges);
  if (mit.stiffness_Nmprad != 0 || mit.torque_Nm != 0) return kAbsent;
  return mit.velocity_radps * sign;
}

AxisMotion Joint::motion_of(const Motion& motion, AxisId axis) const {
  AxisMotion joint;
  joint.axis = axis;
  joint.position_rad = (motion.position_rad - zero_rad) * sign;
  joint.velocity_radps = motion.velocity_radps * sign;
  joint.effort_Nm = motion.torque_Nm * sign;
  return joint;
}

SilenceBehaviour silence_of(std::uint32_t timeout_ms, const Reason& text) {
  SilenceBehaviour behaviour;
  behaviour.stops = timeout_ms > 0;
  behaviour.after = std::chrono::milliseconds(timeout_ms);
  behaviour.text = text.view();
  behaviour.ends = StopEnds::coasts;
  return behaviour;
}

FrameEffect effect(const CanFrame& frame, std::uint8_t id) {
  if (const auto special = decode_special(frame, id)) {
    switch (*special) {
      // It then follows the last MIT frame that it heard, and one that moves passes only when
      // moving is permitted.
      case Special::enable:
      case Special::clear_error: return FrameEffect::harmless;
      case Special::disable: return FrameEffect::stop;
      case Special::set_zero: return FrameEffect::forbidden;
    }
  }
  const auto raw = decode_mit_raw(frame, id);
  if (!raw) return FrameEffect::forbidden;
  return only_damps(*raw) ? FrameEffect::stop : FrameEffect::motion;
}

double SetpointPacker::clamped(double value, double limit) {
  if (std::abs(value) <= limit) return value;
  ++bad_;
  return std::copysign(limit, value);
}

CanFrame SetpointPacker::frame_of(const Setpoint& command) {
  const Impedance& law = command.impedance;
  const double all[] = {law.position_rad, command.velocity_radps, law.effort_Nm,
                        law.stiffness_Nmprad, law.damping_Nmsprad};
  if (!std::all_of(std::begin(all), std::end(all), [](double x) { return std::isfinite(x); }) ||
      law.stiffness_Nmprad < 0 || law.damping_Nmsprad < 0) {
    ++bad_;
    return damp_;
  }
  MitCommand mit;
  // A position without weight may be anything.
  const double position_rad = law.position_rad * joint_.sign + joint_.zero_rad;
  if (law.stiffness_Nmprad > 0) mit.position_rad = clamped(position_rad, joint_.ranges.p_max_rad);
  mit.velocity_radps = clamped(command.velocity_radps * joint_.sign, joint_.ranges.v_max_radps);
  if (joint_.nearest_speed && mit.velocity_radps != 0)
    mit.velocity_radps += speed_step_radps(joint_.ranges) / 2;
  mit.torque_Nm = clamped(law.effort_Nm * joint_.sign, joint_.max_effort_Nm);
  mit.stiffness_Nmprad = clamped(law.stiffness_Nmprad, kStiffnessMax_Nmprad);
  mit.damping_Nmsprad = clamped(law.damping_Nmsprad, kDampingMax_Nmsprad);
  return encode_mit(joint_.id, mit, joint_.ranges);
}

void LettingGo::begin(Time now) {
  since_ = now;
  slowest_radps_ = std::numeric_limits<double>::infinity();
}

bool LettingGo::is_due(double velocity_radps, Time now) {
  const double speed_radps = std::abs(velocity_radps);
  slowest_radps_ = std::min(slowest_radps_, speed_radps);
  return speed_radps < kSlow_radps || speed_radps > slowest_radps_ + kFaster_radps ||
         now - since_ > kAtLast;
}

}  // namespace drover::mit
