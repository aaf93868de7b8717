// The receiving half of the driver: frames to measurements, status and health.
#include <algorithm>
#include <cmath>
#include <numbers>

#include "drivers/zlac8015d/driver.h"

namespace drover::zlac8015d {
namespace {

using canopen::DriveState;
constexpr double kRpmPerStep = 0.1;  ///< of what it reports, whatever the targets' resolution
constexpr std::uint8_t kEveryNode = 0;

}  // namespace

void Zlac8015dDriver::on_frame(const CanFrame& frame, Time received, DriverOut& out) {
  if (!frame.is_plain()) return;
  const bool commands = std::any_of(rules_.begin(), rules_.end(),
                                    [&](const FrameRule& rule) { return rule.id == frame.id; });
  if (commands) return on_foreign(frame, received);
  const bool own = frame.id == id_of(Cob::emergency, settings_.node) ||
                   frame.id == id_of(Cob::status, settings_.node) ||
                   frame.id == id_of(Cob::velocities, settings_.node) ||
                   frame.id == id_of(Cob::positions, settings_.node) ||
                   frame.id == id_of(Cob::sdo_answer, settings_.node) ||
                   frame.id == id_of(Cob::heartbeat, settings_.node);
  if (!own) return;
  if (on_reply(frame, received, out)) {
    ++heard_.good;
    heard_.last_good = received;
  } else {
    ++heard_.bad;
  }
}

/// Who only reads is welcome.
void Zlac8015dDriver::on_foreign(const CanFrame& frame, Time received) {
  if (frame.id == 0 &&
      (frame.len < 2 || (frame.data[1] != settings_.node && frame.data[1] != kEveryNode)))
    return;
  if (frame.id == id_of(Cob::sdo_request, settings_.node) && frame.data[0] == kSdoRead) return;
  if (is_of_recipe(frame, recipe_)) return;
  foreign_.on_frame(frame.id, received);
  if (attempts_to_run()) lock(foreign_.text().view());
}

/// False when the frame is not as documented.
bool Zlac8015dDriver::on_reply(const CanFrame& frame, Time received, DriverOut& out) {
  if (frame.id == id_of(Cob::heartbeat, settings_.node)) {
    const auto heartbeat = canopen::decode_heartbeat(frame);
    if (!heartbeat) return false;
    on_heartbeat(heartbeat->state, received);
    report_status(received, true, out);
    return true;
  }
  if (frame.id == id_of(Cob::sdo_answer, settings_.node)) {
    if (!canopen::decode_sdo_answer(frame, settings_.node)) return false;
    heard_.last_alive = last_answer_ = received;
    if (link_ == Link::silent) begin_setup(false, received);
    if (link_ == Link::setting_up)
      if (const auto next = setup_.on_frame(frame, received)) out.send(*next);
    return true;
  }
  if (frame.id == id_of(Cob::emergency, settings_.node)) {
    const auto emergency = canopen::decode_emergency(frame, settings_.node);
    if (emergency) emergency_ = emergency->code;
    return emergency.has_value();
  }
  // Process data means what was mapped, and that is known only after the set-up.
  const bool mapped = link_ == Link::starting || link_ == Link::ready;
  if (frame.id == id_of(Cob::status, settings_.node)) {
    const auto status = decode_status(frame, settings_.node);
    if (!status) return false;
    if (mapped) {
      on_status(*status, received);
      report_status(received, false, out);
    }
    return true;
  }
  if (frame.id == id_of(Cob::velocities, settings_.node)) {
    const auto speeds = decode_pair(frame, Cob::velocities, settings_.node);
    if (speeds && mapped) report_motion(*speeds, received, out);
    return speeds.has_value();
  }
  const auto positions = decode_pair(frame, Cob::positions, settings_.node);
  if (positions && mapped) {
    positions_ = *positions;
    positions_known_ = true;
  }
  return positions.has_value();
}

/// A boot-up while it was there: it lost its power, and all that was set.
void Zlac8015dDriver::on_heartbeat(canopen::NodeState state, Time received) {
  heard_.last_alive = received;
  const bool booted = state == canopen::NodeState::boot_up;
  if (booted && attempts_to_run()) lock("the drive was restarted while armed");
  if (booted || link_ == Link::silent) return begin_setup(booted, received);
  const bool operational = state == canopen::NodeState::operational;
  if (link_ == Link::starting && operational) link_ = Link::ready;
  if (link_ == Link::ready && !operational) {
    link_ = Link::starting;
    next_question_ = received;
    if (attempts_to_run()) lock("the node is no longer operational");
  }
}

void Zlac8015dDriver::on_status(const Status& status, Time received) {
  status_ = status;
  last_status_ = received;
  may_hold_ = is_powered(status) || attempts_to_run();
  if (link_ == Link::ready) follow_status(received);
}

void Zlac8015dDriver::report_motion(const Pair& speeds, Time received, DriverOut& out) {
  last_speeds_ = received;
  for (std::size_t wheel = 0; wheel < kWheels; ++wheel) {
    AxisMotion motion;
    motion.axis = axes_[wheel];
    motion.velocity_radps = radps_of(wheel, static_cast<double>(speeds[wheel]) * kRpmPerStep);
    if (positions_known_)
      motion.position_rad = static_cast<double>(positions_[wheel]) * 2 * std::numbers::pi *
                            settings_.sign[wheel] /
                            (settings_.counts_per_turn * settings_.gear_ratio);
    velocity_radps_[wheel] = motion.velocity_radps;
    report_heard(motion, received, out);
  }
}

AxisState Zlac8015dDriver::state_of_drive() const {
  switch (drive_state(status_)) {
    case DriveState::operation_enabled: return AxisState::running;
    case DriveState::fault:
    case DriveState::fault_reaction:
    case DriveState::unknown: return AxisState::fault;
    default: return AxisState::idle;
  }
}

Reason Zlac8015dDriver::fault_text() const {
  if (external_estop(status_)) return "the drive's own emergency stop input is active";
  Reason text = error_text(status_);
  if (text.empty() && emergency_ != 0) text.assign(canopen::emergency_text(emergency_));
  return text;
}

/// Of both wheels: one controlword is for both.
StatusInWords Zlac8015dDriver::status(Time now) const {
  StatusInWords status;
  if (heard_.last_alive == kNever) {
    status.reason = "the node was not heard yet";
    return status;
  }
  if (silent(now)) {
    status.reason = silent_text("nothing heard", settings_.heartbeat_timeout);
    return status;
  }
  if (last_status_ != kNever && lacks_status(settings_.heartbeat_timeout, now)) {
    status.reason = silent_text(no_status_.view(), settings_.heartbeat_timeout);
    return status;
  }
  const bool known = link_ == Link::ready && last_status_ != kNever;
  status.error_code = known ? static_cast<std::uint64_t>(status_.errors[0]) |
                                  static_cast<std::uint64_t>(status_.errors[1]) << 16U
                            : 0;
  status.powered = known && is_powered(status_);
  const Reason text = known ? fault_text() : Reason();
  const bool failed = known && state_of_drive() == AxisState::fault && phase_ != Phase::arming;
  status.stops_all = known && external_estop(status_);
  if (fault_ || foreign_.is_shown(now) || failed || status.stops_all) {
    status.state = AxisState::fault;
    if (!fault_ && foreign_.is_shown(now)) {
      status.reason = foreign_.text();
    } else {
      status.reason = joined(fault_ ? lock_reason_ : Reason(), text);
      if (status.reason.empty()) status.reason = "fault without a code";
    }
    return status;
  }
  if (setup_.failed() && link_ == Link::setting_up) {
    status.state = AxisState::fault;
    status.reason = setup_.reason();
  } else if (phase_ == Phase::arming) {
    status.state = AxisState::arming;
  } else {
    status.state = known ? state_of_drive() : AxisState::idle;
  }
  return status;
}

void Zlac8015dDriver::report_status(Time now, bool always, DriverOut& out) {
  StatusInWords current = status(now);
  if (!told_.is_due(current, always)) return;
  for (const AxisId axis : axes_) {
    current.axis = axis;
    report_heard<AxisStatus>(current, now, out);
  }
}

SourceHealth Zlac8015dDriver::health(Time now) const {
  SourceHealth health = heard_.health(now, {}, "nothing heard", settings_.heartbeat_timeout);
  if (health.state == SourceState::never_heard)
    health.reason.format("node %u was never heard", static_cast<unsigned>(settings_.node));
  health.bad += bad_setpoints_;
  if (health.state != SourceState::fresh) return health;
  if (link_ != Link::ready)
    return stale(health, setup_.failed() ? setup_.reason() : Reason("is being set up"));
  if (now - last_speeds_ > settings_.stale_after)
    return stale(health, "heartbeats but no velocities");
  if (lacks_status(settings_.stale_after, now))
    return stale(health, silent_text(no_status_.view(), last_status_, now));
  if (foreign_.is_shown(now)) health.reason = foreign_.text();
  return health;
}

}  // namespace drover::zlac8015d
