// The receiving half of the driver: frames to measurements, status and health.
#include <algorithm>
#include <cmath>
#include <numbers>

#include "drivers/odrive/driver.h"

namespace drover::odrive {
namespace {

using std::chrono::milliseconds;

double finite_or_absent(float value) {
  return std::isfinite(value) ? static_cast<double>(value) : kAbsent;
}

bool is_master_command(std::uint8_t command, Firmware firmware) {
  switch (command) {
    case cmd::kEstop:
    case cmd::kSetAxisState:
    case cmd::kSetControllerMode:
    case cmd::kSetInputPos:
    case cmd::kSetInputVel:
    case cmd::kSetInputTorque:
    case cmd::kClearErrors: return true;
    case cmd::kRxSdo: return firmware == Firmware::v0_6;
    default: return false;
  }
}

}  // namespace

[[gnu::hot]] void OdriveDriver::on_frame(const CanFrame& frame, Time received, DriverOut& out) {
  if (!belongs_to(frame, settings_.node) || frame.remote) return;
  const std::uint8_t command = command_of(frame.id);
  if (is_master_command(command, settings_.firmware)) {
    on_foreign(frame, received);
    return;
  }
  if (!on_reply(command, frame, received, out)) ++heard_.bad;
}

/// Who only reads is welcome.
void OdriveDriver::on_foreign(const CanFrame& frame, Time received) {
  constexpr std::uint8_t kReads = 0;
  const bool reads =
      command_of(frame.id) == cmd::kRxSdo && frame.len > 0 && frame.data[0] == kReads;
  if (reads || is_of_recipe(frame, recipe_)) return;
  foreign_.on_frame(frame.id, received);
  if (attempts_to_run()) lock(foreign_.text().view());
}

/// False when the frame is not as documented; frames that nobody asked for are fine.
[[gnu::hot]] bool OdriveDriver::on_reply(std::uint8_t command, const CanFrame& frame, Time received,
                                         DriverOut& out) {
  const bool v0_6 = settings_.firmware == Firmware::v0_6;
  bool understood = false;
  switch (command) {
    case cmd::kHeartbeat: understood = on_heartbeat(frame, received, out); break;
    case cmd::kEstimates: understood = on_estimates(frame, received, out); break;
    case cmd::kError:
    case cmd::kControllerError:
      if (v0_6 && command == cmd::kControllerError) return true;
      understood = on_errors(command, frame);
      break;
    case cmd::kEncoderError: understood = on_errors(command, frame); break;
    case cmd::kTxSdo: {
      if (!v0_6) return true;
      const auto value = decode_tx_sdo(frame);
      if (value && phase_ == Phase::configuring) watchdog_.on_reply(*value);
      understood = value.has_value();
      break;
    }
    case cmd::kIq:
      understood = on_effort(frame, v0_6 ? 0 : settings_.torque_constant_Nm_per_A, received);
      break;
    case cmd::kTorques:
      if (!v0_6) return true;
      understood = on_effort(frame, 1, received);
      break;
    case cmd::kTemperature: {
      if (!v0_6) return true;
      const auto pair = decode_floats(frame);
      understood = pair.has_value();
      if (pair)
        report_heard(
            AxisTemperature{axis_, finite_or_absent(pair->first), finite_or_absent(pair->second)},
            received, out);
      break;
    }
    case cmd::kBus: {
      const auto pair = decode_floats(frame);
      understood = pair.has_value();
      if (pair)
        report_heard(
            AxisSupply{axis_, finite_or_absent(pair->first), finite_or_absent(pair->second)},
            received, out);
      break;
    }
    default: return true;
  }
  if (understood) {
    ++heard_.good;
    heard_.last_good = received;
  }
  return understood;
}

bool OdriveDriver::on_heartbeat(const CanFrame& frame, Time received, DriverOut& out) {
  const auto heartbeat = decode_heartbeat(frame, settings_.firmware);
  if (!heartbeat) return false;
  const bool gap =
      heard_.last_alive != kNever && received - heard_.last_alive > settings_.heartbeat_timeout;
  if (heard_.last_alive == kNever || gap) {
    poller_.restart(received);
    if (attempts_to_run()) lock("heartbeat ceased while armed");
    if (gap) errors_ = {};
  }
  const bool failed_before = heartbeat_.failed();
  heard_.last_alive = received;
  heartbeat_ = *heartbeat;
  may_hold_ = heartbeat->state == kStateClosedLoop;
  errors_.axis = heartbeat->error;
  if (heartbeat->failed() && !failed_before) poller_.hurry();
  follow_heartbeat(received);
  report_status(received, true, out);
  return true;
}

[[gnu::hot]] bool OdriveDriver::on_estimates(const CanFrame& frame, Time received, DriverOut& out) {
  const auto pair = decode_floats(frame);
  if (!pair || !std::isfinite(pair->first) || !std::isfinite(pair->second)) return false;
  const double rad_per_turn = 2 * std::numbers::pi * settings_.sign / settings_.gear_ratio;
  AxisMotion motion;
  motion.axis = axis_;
  motion.position_rad = static_cast<double>(pair->first) * rad_per_turn;
  motion.velocity_radps = static_cast<double>(pair->second) * rad_per_turn;
  // A torque is asked for less often than positions come: it may be two polls old.
  const Duration lifetime = std::max<Duration>(2 * settings_.poll_period, settings_.stale_after);
  if (effort_at_ != kNever && received - effort_at_ <= lifetime) motion.effort_Nm = effort_Nm_;
  last_estimates_ = received;
  velocity_radps_ = motion.velocity_radps;
  report_heard(motion, received, out);
  return true;
}

bool OdriveDriver::on_errors(std::uint8_t command, const CanFrame& frame) {
  if (settings_.firmware == Firmware::v0_6) {
    const auto error = decode_error_0_6(frame);
    if (!error) return false;
    errors_.disarm_reason = error->disarm_reason;
    return true;
  }
  if (command == cmd::kError) {
    const auto error = decode_motor_error_0_5(frame);
    if (!error) return false;
    errors_.motor = *error;
    return true;
  }
  const auto error = decode_u32_error_0_5(frame);
  if (!error) return false;
  (command == cmd::kEncoderError ? errors_.encoder : errors_.controller) = *error;
  return true;
}

/// The second value is what is measured: current (A) or torque (Nm) at the motor.
bool OdriveDriver::on_effort(const CanFrame& frame, double Nm_per_unit, Time received) {
  const auto pair = decode_floats(frame);
  if (!pair) return false;
  if (Nm_per_unit == 0) return true;
  effort_Nm_ = finite_or_absent(pair->second) * Nm_per_unit * settings_.gear_ratio * settings_.sign;
  effort_at_ = received;
  return true;
}

StatusInWords OdriveDriver::status(Time now) const {
  StatusInWords status;
  status.axis = axis_;
  if (heard_.last_alive == kNever) {
    status.reason = "no heartbeat yet";
    return status;
  }
  if (silent(now)) {
    status.reason = silent_text("no heartbeat", settings_.heartbeat_timeout);
    return status;
  }
  status.error_code = heartbeat_.error;
  const bool powered = heartbeat_.state != kStateIdle;
  if (foreign_.is_shown(now) && !fault_) {
    status.state = AxisState::fault;
    status.powered = powered;
    status.reason = foreign_.text();
    return status;
  }
  const bool arming = phase_ == Phase::configuring || phase_ == Phase::arming;
  if (!fault_ && !arming && only_unfed()) {
    status.state = AxisState::idle;
    status.reason = "its watchdog ran out while nobody fed it: cleared at the next start";
    return status;
  }
  if (fault_ || (heartbeat_.failed() && !arming)) {
    status.state = AxisState::fault;
    status.powered = powered;
    status.lapsed = only_lapsed(errors_, settings_.firmware);
    // An old reason of disarming is no news unless something is wrong now.
    if (status.error_code == 0) status.error_code = errors_.disarm_reason;
    if (status.error_code == 0) status.error_code = errors_.motor;
    const Reason text = error_text(errors_, settings_.firmware);
    status.reason = joined(fault_ ? lock_reason_ : Reason(), text);
    if (status.reason.empty()) status.reason = "error flag without a code";
    return status;
  }
  status.reason = lock_reason_;
  if (arming) {
    status.state = AxisState::arming;
  } else if (heartbeat_.state == kStateClosedLoop) {
    status.state = AxisState::running;
  } else if (heartbeat_.state == kStateIdle) {
    status.state = AxisState::idle;
  } else if (heartbeat_.state != 0) {
    // Calibrations, homing and the like turn the motor by themselves.
    status.state = AxisState::fault;
    status.powered = powered;
    status.reason.format("drive is in state %u, neither idle nor closed loop",
                         static_cast<unsigned>(heartbeat_.state));
  }
  return status;
}

/// A drive that let go because this gateway was not there, and says nothing else, is well.
bool OdriveDriver::only_unfed() const {
  constexpr std::uint32_t kWatchdog_0_6 = 0x1000000;
  constexpr std::uint32_t kWatchdog_0_5 = 0x800;
  const bool v0_6 = settings_.firmware == Firmware::v0_6;
  const bool parts = heartbeat_.motor_error || heartbeat_.encoder_error ||
                     heartbeat_.controller_error || errors_.motor != 0 || errors_.encoder != 0 ||
                     errors_.controller != 0;
  return heartbeat_.error == (v0_6 ? kWatchdog_0_6 : kWatchdog_0_5) && !parts &&
         heartbeat_.state == kStateIdle;
}

void OdriveDriver::report_status(Time now, bool always, DriverOut& out) {
  const StatusInWords current = status(now);
  if (!told_.is_due(current, always)) return;
  report_heard<AxisStatus>(current, now, out);
}

SourceHealth OdriveDriver::health(Time now) const {
  SourceHealth health = heard_.health(now, {}, "no heartbeat", settings_.heartbeat_timeout);
  if (health.state == SourceState::never_heard)
    health.reason.format("node %u was never heard", static_cast<unsigned>(settings_.node));
  health.bad += bad_setpoints_;
  if (health.state != SourceState::fresh) return health;
  if (last_estimates_ == kNever)
    return stale(health, "heartbeats but no encoder estimates: are they sent cyclically (10 ms)?");
  if (now - last_estimates_ > settings_.stale_after)
    return stale(health, silent_text("no encoder estimates", last_estimates_, now));
  if (foreign_.is_shown(now)) health.reason = foreign_.text();
  return health;
}

}  // namespace drover::odrive
