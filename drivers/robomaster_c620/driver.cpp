// The state machine: when motors get a current, and which.
#include "drivers/robomaster_c620/driver.h"

#include <algorithm>
#include <cmath>
#include <functional>

namespace drover::robomaster {
namespace {

using std::chrono::milliseconds;
constexpr double kSlow_radps = 0.1;
constexpr Duration kIdleAtLast = milliseconds(1000);
constexpr Duration kArmingTime = milliseconds(1000);
/// A cycle that was left out is not made up for.
constexpr Duration kLongestStep = milliseconds(20);

std::array<FrameFilter, kMotors + 1> filters_of(const Settings& settings) {
  std::array<FrameFilter, kMotors + 1> filters{};
  for (std::size_t i = 0; i < kMotors; ++i) filters[i].id = settings.feedback_id(i);
  filters[kMotors].id = settings.command_id();
  return filters;
}

StopRecipe recipe_of(const Settings& settings) {
  StopRecipe recipe;
  StopRound zero;
  static_cast<void>(zero.frames.push_back(encode_currents(settings.command_id(), {})));
  static_cast<void>(recipe.rounds.push_back(zero));
  recipe.period = milliseconds(10);
  recipe.ends = StopEnds::coasts;
  return recipe;
}

/// They run together; while one is caught another may be at rest already.
AxisRequest common(std::span<const Setpoint> wanted) {
  const auto all = [wanted](AxisRequest request) {
    return std::all_of(wanted.begin(), wanted.end(),
                       [&](const Setpoint& each) { return each.request == request; });
  };
  if (all(AxisRequest::run)) return AxisRequest::run;
  if (all(AxisRequest::idle)) return AxisRequest::idle;
  const auto is = [wanted](auto fits) {
    return std::any_of(wanted.begin(), wanted.end(),
                       [&](const Setpoint& each) { return fits(each.request); });
  };
  const bool held = is([](AxisRequest each) { return each == AxisRequest::hold; });
  const bool let_go = is([](AxisRequest each) { return each == AxisRequest::idle; });
  return held && !let_go ? AxisRequest::hold : AxisRequest::rest;
}

}  // namespace

RobomasterDriver::RobomasterDriver(const Settings& settings,
                                   const std::array<AxisId, kMotors>& axes)
    : settings_(settings),
      axes_(axes),
      motors_{Motor(settings_, 0), Motor(settings_, 1), Motor(settings_, 2), Motor(settings_, 3)},
      loose_(settings_.friction_Nm),
      hears_(filters_of(settings)),
      recipe_(recipe_of(settings)) {
  rule_.id = settings.command_id();
  rule_.min_len = rule_.max_len = 8;
}

/// Motors that brake until they are asked to run anew are a fault for whoever counts on them.
void RobomasterDriver::lock(const Reason& why) {
  phase_ = Phase::locked;
  lock_reason_ = why;
  faulty_ = kMotors;
}

bool RobomasterDriver::is_any_loose() const {
  bool any = false;
  for (std::size_t channel = 0; channel < kMotors; ++channel) any = any || loose_.is_loose(channel);
  return any;
}

void RobomasterDriver::start_arming(Time now) {
  const Phase phase_before = phase_;
  phase_ = Phase::arming;
  phase_since_ = now;
  lock_reason_.clear();
  for (Motor& motor : motors_) motor.begin_anew();
  if (phase_before == Phase::locked || is_any_loose()) loose_.begin_anew();
  if (const Reason silent = silence_of_any(settings_.stale_after, now); !silent.empty())
    lock(silent);
}

void RobomasterDriver::take(AxisRequest request, Time now) {
  if (request == request_) return;
  const bool ran = arms(request_);
  request_ = request;
  // From following to holding and back it stays as it is, and what was given up is armed anew.
  if (arms(request)) {
    if (!ran || phase_ == Phase::locked) start_arming(now);
    return;
  }
  phase_ = request == AxisRequest::idle ? Phase::idling : Phase::resting;
  phase_since_ = now;
  lock_reason_.clear();
}

Reason RobomasterDriver::fault_of(std::size_t channel) const {
  const Motor& motor = motors_[channel];
  const Reason name = name_of(channel);
  const auto size = static_cast<int>(name.view().size());
  Reason why;
  if (motor.too_hot())
    why.format("%.*s is too hot: %.0f °C", size, name.view().data(), motor.degC());
  if (motor.is_torn())
    why.format("%.*s has no current however much it is asked for: is a line to it torn?", size,
               name.view().data());
  if (motor.is_stuck())
    why.format(
        "%.*s tells the same angle however hard it is pushed: its sensor, or its wheel, is stuck",
        size, name.view().data());
  if (loose_.is_loose(channel))
    why.format(
        "%.*s turns as if nothing hung on it, whatever the others carry: is its wheel loose on the "
        "shaft, or in the air?",
        size, name.view().data());
  return why;
}

void RobomasterDriver::watch_loads(Duration dt) {
  if (phase_ != Phase::running || !engaged_) return;
  std::array<Load, kMotors> loads;
  for (std::size_t i = 0; i < kMotors; ++i)
    loads[i] = {motors_[i].velocity_radps(), motors_[i].effort_Nm()};
  loose_.step(loads, dt);
}

/// It is no fault of one of them.
bool RobomasterDriver::none_has_current() const {
  const auto lacks = [](const Motor& motor) { return motor.lacks_current(); };
  const auto is_torn = [](const Motor& motor) { return motor.is_torn(); };
  return std::all_of(motors_.begin(), motors_.end(), lacks) &&
         std::any_of(motors_.begin(), motors_.end(), is_torn);
}

/// What they told means for what is under way.
void RobomasterDriver::look_at_motors(Time now) {
  const Reason silent = silence_of_any(settings_.stale_after, now);
  doubtful_ = doubtful_ || !silent.empty();
  if (std::any_of(motors_.begin(), motors_.end(), std::mem_fn(&Motor::tells_current)))
    for (Motor& motor : motors_) motor.expect_current();
  if (!attempts_to_run()) return;
  if (!silent.empty()) return lock(silent);
  if (none_has_current())
    return lock(
        "no motor has a current however much is asked for: do they hear what they are told?");
  for (std::size_t i = 0; i < kMotors; ++i)
    if (const Reason fault = fault_of(i); !fault.empty()) {
      lock(fault);
      faulty_ = i;
      return;
    }
  if (foreign_.is_shown(now)) return lock(foreign_.text());
  if (phase_ == Phase::arming && oldest() > phase_since_) {
    phase_ = Phase::running;
    engaged_ = true;
    doubtful_ = false;
  } else if (phase_ == Phase::arming && now - phase_since_ > kArmingTime) {
    lock("it is not heard");
  }
}

bool RobomasterDriver::all_slow() const {
  return std::all_of(motors_.begin(), motors_.end(), [](const Motor& motor) {
    return std::abs(motor.velocity_radps()) < kSlow_radps;
  });
}

void RobomasterDriver::let_go_after(Duration limit, Time now) {
  if (engaged_ && (all_slow() || now - phase_since_ > limit)) engaged_ = false;
}

/// A wheel that is to stand gets only what brakes: in its cycle nothing else may be permitted, and
/// what does not leave lets the last current stand.
void RobomasterDriver::command(std::size_t channel, const Setpoint& wanted, Duration dt, Time now) {
  Motor& motor = motors_[channel];
  if (!engaged_) return motor.coast();
  double velocity_radps = arms(wanted.request) ? wanted.velocity_radps : 0;
  if (!std::isfinite(velocity_radps)) {
    ++bad_setpoints_;
    velocity_radps = 0;
  }
  if (std::abs(velocity_radps) > settings_.max_radps) ++bad_setpoints_;
  const bool follows = phase_ == Phase::running && wanted.request == AxisRequest::run;
  if (follows && velocity_radps != 0) return motor.follow(velocity_radps, dt, now);
  motor.brake(phase_ == Phase::running ? velocity_radps : 0, dt, now);
}

void RobomasterDriver::control(std::span<const Setpoint> wanted, Time now, DriverOut& out) {
  const Duration since = last_control_ == kNever ? Duration{} : now - last_control_;
  const Duration dt = std::clamp(since, Duration{}, kLongestStep);
  last_control_ = now;
  watch_loads(dt);
  look_at_motors(now);
  if (phase_ == Phase::idling) let_go_after(kIdleAtLast, now);
  if (phase_ == Phase::resting && doubtful_ && silence_of_any(settings_.stale_after, now).empty()) {
    let_go_after(kIdleAtLast, now);
    doubtful_ = engaged_;
  }
  Currents currents{};
  for (std::size_t i = 0; i < kMotors; ++i) {
    command(i, i < wanted.size() ? wanted[i] : Setpoint{}, dt, now);
    currents[i] = motors_[i].counts();
  }
  // Never a frame to motors of which none was heard.
  if (heard_.last_alive != kNever) out.send(encode_currents(settings_.command_id(), currents));
}

void RobomasterDriver::on_setpoints(std::span<const Setpoint> wanted, Time now, DriverOut& out) {
  commanded_ = true;
  take(common(wanted), now);
  control(wanted, now, out);
}

void RobomasterDriver::on_tick(Time now, DriverOut& out) {
  if (!commanded_) control({}, now, out);  // nobody decided: as at rest
  commanded_ = false;
  report_status(now, false, out);
}

void RobomasterDriver::on_link_up(Time) {
  heard_.last_alive = kNever;
  doubtful_ = true;
  for (Motor& motor : motors_) motor.forget();
  if (arms(request_)) lock("the link was lost while armed");
}

/// A current that is no more than a brake is a stop: of each motor by what it told last.
Effect RobomasterDriver::effect(const Message& message, Time now) const {
  if (message.frame() == nullptr) return {};
  const auto currents = decode_currents(*message.frame(), settings_.command_id());
  if (!currents) return {};
  ChannelMask moves = 0;
  for (std::size_t i = 0; i < kMotors; ++i)
    if (!motors_[i].is_brake((*currents)[i], now))
      moves = static_cast<ChannelMask>(moves | channel_bit(i));
  return {moves == 0 ? FrameEffect::stop : FrameEffect::motion, moves};
}

SilenceBehaviour RobomasterDriver::silence() const {
  SilenceBehaviour behaviour;
  behaviour.text = "keeps its last current for ever, for all that its maker says";
  behaviour.ends = StopEnds::coasts;
  return behaviour;
}

}  // namespace drover::robomaster
