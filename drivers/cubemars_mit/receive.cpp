// The receiving half of the driver: frames to measurements, status and health.
#include <cmath>

#include "drivers/cubemars_mit/driver.h"

namespace drover::cubemars_mit {
namespace {

using std::chrono::milliseconds;
/// An answer that was under way when the last frame left tells nothing of it.
constexpr Duration kSettle = milliseconds(20);
/// An error that is there for longer after a request to run stays.
constexpr Duration kErrorTime = milliseconds(250);
constexpr Duration kTemperatureEach = milliseconds(500);
/// Of the range of torque: less is an error of its current's measurement.
constexpr double kCarries = 0.03;

}  // namespace

void CubemarsDriver::on_frame(const CanFrame& frame, Time received, DriverOut& out) {
  if (!frame.is_plain()) return;
  const std::uint8_t id = settings_.joint.id;
  const bool answers = frame.id == settings_.master_id && frame.len > 0 && frame.data[0] == id;
  if (!answers) {
    if (frame.id == id) on_command(frame, received);
    return;
  }
  const auto feedback = decode_feedback(frame, id, settings_.joint.ranges);
  if (!feedback) {
    ++heard_.bad;
    return;
  }
  on_feedback(*feedback, received, out);
}

/// Somebody else commands it, so it may be on. The guard is welcome.
void CubemarsDriver::on_command(const CanFrame& frame, Time received) {
  if (power_ == Power::leaving && leaving_since_ == kNever) power_ = Power::unknown;
  if (is_of_recipe(frame, recipe_)) return guard_.heard(received);
  foreign_.on_frame(frame.id, received);
  const auto special = mit::decode_special(frame, settings_.joint.id);
  if (special && (*special == Special::enable || power_ == Power::on)) power_ = Power::unknown;
  if (attempts_to_run()) lock(foreign_.text().view());
}

void CubemarsDriver::on_feedback(const Feedback& feedback, Time received, DriverOut& out) {
  if (silent(received)) {
    if (attempts_to_run()) lock("its answers ceased while armed");
    heard_since_ = received;
  }
  ++heard_.good;
  heard_.last_good = heard_.last_alive = received;
  feedback_ = feedback;
  follow_feedback(received);
  report_status(received, out);
  report_heard(settings_.joint.motion_of(feedback.motion, axis_), received, out);
  report_temperature(received, out);
}

void CubemarsDriver::report_temperature(Time received, DriverOut& out) {
  if (!(feedback_.degC == feedback_.degC)) return;  // six bytes do not tell it
  const bool changed = temperature_.inverter_degC != feedback_.degC;
  if (!changed && received - temperature_at_ < kTemperatureEach) return;
  temperature_ = {axis_, feedback_.degC, kAbsent};
  temperature_at_ = received;
  report_heard(temperature_, received, out);
}

/// It pushes against something, which what is off does not.
bool CubemarsDriver::carries() const {
  return std::abs(feedback_.motion.torque_Nm) > kCarries * settings_.joint.ranges.t_max_Nm;
}

/// What the newest answer means for what is under way.
void CubemarsDriver::follow_feedback(Time now) {
  if (power_ == Power::leaving) {
    // Heard before it was spoken to: somebody else speaks with it, and it may be on.
    if (leaving_since_ == kNever) {
      if (talk_.last() == kNever || carries()) power_ = Power::unknown;
    } else if (now - leaving_since_ >= kSettle) {
      power_ = Power::off;
    }
  }
  if (phase_ == Phase::running && feedback_.failed()) lock("it reports an error");
  if (phase_ != Phase::arming) return;
  if (feedback_.failed()) {
    if (now - phase_since_ > kErrorTime) lock("its error stays");
  } else if (attempts_ == kAttempts && now - last_attempt_ >= kSettle) {
    phase_ = Phase::running;
    power_ = Power::on;
  }
}

StatusInWords CubemarsDriver::status(Time now) const {
  StatusInWords status;
  status.axis = axis_;
  if (heard_.last_alive == kNever) {
    status.reason = "no answer yet";
    return status;
  }
  if (silent(now)) {
    status.reason = silent_text("no answer", settings_.stale_after);
    return status;
  }
  status.error_code = feedback_.error;
  if (foreign_.is_shown(now) && !fault_) {
    status.state = AxisState::fault;
    status.powered = power_ != Power::off;
    status.reason = foreign_.text();
  } else if (phase_ == Phase::arming) {
    status.state = AxisState::arming;
  } else if (fault_ || feedback_.failed()) {
    return fault_status(status);
  } else if (power_ == Power::on) {
    status.state = AxisState::running;
  } else if (power_ == Power::off) {
    status.state = AxisState::idle;
  } else if (power_ == Power::unknown) {
    status.reason = "it does not tell whether it is on: it damps until it is asked to run or idle";
  } else {
    status.reason = "it is told to let go";
  }
  return status;
}

StatusInWords CubemarsDriver::fault_status(StatusInWords status) const {
  status.state = AxisState::fault;
  status.powered = power_ != Power::off;
  status.lapsed = feedback_.error == static_cast<std::uint8_t>(MotorError::under_voltage);
  Reason error(error_text(feedback_.error));
  if (error.empty() && feedback_.failed())
    error.format("error %u, which its maker does not document",
                 static_cast<unsigned>(feedback_.error));
  status.reason = joined(fault_ ? lock_reason_ : Reason(), error);
  return status;
}

void CubemarsDriver::report_status(Time now, DriverOut& out) {
  const StatusInWords current = status(now);
  if (told_.is_due(current, false)) report_heard<AxisStatus>(current, now, out);
}

SourceHealth CubemarsDriver::health(Time now) const {
  SourceHealth health = heard_.health(now, {}, "no answer", settings_.stale_after);
  if (health.state == SourceState::never_heard)
    health.reason.format("motor %u was never heard: its answers are expected under 0x%03X",
                         static_cast<unsigned>(settings_.joint.id),
                         static_cast<unsigned>(settings_.master_id));
  health.bad += packer_.bad();
  if (health.state == SourceState::fresh && foreign_.is_shown(now)) health.reason = foreign_.text();
  return health;
}

}  // namespace drover::cubemars_mit
