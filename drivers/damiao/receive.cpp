// The receiving half of the driver: frames to measurements, status and health.
#include "drivers/damiao/driver.h"

namespace drover::damiao {
namespace {

using std::chrono::milliseconds;
/// A feedback that was under way when the request left tells nothing of it.
constexpr Duration kSettle = milliseconds(20);
/// Errors that were cleared must be gone by then.
constexpr Duration kClearTime = milliseconds(250);
constexpr Duration kTemperatureEach = milliseconds(500);

std::string_view error_text(std::uint8_t status) {
  switch (static_cast<MotorStatus>(status)) {
    case MotorStatus::over_voltage: return "supply over voltage";
    case MotorStatus::under_voltage: return "supply under voltage";
    case MotorStatus::over_current: return "over current";
    case MotorStatus::mos_hot: return "power stage over temperature";
    case MotorStatus::rotor_hot: return "motor over temperature";
    case MotorStatus::lost_comm: return "no command came within its time-out";
    case MotorStatus::overload: return "overload";
    default: return {};
  }
}

}  // namespace

void DamiaoDriver::on_frame(const CanFrame& frame, Time received, DriverOut& out) {
  if (!frame.is_plain()) return;
  if (frame.id == settings_.master_id) return on_answer(frame, received, out);
  if (frame.id == settings_.joint.id) return on_command(frame, received);
  if (frame.id == kRequestId) on_request(frame, received);
}

/// Somebody else commands it. The guard is welcome.
void DamiaoDriver::on_command(const CanFrame& frame, Time received) {
  if (is_of_recipe(frame, recipe_)) return guard_.heard(received);
  foreign_.on_frame(frame.id, received);
  if (attempts_to_run()) lock(foreign_.text().view());
}

/// Who only reads is welcome; who writes may have changed what was found right.
void DamiaoDriver::on_request(const CanFrame& frame, Time received) {
  if (frame.len < 3 || frame.data[0] != settings_.joint.id || frame.data[1] != 0) return;
  const auto verb = static_cast<Verb>(frame.data[2]);
  if (verb == Verb::read || verb == Verb::feedback) return;
  setup_.forget();
  foreign_.on_frame(frame.id, received);
  if (attempts_to_run()) lock(foreign_.text().view());
}

/// What looks like a register is never taken for a feedback, asked for or late: it would tell a
/// position that is not so. One that was a feedback, and only looks so, is lost; the next differs.
void DamiaoDriver::on_answer(const CanFrame& frame, Time received, DriverOut& out) {
  if (const auto reply = decode_reply(frame, settings_.joint.id)) {
    setup_.on_reply(*reply);
  } else if (const auto feedback =
                 decode_feedback(frame, settings_.joint.id, settings_.joint.ranges)) {
    on_feedback(*feedback, received, out);
  } else {
    // Motors that share a master id tell by their own which of them speaks.
    if (frame.len != 8) ++heard_.bad;
    return;
  }
  ++heard_.good;
  heard_.last_good = received;
}

void DamiaoDriver::on_feedback(const Feedback& feedback, Time received, DriverOut& out) {
  if (silent(received)) {
    if (attempts_to_run()) lock("its answers ceased while armed");
    heard_since_ = received;
    setup_.begin();
  }
  heard_.last_alive = received;
  feedback_ = feedback;
  follow_feedback(received);
  report_status(received, false, out);
  report_heard(settings_.joint.motion_of(feedback.motion, axis_), received, out);
  report_temperature(received, out);
}

void DamiaoDriver::report_temperature(Time received, DriverOut& out) {
  const bool changed = temperature_.inverter_degC != feedback_.mos_degC ||
                       temperature_.motor_degC != feedback_.rotor_degC;
  if (!changed && received - temperature_at_ < kTemperatureEach) return;
  temperature_ = {axis_, feedback_.mos_degC, feedback_.rotor_degC};
  temperature_at_ = received;
  report_heard(temperature_, received, out);
}

/// What the newest feedback means for what is under way.
void DamiaoDriver::follow_feedback(Time now) {
  if (phase_ == Phase::running && !feedback_.enabled()) {
    lock(feedback_.failed() ? "it reports an error" : "it let go by itself");
  } else if (phase_ == Phase::arming && setup_.done()) {
    const bool tried = cleared_at_ != kNever && now - cleared_at_ > kClearTime;
    if (feedback_.failed() && tried) lock("its error does not clear");
    // What was on already has booted long ago.
    const bool booted = first_attempt_ == kNever || now - heard_since_ >= settings_.settle;
    const bool settled = booted && now - phase_since_ >= kSettle;
    if (feedback_.enabled() && settled) phase_ = Phase::running;
  }
}

StatusInWords DamiaoDriver::status(Time now) const {
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
  const bool known = feedback_.enabled() || feedback_.disabled();
  if (!known) status.error_code = feedback_.status;
  if (foreign_.is_shown(now) && !fault_) {
    status.state = AxisState::fault;
    status.powered = feedback_.enabled();
    status.reason = foreign_.text();
    return status;
  }
  if (phase_ == Phase::arming) {
    status.state = AxisState::arming;
  } else if (fault_ || setup_.failed() || (!known && !feedback_.lost_comm())) {
    return fault_status(status);
  } else if (feedback_.enabled()) {
    status.state = AxisState::running;
  } else {
    status.state = AxisState::idle;
    if (feedback_.lost_comm())
      status.reason = "its time-out ran out while nobody fed it: cleared at the next start";
  }
  return status;
}

StatusInWords DamiaoDriver::fault_status(StatusInWords status) const {
  constexpr auto kUnderVoltage = static_cast<std::uint8_t>(MotorStatus::under_voltage);
  status.state = AxisState::fault;
  status.powered = feedback_.enabled();
  status.lapsed = feedback_.lost_comm() || feedback_.status == kUnderVoltage;
  Reason error(error_text(feedback_.status));
  if (error.empty() && status.error_code != 0)
    error.format("status %u, which its maker does not document",
                 static_cast<unsigned>(feedback_.status));
  Reason why = fault_ ? lock_reason_ : Reason();
  if (why.empty() && setup_.failed()) why = setup_.reason();
  status.reason = joined(why, error);
  return status;
}

void DamiaoDriver::report_status(Time now, bool always, DriverOut& out) {
  const StatusInWords current = status(now);
  if (!told_.is_due(current, always)) return;
  report_heard<AxisStatus>(current, now, out);
}

SourceHealth DamiaoDriver::health(Time now) const {
  SourceHealth health = heard_.health(now, {}, "no answer", settings_.stale_after);
  if (health.state == SourceState::never_heard)
    health.reason.format("motor %u was never heard: its answers are expected under 0x%03X",
                         static_cast<unsigned>(settings_.joint.id),
                         static_cast<unsigned>(settings_.master_id));
  health.bad += bad_setpoints();
  if (health.state == SourceState::fresh && foreign_.is_shown(now)) health.reason = foreign_.text();
  return health;
}

}  // namespace drover::damiao
