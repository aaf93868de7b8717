// The receiving half of the driver: frames to measurements, status and health.
#include <algorithm>
#include <numbers>

#include "drivers/cia402/driver.h"
#include "drover/bytes.h"

namespace drover::cia402 {
namespace {

constexpr std::uint8_t kEveryNode = 0;
constexpr std::uint8_t kSdoRead = 0x40;

AxisState state_of(canopen::DriveState state) {
  switch (state) {
    case canopen::DriveState::operation_enabled: return AxisState::running;
    case canopen::DriveState::fault:
    case canopen::DriveState::fault_reaction:
    case canopen::DriveState::unknown: return AxisState::fault;
    default: return AxisState::idle;
  }
}

}  // namespace

void Cia402Driver::on_frame(const CanFrame& frame, Time received, DriverOut& out) {
  if (!frame.is_plain()) return;
  const std::uint8_t node = settings_.node;
  if (frame.id == 0 || frame.id == id_of(Cob::command, node) ||
      frame.id == id_of(Cob::sdo_request, node))
    return on_foreign(frame, received);
  constexpr Cob kOwn[] = {Cob::emergency, Cob::status, Cob::position, Cob::sdo_answer,
                          Cob::heartbeat};
  if (std::none_of(std::begin(kOwn), std::end(kOwn),
                   [&](Cob cob) { return frame.id == id_of(cob, node); }))
    return;
  if (on_reply(frame, received, out)) {
    ++heard_.good;
    heard_.last_good = received;
  } else {
    ++heard_.bad;
  }
}

/// Who only reads is welcome.
void Cia402Driver::on_foreign(const CanFrame& frame, Time received) {
  if (frame.id == 0 &&
      (frame.len < 2 || (frame.data[1] != settings_.node && frame.data[1] != kEveryNode)))
    return;
  if (frame.id == id_of(Cob::sdo_request, settings_.node) && frame.data[0] == kSdoRead) return;
  if (is_of_recipe(frame, recipe_)) return;
  foreign_.on_frame(frame.id, received);
  if (attempts_to_run()) lock(foreign_.text().view());
}

/// False when the frame is not as documented.
bool Cia402Driver::on_reply(const CanFrame& frame, Time received, DriverOut& out) {
  const std::uint8_t node = settings_.node;
  if (frame.id == id_of(Cob::sdo_answer, node)) return on_sdo_answer(frame, received, out);
  if (frame.id == id_of(Cob::heartbeat, node)) {
    const auto heartbeat = canopen::decode_heartbeat(frame);
    if (!heartbeat) return false;
    on_heartbeat(heartbeat->state, received);
    report_status(received, true, out);
    return true;
  }
  if (frame.id == id_of(Cob::emergency, node)) {
    const auto emergency = canopen::decode_emergency(frame, node);
    if (emergency) error_ = emergency->code;
    return emergency.has_value();
  }
  // Process data means what was mapped, and that is known only after the set-up.
  const bool mapped = link_ == Link::starting || link_ == Link::ready;
  if (const auto status = decode_status(frame, node)) {
    if (mapped) on_status(*status, received, out);
    return true;
  }
  const auto position = decode_position(frame, node, settings_.torque());
  if (position && mapped) position_ = position;
  return position.has_value();
}

bool Cia402Driver::on_sdo_answer(const CanFrame& frame, Time received, DriverOut& out) {
  const auto answer = canopen::decode_sdo_answer(frame, settings_.node);
  if (!answer) return false;
  heard_.last_alive = received;
  if (link_ == Link::silent) begin_setup(received);
  if (link_ == Link::setting_up)
    if (const auto next = setup_.on_frame(frame, received)) out.send(*next);
  const bool error = answer->kind == canopen::SdoAnswer::Kind::value &&
                     answer->object == canopen::Object{canopen::kErrorCode, 0} &&
                     answer->data.size() == 2;
  if (link_ == Link::ready && error)
    error_ = static_cast<std::uint16_t>(answer->data[0] | answer->data[1] << 8U);
  return true;
}

/// A boot-up while it was there: it lost its power, and all that was set.
void Cia402Driver::on_heartbeat(canopen::NodeState state, Time received) {
  heard_.last_alive = received;
  const bool booted = state == canopen::NodeState::boot_up;
  if (booted && attempts_to_run()) lock("the drive was restarted while armed");
  if (booted) may_hold_ = was_held_ = held_ = false;
  if (booted || link_ == Link::silent) return begin_setup(received);
  const bool operational = state == canopen::NodeState::operational;
  if (link_ == Link::starting && operational) link_ = Link::ready;
  if (link_ == Link::ready && !operational) {
    link_ = Link::starting;
    next_question_ = received;
    if (attempts_to_run()) lock("the node is no longer operational");
  }
}

void Cia402Driver::on_status(const Status& status, Time received, DriverOut& out) {
  status_ = status;
  last_status_ = received;
  may_hold_ = status.state() == canopen::DriveState::operation_enabled;
  was_held_ = false;
  if (link_ == Link::ready) follow_status(received);
  report_status(received, false, out);
  AxisMotion motion;
  motion.axis = axis_;
  motion.velocity_radps = velocity_radps_ = radps_of(status.velocity);
  if (position_) {
    motion.position_rad = position_->counts * 2 * std::numbers::pi * settings_.sign /
                          (settings_.counts_per_turn * settings_.gear_ratio);
    if (settings_.torque())
      motion.effort_Nm = position_->torque_permille / 1000.0 * settings_.rated_torque_Nm *
                         settings_.gear_ratio * settings_.sign;
  }
  report_heard(motion, received, out);
}

StatusInWords Cia402Driver::status(Time now) const {
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
  const AxisState told = known ? state_of(status_.state()) : AxisState::idle;
  status.error_code = known ? error_ : 0U;
  status.powered = known && canopen::is_powered(status_.state());
  const bool failed = told == AxisState::fault && phase_ != Phase::arming;
  if (!fault_ && foreign_.is_shown(now)) {
    status.state = AxisState::fault;
    status.reason = foreign_.text();
  } else if (fault_ || failed) {
    Reason why;
    if (known && error_ != 0) why.assign(canopen::emergency_text(error_));
    status.state = AxisState::fault;
    status.reason = joined(fault_ ? lock_reason_ : Reason(), why);
    if (status.reason.empty()) status.reason = "fault without a code";
  } else if (setup_.failed() && link_ == Link::setting_up) {
    status.state = AxisState::fault;
    status.reason = setup_.reason();
  } else {
    status.state = phase_ == Phase::arming ? AxisState::arming : told;
  }
  return status;
}

void Cia402Driver::report_status(Time now, bool always, DriverOut& out) {
  StatusInWords current = status(now);
  current.axis = axis_;
  if (told_.is_due(current, always)) report_heard<AxisStatus>(current, now, out);
}

SourceHealth Cia402Driver::health(Time now) const {
  SourceHealth health = heard_.health(now, {}, "nothing heard", settings_.heartbeat_timeout);
  if (health.state == SourceState::never_heard)
    health.reason.format("node %u was never heard", static_cast<unsigned>(settings_.node));
  health.bad += bad_setpoints_;
  if (health.state != SourceState::fresh) return health;
  if (link_ != Link::ready)
    return stale(health, setup_.failed() ? setup_.reason() : Reason("is being set up"));
  if (lacks_status(settings_.stale_after, now))
    return stale(health, silent_text(no_status_.view(), last_status_, now));
  if (foreign_.is_shown(now)) health.reason = foreign_.text();
  return health;
}

}  // namespace drover::cia402
