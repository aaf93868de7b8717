#include "drivers/robomaster_c620/motor.h"

#include <algorithm>
#include <cmath>

#include "drover/measurement.h"

namespace drover::robomaster {
namespace {

/// Slower than this it stands, and is kept where it is.
constexpr double kStands_radps = 0.1;
/// So is one that gets no slower by a tenth for so long: a slope rolls it.
constexpr Duration kGetsNoSlower = std::chrono::milliseconds(100);
constexpr double kSlower = 0.9;
/// So far off nothing is done about it: else two wheels that stand would push each other.
constexpr double kFree_rad = 0.003;
/// Of its limit that a hot motor may still brake with.
constexpr double kLeastShare = 0.3;
/// So much of its limit, or five times its running friction, turns the rotor by some of the 8192
/// parts of a turn, in gear and tyre if nowhere else: who tells none for so long is stuck.
constexpr double kPushes = 0.15;
constexpr double kPushesFrictions = 5;
constexpr Duration kStuck = std::chrono::milliseconds(150);
/// A motor with a current has at least this share of what turns it at all. One that is asked for so
/// much more than that, or of its limit, for so long and has less is torn: a wheel that the others
/// drag along nearly as it should turn is asked for little more than friction.
constexpr double kHasNone = 0.5;
constexpr double kAsksFrictions = 1.5;
constexpr double kAsks = 0.03;
constexpr Duration kTorn = std::chrono::milliseconds(300);
/// Longer between two frames, and the turns between them are not counted.
constexpr Duration kCounts = std::chrono::milliseconds(100);

/// Whether it has been so for long; `since` is when that began.
bool lasts(bool is_so, Duration limit, Time& since, Time now) {
  if (!is_so) since = kNever;
  if (is_so && since == kNever) since = now;
  return is_so && now - since > limit;
}

}  // namespace

Motor::Motor(const Settings& settings, std::size_t channel)
    : settings_(settings), sign_(settings.sign[channel]) {}

/// The angle is of one turn: how many there were in between, the speed tells.
void Motor::on_feedback(const Feedback& feedback, Time received) {
  const bool counts = angle_known_ && received - last_ <= kCounts;
  if (counts) {
    const double mean_rpm = 0.5 * (feedback_.rpm + feedback.rpm);
    const double expected_turns = mean_rpm / 60 * to_s(received - last_);
    const double part_turns = (feedback.angle - feedback_.angle) / double{kAnglesPerTurn};
    const double turns = part_turns + std::round(expected_turns - part_turns);
    position_rad_ += turns * kTurn_rad * sign_ / settings_.gear_ratio;
  } else if (anchored_) {
    anchored_ = false;  // it may have been turned by hand
  }
  if (!counts || feedback.angle != feedback_.angle) {
    turned_at_ = received;
    stuck_ = false;
  }
  angle_known_ = true;
  feedback_ = feedback;
  tells_current_ = tells_current_ || has_current();
  last_ = received;
  velocity_radps_ = feedback.rpm * kRadpsPerRpm * sign_ / settings_.gear_ratio;
}

void Motor::forget() {
  last_ = kNever;
  feedback_ = {};
  angle_known_ = stuck_ = torn_ = tells_current_ = false;
  velocity_radps_ = 0;
  pushed_since_ = without_since_ = kNever;
  coast();
}

void Motor::begin_anew() {
  torn_ = false;
  without_since_ = kNever;
}

double Motor::effort_Nm() const {
  return feedback_.current / settings_.counts_per_A * settings_.Nm_per_A * sign_;
}

double Motor::degC() const {
  return feedback_.degC == 0 ? kAbsent : static_cast<double>(feedback_.degC);
}

bool Motor::too_hot() const {
  return feedback_.degC >= settings_.too_hot_degC;
}

double Motor::limit_Nm() const {
  const double over =
      (feedback_.degC - settings_.hot_degC) / (settings_.too_hot_degC - settings_.hot_degC);
  return settings_.limit_Nm * (1 - (1 - kLeastShare) * std::clamp(over, 0.0, 1.0));
}

/// Towards nothing: a brake that is rounded is no more than the brake.
std::int16_t Motor::counts_of(double torque_Nm) const {
  const double limit_Nm = this->limit_Nm();
  const double counts = std::clamp(torque_Nm, -limit_Nm, limit_Nm) / settings_.Nm_per_A *
                        settings_.counts_per_A * sign_;
  return static_cast<std::int16_t>(
      std::clamp(counts, -settings_.most_counts, settings_.most_counts));
}

void Motor::ramp_to(double wanted_radps, Duration dt) {
  const double step_radps = settings_.ramp_radps2 * to_s(dt);
  ramped_radps_ += std::clamp(wanted_radps - ramped_radps_, -step_radps, step_radps);
}

/// It is asked for so much.
bool Motor::is_asked(double share_of_limit, double frictions) const {
  const double asked_Nm = std::abs(counts_) / settings_.counts_per_A * settings_.Nm_per_A;
  return asked_Nm >=
         std::max(share_of_limit * settings_.limit_Nm, frictions * settings_.friction_Nm);
}

/// What has no current turns nothing, whatever its sensor is like.
void Motor::watch_angle(Time now) {
  const bool pushed =
      is_asked(kPushes, kPushesFrictions) && loop_ == Loop::following && !lacks_current();
  if (lasts(pushed, kStuck, pushed_since_, now) && now - turned_at_ > kStuck) stuck_ = true;
}

bool Motor::has_current() const {
  return std::abs(effort_Nm()) > kHasNone * settings_.friction_Nm;
}

/// A line of it is torn. One that never told a current may be of those that tell none.
void Motor::watch_current(Time now) {
  const bool without = is_asked(kAsks, kAsksFrictions) && !has_current() && tells_current_;
  if (lasts(without, kTorn, without_since_, now)) torn_ = true;
}

void Motor::follow(double wanted_radps, Duration dt, Time now) {
  watch_current(now);
  watch_angle(now);
  if (torn_ || !heard_within(settings_.blind_after, now)) return coast();
  if (loop_ != Loop::following) {
    ramped_radps_ = velocity_radps_;
    integral_Nm_ = spring_Nm();  // what holds it on a slope goes on to do so
    anchored_ = false;
    loop_ = Loop::following;
  }
  ramp_to(std::clamp(wanted_radps, -settings_.max_radps, settings_.max_radps), dt);
  const double error_radps = ramped_radps_ - velocity_radps_;
  // At rest the sum of errors alone would take a third of a second to overcome friction.
  const double friction_Nm =
      ramped_radps_ != 0 ? std::copysign(settings_.friction_Nm, ramped_radps_) : 0.0;
  const double at_once_Nm = settings_.velocity_gain_Nms_per_rad * error_radps + friction_Nm;
  const double step_Nm = settings_.integrator_gain_Nm_per_rad * error_radps * to_s(dt);
  const double limit_Nm = this->limit_Nm();
  const bool full = std::abs(at_once_Nm + integral_Nm_ + step_Nm) > limit_Nm;
  const bool grows = (at_once_Nm + integral_Nm_) * step_Nm > 0;
  if (!full || !grows) integral_Nm_ += step_Nm;
  integral_Nm_ = std::clamp(integral_Nm_, -limit_Nm, limit_Nm);
  counts_ = counts_of(at_once_Nm + integral_Nm_);
}

void Motor::begin_braking(Time now) {
  loop_ = Loop::braking;
  ramped_radps_ = velocity_radps_;
  anchored_ = false;
  slowest_radps_ = std::abs(velocity_radps_);
  slower_at_ = now;
}

void Motor::brake(double slowest_radps, Duration dt, Time now) {
  if (!heard_within(settings_.blind_after, now)) return coast();
  watch_current(now);
  // What stood there would turn it as soon as its line has contact again.
  if (torn_) return coast();
  if (loop_ != Loop::braking) begin_braking(now);
  ramp_to(slowest_radps, dt);
  // Not beyond what it does: then it would be driven.
  const double most_radps = std::abs(velocity_radps_);
  const bool along = ramped_radps_ * velocity_radps_ > 0;
  ramped_radps_ = along ? std::clamp(ramped_radps_, -most_radps, most_radps) : 0.0;
  const bool ramps = slowest_radps != 0 || ramped_radps_ != 0;
  if (ramps) anchored_ = false;
  if (ramps || most_radps < kSlower * slowest_radps_) {
    slowest_radps_ = most_radps;
    slower_at_ = now;
  }
  anchor(now);
  counts_ = counts_of(brake_Nm());
}

/// Kept where it came to rest. What pushes harder than the limit takes that place along.
void Motor::anchor(Time now) {
  const bool stands = std::abs(velocity_radps_) < kStands_radps;
  if (!anchored_ && (stands || now - slower_at_ > kGetsNoSlower) && ramped_radps_ == 0) {
    anchored_ = true;
    anchor_rad_ = position_rad_;
  }
  if (!anchored_) return;
  const double most_rad = kFree_rad + limit_Nm() / settings_.integrator_gain_Nm_per_rad;
  anchor_rad_ = std::clamp(anchor_rad_, position_rad_ - most_rad, position_rad_ + most_rad);
}

double Motor::spring_Nm() const {
  if (!anchored_) return 0;
  const double off_rad = position_rad_ - anchor_rad_;
  const double counted_rad = std::max(std::abs(off_rad) - kFree_rad, 0.0);
  return -std::copysign(counted_rad, off_rad) * settings_.integrator_gain_Nm_per_rad;
}

/// Against the turn, and against the way from where it stood: nothing else.
double Motor::brake_Nm() const {
  const double slower_radps = loop_ == Loop::braking ? ramped_radps_ : 0.0;
  const double against_Nm = settings_.velocity_gain_Nms_per_rad * (slower_radps - velocity_radps_);
  return (against_Nm * velocity_radps_ < 0 ? against_Nm : 0.0) + spring_Nm();
}

void Motor::coast() {
  loop_ = Loop::coasting;
  integral_Nm_ = 0;
  ramped_radps_ = 0;
  anchored_ = false;
  counts_ = 0;
}

bool Motor::is_brake(std::int16_t counts, Time now) const {
  if (counts == 0) return true;
  if (!heard_within(settings_.blind_after, now)) return false;
  const std::int16_t most = counts_of(brake_Nm());
  return counts > 0 ? counts <= most : counts >= most;
}

}  // namespace drover::robomaster
