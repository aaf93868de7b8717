#include "drivers/cia402/twin.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "drivers/cia402/codec.h"
#include "drover/bytes.h"

namespace drover::cia402 {
namespace {

using canopen::DriveState;
using canopen::TwinObject;

constexpr double kTurn_rad = 2 * std::numbers::pi;
constexpr std::uint16_t kHeartbeatLost = 0x8130;
constexpr std::uint16_t kTooHot = 0x4210;
constexpr std::uint32_t kQuickStopWhenAlone = 3;
constexpr std::uint32_t kRamp = 10000;  ///< units of 60FF a second, of a second

/// The objects that any drive has, with the defaults of CiA 402.
constexpr TwinObject kObjects[] = {
    {{canopen::kErrorCode, 0}, canopen::u16(0), true},
    {{canopen::kControlword, 0}, canopen::u16(0)},
    {{canopen::kStatusword, 0}, canopen::u16(0), true},
    {{canopen::kQuickStopOption, 0}, canopen::u16(2)},
    {{canopen::kMode, 0}, canopen::u8(0)},
    {{canopen::kPositionActual, 0}, canopen::u32(0), true},
    {{canopen::kVelocityActual, 0}, canopen::u32(0), true},
    {{canopen::kTorqueActual, 0}, canopen::u16(0), true},
    {{canopen::kTargetVelocity, 0}, canopen::u32(0)},
    {{0x6083, 0}, canopen::u32(kRamp)},
    {{0x6084, 0}, canopen::u32(kRamp)},
    {{0x6085, 0}, canopen::u32(kRamp)},
    {{0x60C2, 1}, canopen::u8(1)},
    {{0x60C2, 2}, canopen::u8(0xFD)},
};
constexpr TwinObject kConsumer{{0x1016, 1}, canopen::u32(0)};
constexpr TwinObject kAbortOption{{0x6007, 0}, canopen::u16(1)};

std::uint16_t statusword(DriveState drive) {
  switch (drive) {
    case DriveState::ready_to_switch_on: return 0x0231;
    case DriveState::switched_on: return 0x0233;
    case DriveState::operation_enabled: return 0x0237;
    case DriveState::quick_stop_active: return 0x0217;
    case DriveState::fault: return 0x0218;
    default: return 0x0250;
  }
}

/// By the patterns of CiA 402-2, table of commands; one transition for a word.
DriveState next_state(DriveState from, std::uint16_t word) {
  if ((word & 0x02U) == 0) return DriveState::switch_on_disabled;
  if ((word & 0x04U) == 0)
    return canopen::is_powered(from) ? DriveState::quick_stop_active
                                     : DriveState::switch_on_disabled;
  if ((word & 0x01U) == 0)
    return from == DriveState::quick_stop_active ? from : DriveState::ready_to_switch_on;
  const bool enable = (word & 0x08U) != 0;
  switch (from) {
    case DriveState::ready_to_switch_on: return DriveState::switched_on;
    case DriveState::switched_on:
    case DriveState::quick_stop_active: return enable ? DriveState::operation_enabled : from;
    case DriveState::operation_enabled: return enable ? from : DriveState::switched_on;
    default: return from;
  }
}

std::uint32_t as_bits(double value) {
  return static_cast<std::uint32_t>(static_cast<std::int32_t>(value));
}

}  // namespace

Cia402Twin::Cia402Twin(const Settings& settings, const TwinSettings& twin)
    : settings_(settings), twin_(twin), node_(settings.node) {}

void Cia402Twin::boot(Time now, TwinFrames& out) {
  booted_ = true;
  drive_ = DriveState::switch_on_disabled;
  controlword_ = emergency_ = 0;
  FixedVector<TwinObject, std::size(kObjects) + 2> objects;
  for (const TwinObject& each : kObjects) static_cast<void>(objects.push_back(each));
  if (settings_.has_consumer) static_cast<void>(objects.push_back(kConsumer));
  if (settings_.has_abort_option) static_cast<void>(objects.push_back(kAbortOption));
  node_.boot({objects.data(), objects.size()}, now, out);
}

void Cia402Twin::set_power(bool on, Time now) {
  if (on == powered_) return;
  powered_ = on;
  booted_ = false;
  boot_at_ = on ? now + twin_.boot_time : kNever;
}

bool Cia402Twin::set_fault(std::string_view name, Time now) {
  if (name.empty()) {
    if (dead_) boot_at_ = now + twin_.boot_time;
    silent_ = dead_ = false;
  } else if (name == "silent") {
    silent_ = true;
  } else if (name == "dead") {
    dead_ = true;
    booted_ = false;
  } else if (name == "over_temperature") {
    fail(kTooHot);
  } else {
    return false;
  }
  return true;
}

void Cia402Twin::fail(std::uint16_t code) {
  drive_ = DriveState::fault;
  emergency_ = code;
  node_.set({canopen::kErrorCode, 0}, code);
}

void Cia402Twin::on_controlword(std::uint16_t word) {
  const bool resets =
      (word & canopen::kFaultReset) != 0 && (controlword_ & canopen::kFaultReset) == 0;
  controlword_ = word;
  if (drive_ != DriveState::fault) {
    drive_ = next_state(drive_, word);
  } else if (resets) {
    drive_ = DriveState::switch_on_disabled;
    node_.set({canopen::kErrorCode, 0}, 0);
  }
}

void Cia402Twin::on_frame(const CanFrame& frame, Time now, TwinFrames& out) {
  if (!booted_) return;
  canopen::TwinNode::Writes writes;
  TwinFrames answers;
  if (!node_.on_frame(frame, now, writes, answers)) booted_ = false;
  for (const TwinObject& each : writes)
    if (each.object.index == canopen::kControlword)
      on_controlword(static_cast<std::uint16_t>(each.value.bits));
  if (!silent_)
    for (const CanFrame& each : answers) static_cast<void>(out.push_back(each));
}

double Cia402Twin::torque(double dt_s) {
  const bool follows =
      drive_ == DriveState::operation_enabled && node_.value({canopen::kMode, 0}) == settings_.mode;
  const double asked = follows ? static_cast<double>(static_cast<std::int32_t>(
                                     node_.value({canopen::kTargetVelocity, 0})))
                               : 0.0;
  const bool faster = std::abs(asked) > std::abs(ramped_);
  const std::uint16_t ramp = !follows ? 0x6085 : (faster ? 0x6083 : 0x6084);
  const double step = node_.value({ramp, 0}) * dt_s;
  const bool at_once = follows && settings_.mode != 3;
  ramped_ = at_once ? asked : ramped_ + std::clamp(asked - ramped_, -step, step);
  const double wanted_radps = ramped_ / settings_.units_per_rps * kTurn_rad / settings_.gear_ratio;
  const double error_radps = wanted_radps - measured_radps_;
  const double limit_Nm = twin_.torque_limit_Nm;
  integral_Nm_ = std::clamp(integral_Nm_ + error_radps * twin_.integrator_gain_Nm_per_rad * dt_s,
                            -limit_Nm, limit_Nm);
  return std::clamp(twin_.velocity_gain_Nms_per_rad * error_radps + integral_Nm_, -limit_Nm,
                    limit_Nm);
}

void Cia402Twin::measure(const Shaft& shaft) {
  const double position_rad = shaft.position_rad * settings_.sign;
  measured_radps_ = shaft.velocity_radps * settings_.sign;
  if (!booted_) power_on_rad_ = position_rad;
  const double motor_turns = (position_rad - power_on_rad_) / kTurn_rad * settings_.gear_ratio;
  const double motor_rps = measured_radps_ / kTurn_rad * settings_.gear_ratio;
  node_.set({canopen::kPositionActual, 0}, as_bits(motor_turns * settings_.counts_per_turn));
  node_.set({canopen::kVelocityActual, 0}, as_bits(motor_rps * settings_.units_per_rps));
  node_.set({canopen::kStatusword, 0}, statusword(drive_));
}

void Cia402Twin::on_tick(Time now, std::span<Shaft> shafts, TwinFrames& out) {
  const double dt_s = last_tick_ == kNever ? 0.0 : to_s(now - last_tick_);
  last_tick_ = now;
  TwinFrames said;
  if (powered_ && !dead_ && !booted_ && (boot_at_ == kNever || now >= boot_at_)) boot(now, said);
  if (booted_ && node_.lost_its_master(now)) {
    if (node_.value(kAbortOption.object) != kQuickStopWhenAlone)
      fail(kHeartbeatLost);
    else if (drive_ == DriveState::operation_enabled)
      drive_ = DriveState::quick_stop_active;
  }
  if (!shafts.empty()) {
    Shaft& shaft = shafts[0];
    measure(shaft);
    shaft.energized = booted_ && canopen::is_powered(drive_);
    if (!shaft.energized) {
      integral_Nm_ = 0;
      ramped_ = measured_radps_ / kTurn_rad * settings_.gear_ratio * settings_.units_per_rps;
    }
    shaft.torque_Nm = shaft.energized ? torque(dt_s) * settings_.sign : 0;
  }
  if (booted_) node_.on_tick(now, said);
  if (booted_ && emergency_ != 0) {
    static_cast<void>(said.push_back(
        make_frame(id_of(Cob::emergency, settings_.node),
                   {low_byte(emergency_), high_byte(emergency_), 0x01, 0, 0, 0, 0, 0})));
    emergency_ = 0;
  }
  if (!silent_)
    for (const CanFrame& each : said) static_cast<void>(out.push_back(each));
}

}  // namespace drover::cia402
