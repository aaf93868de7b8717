// The set point of one joint outside the base: what was asked for, without a step in it.
#include "engine/group/joint_shaper.h"

#include <algorithm>
#include <cmath>

#include "engine/gate/approach.h"

namespace drover::engine {
namespace {

constexpr double kSame_rad = 1e-6;
/// Of the fastest braking: the rest is for the cycle.
constexpr double kBrakesWith = 0.8;
constexpr double kMoves_radps = 0.05;
constexpr double kThrown_radps = 1;  // what is slower is hardly thrown back
/// Times as fast as an effort rises that is asked for: what falls sinks meanwhile.
constexpr double kCatches = 5;

}  // namespace

double JointShaper::within(JointValue what, double value, double low, double high) {
  const double bounded = std::clamp(value, low, high);
  if (bounded != value) limited_ |= bit(what);
  return bounded;
}

/// What damping makes of a speed that the joint has not come to yet drives it. What damping brakes
/// does not.
double JointShaper::speeds_up_Nm(double velocity_radps, const JointMeasured& measured) const {
  const double missing_radps = velocity_radps - measured.velocity_radps;
  return damping_ *
         std::clamp(missing_radps, std::min(velocity_radps, 0.0), std::max(velocity_radps, 0.0));
}

/// What the distance makes of stiffness is an effort like any other, beside those that drive the
/// joint already.
double JointShaper::nearer(double position_rad, double besides_Nm, const JointMeasured& measured) {
  if (stiffness_ <= 0) return position_rad;
  return within(JointValue::effort, position_rad,
                measured.position_rad - (rules_.max_effort_Nm + besides_Nm) / stiffness_,
                measured.position_rad + (rules_.max_effort_Nm - besides_Nm) / stiffness_);
}

void JointShaper::take_over(const JointMeasured& measured) {
  position_rad_ = measured.position_rad;
  velocity_radps_ = 0;
  stiffness_ = effort_Nm_ = 0;
  damping_ = rules_.damping_Nmsprad;
  stiffest_ = most_damped_ = 0;
  asked_rad_ = kAbsent;
  holds_ = false;
  limited_ = 0;
  tell(0, measured);
}

/// Of its fastest speed: what nothing draws along yet would have to catch up, faster than it may
/// be.
double JointShaper::drawn(double stiffness) const {
  return stiffness > stiffness_ ? stiffness_ / stiffness : 1.0;
}

/// The share of the time of rising that a cycle is.
double JointShaper::risen(double dt_s) const {
  return rules_.rise_s > 0 ? std::min(dt_s / rules_.rise_s, 1.0) : 1.0;
}

/// Each comes up within the time of rising, and goes down so, too: a joint that has a weight would
/// fall otherwise.
void JointShaper::approach_gains(double stiffness, double damping, double effort, double dt_s) {
  const double share = risen(dt_s);
  stiffest_ = std::max({stiffest_, stiffness, stiffness_, rules_.stiffness_Nmprad});
  most_damped_ = std::max({most_damped_, damping, damping_, rules_.damping_Nmsprad});
  stiffness_ = approach(stiffness_, stiffness, share * stiffest_);
  damping_ = approach(damping_, damping, share * most_damped_);
  if (stiffness_ == stiffness) stiffest_ = 0;
  if (damping_ == damping) most_damped_ = 0;
  effort_Nm_ = approach(effort_Nm_, effort, share * rules_.max_effort_Nm);
}

void JointShaper::approach_velocity(double wanted_radps, double dt_s) {
  velocity_radps_ = approach(velocity_radps_, wanted_radps, rules_.max_acceleration_radps2 * dt_s);
  position_rad_ += velocity_radps_ * dt_s;
}

/// No faster than its set point can still be stopped at the end of its way.
double JointShaper::within_ends(double velocity_radps) {
  const auto stops_from = [this](double left_rad) {
    return std::sqrt(2 * kBrakesWith * rules_.max_acceleration_radps2 * std::max(left_rad, 0.0));
  };
  return within(JointValue::position, velocity_radps, -stops_from(position_rad_ - rules_.min_rad),
                stops_from(rules_.max_rad - position_rad_));
}

/// What a cycle is too long for.
void JointShaper::end_at(double end_rad, double dt_s) {
  const double beyond_rad = position_rad_ - end_rad;
  if (beyond_rad * velocity_radps_ <= 0 || std::abs(beyond_rad) > std::abs(velocity_radps_) * dt_s)
    return;
  position_rad_ = end_rad;
  const double step_radps = rules_.max_acceleration_radps2 * dt_s;
  if (std::abs(velocity_radps_) <= 2 * step_radps) velocity_radps_ = 0;
}

/// A speed goes ahead of a position that moves by it. One that stands for longer than its commands
/// may be apart does not move.
double JointShaper::ahead_radps(const JointTarget& target, double wanted_radps, double dt_s) {
  stands_s_ = target.position_rad == asked_rad_ ? stands_s_ + dt_s : 0;
  asked_rad_ = target.position_rad;
  return stands_s_ <= rules_.timeout_s ? wanted_radps : 0;
}

/// So fast that it still stops there; on the way of something that moves itself with its speed.
void JointShaper::approach_position(double wanted_rad, double wanted_radps, double fastest_radps,
                                    double dt_s) {
  const double step_radps = rules_.max_acceleration_radps2 * dt_s;
  const double away = wanted_rad - position_rad_;
  const double reach = std::sqrt(2 * kBrakesWith * rules_.max_acceleration_radps2 * std::abs(away));
  const double nearer = std::min(reach, std::abs(away) / std::max(dt_s, 1e-9));
  const double wanted =
      std::clamp(wanted_radps + std::copysign(nearer, away), -fastest_radps, fastest_radps);
  approach_velocity(within_ends(wanted), dt_s);
  end_at(velocity_radps_ > 0 ? rules_.max_rad : rules_.min_rad, dt_s);
  const bool arrived = (wanted_rad - position_rad_) * away <= 0 || std::abs(away) < kSame_rad;
  if (!arrived || std::abs(velocity_radps_ - wanted_radps) > step_radps + kSame_rad) return;
  position_rad_ = wanted_rad;
  velocity_radps_ = wanted_radps;
}

/// All that drives the joint together stays within its limit of effort.
void JointShaper::tell(double velocity_radps, const JointMeasured& measured) {
  told_velocity_radps_ = velocity_radps;
  const double speeds_up = speeds_up_Nm(velocity_radps, measured);
  const double effort = within(JointValue::effort, effort_Nm_, -rules_.max_effort_Nm - speeds_up,
                               rules_.max_effort_Nm - speeds_up);
  told_ = {nearer(position_rad_, effort + speeds_up, measured), effort, stiffness_, damping_};
}

/// A distance that came about under less stiffness would be torn shut by more: the position is
/// drawn to the joint, and goes on from there by the joint's limits.
void JointShaper::keep_torque(double stiffness_before, const JointMeasured& measured) {
  if (stiffness_ <= stiffness_before) return;
  draw_to(stiffness_before * (position_rad_ - measured.position_rad), measured);
}

/// So that stiffness makes that of the distance.
void JointShaper::draw_to(double gives_Nm, const JointMeasured& measured) {
  position_rad_ = measured.position_rad +
                  std::clamp(gives_Nm, -rules_.max_effort_Nm, rules_.max_effort_Nm) / stiffness_;
}

void JointShaper::follow_position(const JointTarget& target, double stiffness, double damping,
                                  const JointMeasured& measured, double dt_s) {
  const double wanted_rad =
      within(JointValue::position, target.position_rad, rules_.min_rad, rules_.max_rad);
  double wanted_radps = within(JointValue::velocity, target.velocity_radps,
                               -rules_.max_velocity_radps, rules_.max_velocity_radps);
  // Into a limit there is no speed.
  if (wanted_rad != target.position_rad) wanted_radps = 0;
  const double effort =
      within(JointValue::effort, target.effort_Nm, -rules_.max_effort_Nm, rules_.max_effort_Nm);
  const double stiffness_before = stiffness_;
  const double ahead = ahead_radps(target, wanted_radps, dt_s);
  approach_gains(stiffness, damping, effort, dt_s);
  if (stiffness == 0) {
    // The position has no weight, also while the stiffness that was there goes down: whoever gives
    // it one again begins where the joint is.
    approach_velocity(wanted_radps, dt_s);
    if (stiffness_ == 0) position_rad_ = measured.position_rad;
  } else {
    keep_torque(stiffness_before, measured);
    approach_position(wanted_rad, ahead, drawn(stiffness) * rules_.max_velocity_radps, dt_s);
  }
  tell(velocity_radps_, measured);
}

void JointShaper::follow_velocity(const JointTarget& target, const JointMeasured& measured,
                                  double dt_s) {
  double wanted = within(JointValue::velocity, target.velocity_radps, -rules_.max_velocity_radps,
                         rules_.max_velocity_radps);
  wanted = within_ends(wanted);
  const double stiffness_before = stiffness_;
  approach_gains(rules_.stiffness_Nmprad, rules_.damping_Nmsprad, 0, dt_s);
  keep_torque(stiffness_before, measured);
  const double fastest_radps = drawn(rules_.stiffness_Nmprad) * rules_.max_velocity_radps;
  approach_velocity(std::clamp(wanted, -fastest_radps, fastest_radps), dt_s);
  // What is blocked is not pushed harder for ever.
  position_rad_ = nearer(position_rad_, speeds_up_Nm(velocity_radps_, measured), measured);
  tell(velocity_radps_, measured);
}

/// Beyond an end, or too fast, it is no longer the effort that counts.
void JointShaper::follow_effort(const JointTarget& target, const JointMeasured& measured,
                                double dt_s) {
  const double end_rad = std::clamp(measured.position_rad, rules_.min_rad, rules_.max_rad);
  const bool beyond = end_rad != measured.position_rad;
  const bool fast = std::abs(measured.velocity_radps) > rules_.max_velocity_radps;
  double effort =
      within(JointValue::effort, target.effort_Nm, -rules_.max_effort_Nm, rules_.max_effort_Nm);
  const bool outwards = effort * (measured.position_rad - end_rad) > 0;
  const bool faster = fast && effort * measured.velocity_radps > 0;
  if (outwards || faster) effort = 0;
  if (outwards) limited_ |= bit(JointValue::position);
  if (faster) limited_ |= bit(JointValue::velocity);
  const double asked =
      within(JointValue::damping, target.damping_Nmsprad, 0, rules_.drive.damping_Nmsprad);
  const double damping = beyond || fast ? std::max(asked, rules_.damping_Nmsprad) : asked;
  const double stiffness_before = stiffness_;
  approach_gains(beyond ? rules_.stiffness_Nmprad : 0, damping, effort, dt_s);
  if (beyond || fast) damping_ = damping;
  if (beyond) {
    // What hangs far out comes back no faster than it may turn.
    keep_torque(stiffness_before, measured);
    approach_position(end_rad, 0, rules_.max_velocity_radps, dt_s);
  } else {
    position_rad_ = measured.position_rad;
    velocity_radps_ = 0;
  }
  tell(velocity_radps_, measured);
}

void JointShaper::follow(const JointTarget& target, const JointMeasured& measured, double dt_s) {
  holds_ = false;
  limited_ = 0;
  switch (rules_.follows) {
    case JointFollows::impedance:
      return follow_position(
          target,
          within(JointValue::stiffness, target.stiffness_Nmprad, 0, rules_.drive.stiffness_Nmprad),
          within(JointValue::damping, target.damping_Nmsprad, 0, rules_.drive.damping_Nmsprad),
          measured, dt_s);
    case JointFollows::position:
      return follow_position(target, rules_.stiffness_Nmprad, rules_.damping_Nmsprad, measured,
                             dt_s);
    case JointFollows::velocity: return follow_velocity(target, measured, dt_s);
    case JointFollows::effort: return follow_effort(target, measured, dt_s);
  }
}

/// Of an effort as holding begins. What no weight needs was told by somebody, or is a push, and
/// would press for ever against what is in its way; so would what presses out of the joint's
/// limits.
double JointShaper::kept(double effort_Nm, const JointMeasured& measured) const {
  if (!rules_.carries_weight) return 0;
  if (measured.position_rad >= rules_.max_rad) effort_Nm = std::min(effort_Nm, 0.0);
  if (measured.position_rad <= rules_.min_rad) effort_Nm = std::max(effort_Nm, 0.0);
  return effort_Nm;
}

/// In a movement it is not torn to a stop. What sinks without stiffness is only damped already.
double JointShaper::begins_to_hold_radps(const JointMeasured& measured) const {
  const double told_radps = told_velocity_radps_;
  const double goes_radps = measured.velocity_radps;
  if (stiffness_ <= 0)
    return std::clamp(goes_radps, std::min(told_radps, 0.0), std::max(told_radps, 0.0));
  if (std::abs(goes_radps) <= kMoves_radps) return 0;
  return std::clamp(goes_radps, -rules_.max_velocity_radps, rules_.max_velocity_radps);
}

/// Of the law that was told last.
double JointShaper::gives_Nm(const JointMeasured& measured) const {
  return stiffness_ * (told_.position_rad - measured.position_rad) +
         damping_ * (told_velocity_radps_ - measured.velocity_radps) + told_.effort_Nm;
}

void JointShaper::begin_hold(const JointMeasured& measured, bool keeps_weight) {
  holds_ = true;
  velocity_radps_ = begins_to_hold_radps(measured);
  // All that the drive gives now; of what sinks slowly the damping is its weight.
  const double carries =
      std::clamp(std::isfinite(measured.effort_Nm) ? measured.effort_Nm : gives_Nm(measured),
                 -rules_.max_effort_Nm, rules_.max_effort_Nm);
  weight_.begin(keeps_weight ? kept(carries, measured) : 0);
  // What the damping goes on giving is not given twice.
  const double still_damps = damping_ * (velocity_radps_ - measured.velocity_radps);
  effort_Nm_ = std::clamp(carries - still_damps, std::min(carries, 0.0), std::max(carries, 0.0));
  position_rad_ = held_rad_ = measured.position_rad;
}

/// Its set point is drawn after it without a step of what it gives.
void JointShaper::look_at_weight(const JointMeasured& measured, double dt_s) {
  const bool stands = measured.position_rad == held_rad_ && measured.velocity_radps == 0;
  const bool rests = velocity_radps_ == 0 && stiffness_ == rules_.stiffness_Nmprad &&
                     std::abs(measured.velocity_radps) < kMoves_radps;
  held_rad_ = measured.position_rad;
  const double drawn_rad = weight_.look(
      {measured.position_rad - position_rad_, gives_Nm(measured), stiffness_, stands, rests, dt_s});
  if (drawn_rad == 0) return;
  position_rad_ += drawn_rad;
  effort_Nm_ = weight_.keeps_Nm();
}

/// What is faster than it may be goes on until it is braked. By then what is becoming stiff would
/// throw it back: the set point goes along, and what would drive it on ends. A weight that falls is
/// thrown nowhere.
void JointShaper::go_on(double gave_Nm, const JointMeasured& measured) {
  const double radps = measured.velocity_radps;
  const bool falls = weight_.keeps_Nm() * radps < 0;
  if (falls || std::abs(radps) <= std::max(rules_.max_velocity_radps, kThrown_radps)) return;
  draw_to(gave_Nm * radps > 0 ? 0 : gave_Nm, measured);
}

void JointShaper::hold(const JointMeasured& measured, double dt_s, bool keeps_weight) {
  limited_ = 0;
  if (!holds_) begin_hold(measured, keeps_weight);
  const double gave_Nm = stiffness_ * (position_rad_ - held_rad_);
  look_at_weight(measured, dt_s);
  const double carried_Nm = weight_.keeps_Nm();
  // A weight is taken up sooner than an effort is let go.
  if (std::abs(effort_Nm_) < std::abs(carried_Nm))
    effort_Nm_ =
        approach(effort_Nm_, carried_Nm, (kCatches - 1) * risen(dt_s) * rules_.max_effort_Nm);
  const double stiffness_before = stiffness_;
  approach_gains(rules_.stiffness_Nmprad, rules_.damping_Nmsprad, carried_Nm, dt_s);
  // No farther out than it is, or than its end.
  const double low_rad = std::min(rules_.min_rad, position_rad_);
  const double high_rad = std::max(rules_.max_rad, position_rad_);
  approach_velocity(0, dt_s);
  if (stiffness_ > stiffness_before) go_on(gave_Nm, measured);
  position_rad_ = std::clamp(position_rad_, low_rad, high_rad);
  tell(velocity_radps_, measured);
}

void JointShaper::damp(const JointMeasured& measured, double dt_s) {
  holds_ = false;
  limited_ = 0;
  approach_gains(0, rules_.damping_Nmsprad, 0, dt_s);
  approach_velocity(0, dt_s);
  if (stiffness_ <= 0) position_rad_ = measured.position_rad;
  tell(velocity_radps_, measured);
}

}  // namespace drover::engine
