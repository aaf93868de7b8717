// The simulated drive's protocol side: frames, states, watchdog, power.
#include "drivers/odrive/twin.h"

#include <bit>
#include <charconv>
#include <limits>
#include <numbers>

#include "drover/bytes.h"

namespace drover::odrive {
namespace {

using std::chrono::milliseconds;
constexpr Duration kHeartbeatPeriod = milliseconds(100);
constexpr Duration kEstimatesPeriod = milliseconds(10);
constexpr std::uint32_t kWatchdog_0_5 = 0x800;
constexpr std::uint32_t kWatchdog_0_6 = 0x01000000;
constexpr std::uint32_t kEstop_0_5 = 0x4000;
constexpr std::uint32_t kEstop_0_6 = 0x02000000;
constexpr std::uint8_t kDisarmed = 3;
constexpr std::uint8_t kInvalidState = 13;

}  // namespace

OdriveTwin::OdriveTwin(const Settings& settings, const TwinSettings& twin)
    : settings_(settings), twin_(twin), motor_degC_(twin.ambient_degC) {}

void OdriveTwin::boot(Time now) {
  booted_ = true;
  state_ = kStateIdle;
  procedure_result_ = 0;
  error_ = 0;
  disarm_reason_ = 0;
  control_mode_ = 3;
  input_mode_ = 1;
  input_turnps_ = 0;
  integral_Nm_ = 0;
  position_known_ = false;
  watchdog_s_ = twin_.saved_watchdog_s.value_or(
      settings_.sets_watchdog() ? 0.0 : settings_.watchdog_timeout_s);
  watchdog_on_ = watchdog_s_ > 0;
  feed(now);
  // Drives of one bus do not start in step.
  const Duration phase = std::chrono::microseconds(700) * (settings_.node % 14);
  next_heartbeat_ = now + phase;
  next_estimates_ = now + phase;
}

void OdriveTwin::set_power(bool on, Time now) {
  if (on == powered_) return;
  powered_ = on;
  booted_ = false;
  boot_at_ = on ? now + twin_.boot_time : kNever;
  state_ = kStateIdle;
  torque_Nm_ = 0;
  integral_Nm_ = 0;
}

void OdriveTwin::disarm(std::uint32_t error) {
  error_ |= error;
  if (state_ == kStateClosedLoop) {
    disarm_reason_ = error;
    procedure_result_ = kDisarmed;
  }
  state_ = kStateIdle;
  integral_Nm_ = 0;
}

bool OdriveTwin::set_fault(std::string_view name, Time) {
  constexpr std::string_view kError = "error:";
  if (name.empty()) {
    over_temperature_ = stuck_ = wrong_sign_ = silent_ = false;
  } else if (name == "over_temperature") {
    over_temperature_ = true;
  } else if (name == "stuck_encoder") {
    stuck_ = true;
  } else if (name == "wrong_sign") {
    wrong_sign_ = true;
  } else if (name == "silent") {
    silent_ = true;
  } else if (name == "leaves_closed_loop") {
    disarm(0);
  } else if (name.substr(0, kError.size()) == kError) {
    std::uint32_t bits = 0;
    const char* const end = name.data() + name.size();
    const auto result = std::from_chars(name.data() + kError.size(), end, bits, 16);
    if (result.ec != std::errc() || result.ptr != end || bits == 0) return false;
    disarm(bits);
  } else {
    return false;
  }
  return true;
}

void OdriveTwin::send(const CanFrame& frame, TwinFrames& out) const {
  if (!silent_) static_cast<void>(out.push_back(frame));
}

Heartbeat OdriveTwin::heartbeat() const {
  Heartbeat heartbeat;
  heartbeat.error = error_;
  heartbeat.state = state_;
  if (v0_6()) {
    heartbeat.procedure_result = procedure_result_;
  } else {
    heartbeat.motor_error = (error_ & 0x40U) != 0;
    heartbeat.encoder_error = (error_ & 0x100U) != 0;
    heartbeat.controller_error = (error_ & 0x200U) != 0;
  }
  return heartbeat;
}

void OdriveTwin::on_frame(const CanFrame& frame, Time now, TwinFrames& out) {
  if (!booted_ || !belongs_to(frame, settings_.node)) return;
  // 0.5 counts every frame to the node, also a question: a gateway that only polls keeps a
  // runaway axis alive. Of 0.6 only set points are known to count.
  if (!v0_6()) feed(now);
  if (frame.remote) {
    answer(command_of(frame.id), out);
  } else {
    on_data(frame, now, out);
  }
}

void OdriveTwin::on_data(const CanFrame& frame, Time now, TwinFrames& out) {
  switch (command_of(frame.id)) {
    case cmd::kEstop: disarm(v0_6() ? kEstop_0_6 : kEstop_0_5); break;
    case cmd::kRxSdo:
      if (v0_6()) on_sdo(frame, out);
      break;
    case cmd::kSetAxisState:
      if (frame.len < 4) break;
      if (read_u32(frame, 0) == kStateIdle) {
        state_ = kStateIdle;
        procedure_result_ = 0;
      } else if (read_u32(frame, 0) == kStateClosedLoop && state_ != kStateClosedLoop) {
        if (error_ != 0) {
          procedure_result_ = kInvalidState;
          break;
        }
        state_ = kStateClosedLoop;
        procedure_result_ = 0;
        integral_Nm_ = 0;
        feed(now);
      }
      break;
    case cmd::kSetControllerMode:
      if (frame.len != 8) break;
      control_mode_ = read_u32(frame, 0);
      input_mode_ = read_u32(frame, 4);
      break;
    case cmd::kSetInputVel:
      if (frame.len != 8) break;
      input_turnps_ = static_cast<double>(read_float(frame, 0));
      feed(now);
      break;
    case cmd::kClearErrors:
      error_ = 0;
      disarm_reason_ = 0;
      procedure_result_ = 0;
      feed(now);
      break;
    default:
      if (frame.len == 0) answer(command_of(frame.id), out);
  }
}

void OdriveTwin::on_sdo(const CanFrame& frame, TwinFrames& out) {
  if (frame.len < 4) return;
  const auto endpoint = load_le<std::uint16_t>(frame.data, 1);
  const bool enable = endpoint == settings_.watchdog_enable_endpoint && endpoint != 0;
  const bool timeout = endpoint == settings_.watchdog_timeout_endpoint && endpoint != 0;
  if (!enable && !timeout) return;
  if (frame.data[0] == 1) {
    if (enable && frame.len >= 5) watchdog_on_ = frame.data[4] != 0;
    if (timeout && frame.len == 8) watchdog_s_ = static_cast<double>(read_float(frame, 4));
    return;
  }
  CanFrame reply = frame;
  reply.id = frame_id(settings_.node, cmd::kTxSdo);
  reply.data[0] = 0;
  const std::uint32_t raw = enable ? (watchdog_on_ ? 1U : 0U)
                                   : std::bit_cast<std::uint32_t>(static_cast<float>(watchdog_s_));
  reply.len = enable ? 5 : 8;
  for (std::uint8_t i = 4; i < reply.len; ++i)
    reply.data[i] = static_cast<std::uint8_t>(raw >> (8U * (i - 4U)));
  send(reply, out);
}

void OdriveTwin::answer(std::uint8_t command, TwinFrames& out) const {
  const std::uint8_t node = settings_.node;
  const double per_joint_turn = settings_.gear_ratio / (2 * std::numbers::pi);
  const double motor_Nm = torque_Nm_ / settings_.gear_ratio;
  const double constant =
      settings_.torque_constant_Nm_per_A > 0 ? settings_.torque_constant_Nm_per_A : 0.1;
  const auto floats = [&](double first, double second) {
    send(encode_floats(node, command, static_cast<float>(first), static_cast<float>(second)), out);
  };
  switch (command) {
    case cmd::kHeartbeat: send(encode_heartbeat(node, heartbeat(), settings_.firmware), out); break;
    case cmd::kError:
      if (v0_6()) {
        send(encode_words(node, command, error_, disarm_reason_), out);
      } else {
        send(encode_words(node, command, over_temperature_ ? 0x20000U : 0U, 0), out);
      }
      break;
    case cmd::kEncoderError:
    case cmd::kControllerError:
      if (!v0_6()) send(encode_words(node, command, 0, 0), out);
      break;
    case cmd::kEstimates:
      floats(measured_rad_ * per_joint_turn, measured_radps_ * per_joint_turn);
      break;
    case cmd::kIq: floats(motor_Nm / constant, motor_Nm / constant); break;
    case cmd::kTemperature:
      if (v0_6())
        floats(twin_.ambient_degC + 0.5 * (motor_degC_ - twin_.ambient_degC),
               twin_.has_thermistor ? motor_degC_ : std::numeric_limits<double>::quiet_NaN());
      break;
    case cmd::kBus: floats(twin_.bus_V, electrical_W_ / twin_.bus_V); break;
    case cmd::kTorques:
      if (v0_6()) floats(motor_Nm, motor_Nm);
      break;
    default: break;
  }
}

void OdriveTwin::send_cyclic(Time now, TwinFrames& out) {
  // A plant that was held up catches up without a burst.
  if (now - next_heartbeat_ >= 2 * kHeartbeatPeriod) next_heartbeat_ = now;
  if (now - next_estimates_ >= 2 * kEstimatesPeriod) next_estimates_ = now;
  if (now >= next_heartbeat_) {
    next_heartbeat_ += kHeartbeatPeriod;
    answer(cmd::kHeartbeat, out);
  }
  if (now >= next_estimates_) {
    next_estimates_ += kEstimatesPeriod;
    answer(cmd::kEstimates, out);
  }
}

void OdriveTwin::on_tick(Time now, std::span<Shaft> shafts, TwinFrames& out) {
  Shaft& shaft = shafts.front();
  const double dt_s = last_tick_ == kNever ? 0.0 : to_s(now - last_tick_);
  last_tick_ = now;
  if (powered_ && !booted_ && now >= (boot_at_ == kNever ? now : boot_at_)) boot(now);
  if (booted_ && watchdog_on_ && to_s(now - last_fed_) > watchdog_s_) {
    const std::uint32_t expired = v0_6() ? kWatchdog_0_6 : kWatchdog_0_5;
    if ((error_ & expired) == 0) disarm(expired);
  }
  move(dt_s, shaft);
  heat(dt_s, shaft);
  if (booted_) send_cyclic(now, out);
}

}  // namespace drover::odrive
