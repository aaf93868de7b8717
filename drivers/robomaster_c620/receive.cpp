// The receiving half of the driver: frames to measurements, status and health.
#include <algorithm>
#include <cmath>

#include "drivers/robomaster_c620/driver.h"

namespace drover::robomaster {

void RobomasterDriver::on_frame(const CanFrame& frame, Time received, DriverOut& out) {
  if (!frame.is_plain()) return;
  if (frame.id == settings_.command_id()) return on_foreign(frame, received);
  for (std::size_t i = 0; i < kMotors; ++i) {
    if (frame.id != settings_.feedback_id(i)) continue;
    const auto feedback = decode_feedback(frame, settings_.motor(i));
    if (!feedback) {
      ++heard_.bad;
      return;
    }
    ++heard_.good;
    heard_.last_good = heard_.last_alive = received;
    motors_[i].on_feedback(*feedback, received);
    report_motor(i, received, out);
    return;
  }
}

/// The guard knows nothing but zeros. Two who send currents take turns, a thousand times a second.
void RobomasterDriver::on_foreign(const CanFrame& frame, Time received) {
  if (is_of_recipe(frame, recipe_)) return;
  foreign_.on_frame(frame.id, received);
  if (attempts_to_run()) lock(foreign_.text());
}

void RobomasterDriver::report_motor(std::size_t channel, Time received, DriverOut& out) {
  const Motor& motor = motors_[channel];
  AxisMotion motion;
  motion.axis = axes_[channel];
  motion.position_rad = motor.position_rad();
  motion.velocity_radps = motor.velocity_radps();
  motion.effort_Nm = motor.effort_Nm();
  report_heard(motion, received, out);
  Told& told = told_[channel];
  const double degC = motor.degC();
  if (degC == told.degC || std::isnan(degC)) return;
  told.degC = degC;
  AxisTemperature temperature;
  temperature.axis = axes_[channel];
  temperature.motor_degC = degC;
  report_heard(temperature, received, out);
}

Time RobomasterDriver::oldest() const {
  const auto* const motor =
      std::min_element(motors_.begin(), motors_.end(),
                       [](const Motor& a, const Motor& b) { return a.last() < b.last(); });
  return motor->last();
}

/// "motor 2 (202)": its number, and the id of what it tells.
Reason RobomasterDriver::name_of(std::size_t channel) const {
  Reason name;
  name.format("motor %d (%03X)", settings_.motor(channel),
              static_cast<unsigned>(settings_.feedback_id(channel)));
  return name;
}

Reason RobomasterDriver::silence_of_any(Duration limit, Time now) const {
  for (std::size_t i = 0; i < kMotors; ++i) {
    if (motors_[i].heard_within(limit, now)) continue;
    Reason text;
    const Reason name = name_of(i);
    text.format("%.*s %s", static_cast<int>(name.view().size()), name.view().data(),
                motors_[i].last() == kNever ? "was not heard yet" : "is silent");
    return text;
  }
  return {};
}

/// What is known of one motor; they run together, or not at all.
StatusInWords RobomasterDriver::status(std::size_t channel, Time now) const {
  StatusInWords status;
  status.axis = axes_[channel];
  if (!motors_[channel].heard_within(settings_.silent_after, now)) {
    const bool never = motors_[channel].last() == kNever;
    status.reason = never ? Reason("it was not heard yet")
                          : silent_text("nothing heard", settings_.silent_after);
    return status;
  }
  status.powered = engaged_;
  Reason why = phase_ == Phase::locked ? lock_reason_ : Reason();
  if (why.empty() && foreign_.is_shown(now)) why = foreign_.text();
  if (why.empty()) why = silence_of_any(settings_.silent_after, now);
  if (!why.empty()) {
    status.state = AxisState::fault;
    status.reason = why;
    status.error_code = phase_ == Phase::locked && channel == faulty_ ? 1 : 0;
  } else if (phase_ == Phase::arming) {
    status.state = AxisState::arming;
  } else {
    status.state = engaged_ ? AxisState::running : AxisState::idle;
  }
  return status;
}

void RobomasterDriver::report_status(Time now, bool always, DriverOut& out) {
  for (std::size_t i = 0; i < kMotors; ++i) {
    const StatusInWords current = status(i, now);
    if (told_[i].status.is_due(current, always)) report_heard<AxisStatus>(current, now, out);
  }
}

Reason RobomasterDriver::words(const Measurement& reported) const {
  const auto* const status = std::get_if<AxisStatus>(&reported.value);
  for (std::size_t i = 0; status != nullptr && i < kMotors; ++i)
    if (axes_[i] == status->axis) return told_[i].status.words(reported);
  return {};
}

SourceHealth RobomasterDriver::health(Time now) const {
  SourceHealth health = heard_.health(now, "no motor was ever heard", "nothing heard of any motor",
                                      settings_.stale_after);
  health.bad += bad_setpoints_;
  if (health.state != SourceState::fresh) return health;
  if (const Reason silent = silence_of_any(settings_.stale_after, now); !silent.empty())
    return stale(health, silent);
  if (foreign_.is_shown(now)) health.reason = foreign_.text();
  return health;
}

}  // namespace drover::robomaster
