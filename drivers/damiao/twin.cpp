#include "drivers/damiao/twin.h"

#include <algorithm>
#include <array>
#include <bit>
#include <utility>

#include "drover/bytes.h"

namespace drover::damiao {
namespace {

constexpr std::array kOnce{
    std::pair{std::string_view("over_current"), MotorStatus::over_current},
    std::pair{std::string_view("over_voltage"), MotorStatus::over_voltage},
    std::pair{std::string_view("under_voltage"), MotorStatus::under_voltage},
    std::pair{std::string_view("overload"), MotorStatus::overload},
    std::pair{std::string_view("lost_comm"), MotorStatus::lost_comm},
};

}  // namespace

DamiaoTwin::DamiaoTwin(const Settings& settings, const TwinSettings& twin)
    : settings_(settings), twin_(twin), motor_(settings.joint, twin) {}

void DamiaoTwin::boot(Time now) {
  booted_ = true;
  status_ = MotorStatus::disabled;
  mode_ = twin_.saved_mode;
  timeout_raw_ = twin_.saved_timeout_ms * kTimeoutUnitsPerMs;
  command_ = {};
  last_fed_ = now;
}

void DamiaoTwin::set_power(bool on, Time now) {
  if (on == powered_) return;
  powered_ = on;
  booted_ = false;
  boot_at_ = on ? now + twin_.boot_time : kNever;
  status_ = MotorStatus::disabled;
  motor_.told.torque_Nm = 0;
}

void DamiaoTwin::fail(MotorStatus status) {
  status_ = status;
}

bool DamiaoTwin::set_fault(std::string_view name, Time) {
  const auto* const once = std::find_if(kOnce.begin(), kOnce.end(),
                                        [&](const auto& each) { return each.first == name; });
  if (once != kOnce.end()) {
    fail(once->second);
  } else if (name.empty()) {
    motor_.mend();
    hot_ = silent_ = false;
  } else if (name == "over_temperature") {
    hot_ = true;
    fail(MotorStatus::rotor_hot);
  } else if (name == "silent") {
    silent_ = true;
  } else if (name == "leaves_closed_loop") {
    fail(MotorStatus::disabled);
  } else {
    return motor_.set_fault(name);
  }
  return true;
}

void DamiaoTwin::send(const CanFrame& frame, TwinFrames& out) const {
  if (!silent_) static_cast<void>(out.push_back(frame));
}

void DamiaoTwin::send_feedback(TwinFrames& out) const {
  Feedback feedback;
  feedback.status = static_cast<std::uint8_t>(status_);
  feedback.motion = motor_.told;
  feedback.mos_degC = twin_.ambient_degC + 5;
  feedback.rotor_degC = hot_ ? 125 : twin_.ambient_degC + 3;
  send(encode_feedback(settings_.master_id, settings_.joint.id, feedback, twin_.ranges), out);
}

void DamiaoTwin::on_frame(const CanFrame& frame, Time now, TwinFrames& out) {
  if (!booted_ || !frame.is_plain()) return;
  if (frame.id == kRequestId) return on_request(frame, out);
  if (const auto special = decode_special(frame, settings_.joint.id)) {
    on_special(*special, now);
  } else if (const auto raw = decode_mit_raw(frame, settings_.joint.id)) {
    last_fed_ = now;
    if (mode_ == kMitMode) command_ = scale(*raw, twin_.ranges);
  } else {
    return;
  }
  send_feedback(out);
}

void DamiaoTwin::on_special(Special special, Time now) {
  switch (special) {
    case Special::clear_error:
      // What is still so comes back at once.
      if (status_ != MotorStatus::enabled)
        status_ = hot_ ? MotorStatus::rotor_hot : MotorStatus::disabled;
      break;
    case Special::enable:
      if (status_ == MotorStatus::disabled) status_ = MotorStatus::enabled;
      last_fed_ = now;
      break;
    case Special::disable:
      if (status_ == MotorStatus::enabled) status_ = MotorStatus::disabled;
      break;
    case Special::set_zero: break;  // nobody is to send it
  }
}

void DamiaoTwin::on_request(const CanFrame& frame, TwinFrames& out) {
  if (frame.len != 8 || frame.data[0] != settings_.joint.id || frame.data[1] != 0) return;
  // That this feeds its time-out is nowhere said.
  if (frame.data[2] == static_cast<std::uint8_t>(Verb::feedback)) return send_feedback(out);
  on_register(frame, out);
}

void DamiaoTwin::on_register(const CanFrame& frame, TwinFrames& out) {
  const auto request = decode_reply(frame, settings_.joint.id);
  if (!request || request->verb == Verb::store) return;
  if (request->verb == Verb::write && request->rid == reg::kTimeout) timeout_raw_ = request->raw;
  if (request->verb == Verb::write && request->rid == reg::kMode) mode_ = request->raw;
  RegisterReply reply = *request;
  reply.raw = read(request->rid);
  send(encode_reply(settings_.master_id, settings_.joint.id, reply), out);
}

std::uint32_t DamiaoTwin::read(std::uint8_t rid) const {
  const auto bits = [](double value) {
    return std::bit_cast<std::uint32_t>(static_cast<float>(value));
  };
  switch (rid) {
    case reg::kTimeout: return timeout_raw_;
    case reg::kMode: return mode_;
    case reg::kPMax: return bits(twin_.ranges.p_max_rad);
    case reg::kVMax: return bits(twin_.ranges.v_max_radps);
    case reg::kTMax: return bits(twin_.ranges.t_max_Nm);
    default: return 0;
  }
}

void DamiaoTwin::on_tick(Time now, std::span<Shaft> shafts, TwinFrames&) {
  const double dt_s = last_tick_ == kNever ? 0.0 : to_s(now - last_tick_);
  last_tick_ = now;
  if (powered_ && !booted_ && now >= (boot_at_ == kNever ? now : boot_at_)) boot(now);
  const double fed_ms = to_s(now - last_fed_) * 1000;
  if (booted_ && status_ == MotorStatus::enabled && timeout_raw_ > 0 &&
      fed_ms * kTimeoutUnitsPerMs > timeout_raw_)
    fail(MotorStatus::lost_comm);
  motor_.move(dt_s, booted_ && status_ == MotorStatus::enabled, command_, shafts.front());
}

}  // namespace drover::damiao
