// The simulated node: its dictionary and its states.
#include "drivers/zlac8015d/twin.h"

#include <algorithm>
#include <charconv>
#include <numbers>

namespace drover::zlac8015d {
namespace {

using canopen::DriveState;
using canopen::NodeState;
using canopen::Object;

constexpr std::uint8_t kByEvent = 254;   ///< transmission type; the maker's know 254 and 255 only
constexpr std::uint8_t kMostMapped = 2;  ///< objects in a PDO: of four bytes, as all that is mapped
// "ZLAC8015D CANopen Communication Routine V1.07", object 603F.
constexpr std::uint16_t kOverCurrent = 0x0004;
constexpr std::uint16_t kOverTemperature = 0x0400;
// Of the same: what 6041 shows in each state, which is what 6040 asked for.
constexpr std::uint16_t kNoEstop = 0x0020;

constexpr double kTurn_rad = 2 * std::numbers::pi;
constexpr double kRpmPerRadps = 60 / kTurn_rad;
constexpr double kStepsPerRpm = 10;  ///< of 606C, whatever 2026:05 says of targets

/// Objects of the drive with the maker's defaults (the dictionary of the same routine); those of
/// the PDOs come with the loop below.
constexpr struct {
  Object object;
  canopen::SdoNumber value;
} kDefaults[] = {
    {{kHeartbeatTime, 0}, canopen::u16(0)},
    {{kSilenceTime, 0}, canopen::u16(0)},
    {{kSynchronous, 0}, canopen::u16(0)},
    {{kDriverParameters, 5}, canopen::u16(1)},
    {{canopen::kControlword, 0}, canopen::u16(0)},
    {{canopen::kQuickStopOption, 0}, canopen::u16(5)},
    {{canopen::kMode, 0}, canopen::u8(0)},
    {{canopen::kTargetVelocity, 1}, canopen::i32(0)},
    {{canopen::kTargetVelocity, 2}, canopen::i32(0)},
    {{kAccelerationTime, 1}, canopen::u32(500)},
    {{kAccelerationTime, 2}, canopen::u32(500)},
    {{kDecelerationTime, 1}, canopen::u32(500)},
    {{kDecelerationTime, 2}, canopen::u32(500)},
};

/// Of one wheel.
std::uint16_t statusword(DriveState drive) {
  switch (drive) {
    case DriveState::ready_to_switch_on: return kNoEstop | 0x01;
    case DriveState::switched_on: return kNoEstop | 0x03;
    case DriveState::operation_enabled: return kNoEstop | 0x07;
    case DriveState::quick_stop_active: return 0x07;
    case DriveState::fault: return kNoEstop | 0x08;
    default: return kNoEstop;
  }
}

/// Where a wheel goes from here by a controlword; faults apart.
DriveState next_state(DriveState from, std::uint16_t word) {
  switch (word & 0x0FU) {
    case canopen::kShutdown: return DriveState::ready_to_switch_on;
    case canopen::kSwitchOn:
      return from == DriveState::switch_on_disabled ? from : DriveState::switched_on;
    case canopen::kEnableOperation: {
      const bool may = from == DriveState::switched_on || from == DriveState::quick_stop_active;
      return may ? DriveState::operation_enabled : from;
    }
    case canopen::kQuickStop:
      return from == DriveState::operation_enabled ? DriveState::quick_stop_active : from;
    default: return DriveState::switch_on_disabled;
  }
}

}  // namespace

Zlac8015dTwin::Zlac8015dTwin(const Settings& settings, const TwinSettings& twin)
    : settings_(settings), twin_(twin) {}

void Zlac8015dTwin::boot(Time now, TwinFrames& out) {
  booted_ = true;
  state_ = NodeState::pre_operational;
  controlword_ = 0;
  wheels_ = {};
  dictionary_.clear();
  const auto add = [this](Object object, canopen::SdoNumber value) {
    static_cast<void>(dictionary_.push_back({object, value}));
  };
  for (const auto& each : kDefaults) add(each.object, each.value);
  for (std::uint16_t pdo = 0; pdo < 4; ++pdo) {
    for (const bool sends : {false, true}) {
      const auto communication = static_cast<std::uint16_t>((sends ? 0x1800U : 0x1400U) + pdo);
      const auto mapping = static_cast<std::uint16_t>((sends ? 0x1A00U : 0x1600U) + pdo);
      add({communication, 1}, canopen::u32(kInvalidPdo));
      add({communication, 2}, canopen::u8(kByEvent));
      if (sends) add({communication, 5}, canopen::u16(0));
      for (std::uint8_t sub = 0; sub <= kMostMapped; ++sub)
        add({mapping, sub}, sub == 0 ? canopen::u8(0) : canopen::u32(0));
    }
  }
  last_fed_ = next_heartbeat_ = now;
  next_pdo_.fill(now);
  send(canopen::encode_heartbeat(settings_.node, NodeState::boot_up), out);
}

void Zlac8015dTwin::set_power(bool on, Time now) {
  if (on == powered_) return;
  powered_ = on;
  booted_ = false;
  boot_at_ = on ? now + twin_.boot_time : kNever;
}

bool Zlac8015dTwin::set_fault(std::string_view name, Time) {
  constexpr std::string_view kError = "error:";
  if (name.empty()) {
    silent_ = wheels_[kRight].torn = false;
  } else if (name == "silent") {
    silent_ = true;
  } else if (name == "over_temperature") {
    fail(kLeft, kOverTemperature);
  } else if (name == "over_current") {
    fail(kRight, kOverCurrent);
  } else if (name == "no_torque") {
    wheels_[kRight].torn = true;
  } else if (name == "leaves_enabled") {
    wheels_[kRight].drive = DriveState::switch_on_disabled;
  } else if (name.substr(0, kError.size()) == kError) {
    std::uint32_t bits = 0;
    const char* const end = name.data() + name.size();
    const auto result = std::from_chars(name.data() + kError.size(), end, bits, 16);
    if (result.ec != std::errc() || result.ptr != end || bits == 0) return false;
    for (std::size_t wheel = 0; wheel < kWheels; ++wheel)
      fail(wheel, static_cast<std::uint16_t>(bits >> 16U * wheel));
  } else {
    return false;
  }
  return true;
}

void Zlac8015dTwin::fail(std::size_t wheel, std::uint16_t error) {
  if (error == 0) return;
  wheels_[wheel].error |= error;
  wheels_[wheel].drive = DriveState::fault;
}

void Zlac8015dTwin::send(const CanFrame& frame, TwinFrames& out) const {
  if (!silent_) static_cast<void>(out.push_back(frame));
}

const Zlac8015dTwin::Entry* Zlac8015dTwin::find(Object object) const {
  const auto* const it = std::find_if(dictionary_.begin(), dictionary_.end(),
                                      [&](const Entry& each) { return each.object == object; });
  return it == dictionary_.end() ? nullptr : it;
}

std::uint32_t Zlac8015dTwin::stored(std::uint16_t index, std::uint8_t sub) const {
  const Entry* const entry = find({index, sub});
  return entry == nullptr ? 0 : entry->value.bits;
}

/// No more than its dictionary has room for.
std::uint8_t Zlac8015dTwin::mapped_count(std::uint16_t mapping) const {
  return static_cast<std::uint8_t>(std::min<std::uint32_t>(stored(mapping, 0), kMostMapped));
}

std::uint32_t Zlac8015dTwin::read(Object object) const {
  const std::size_t wheel = object.sub == 2 ? kRight : kLeft;
  const Wheel& one = wheels_[wheel];
  const double turns = one.position_rad / kTurn_rad * settings_.gear_ratio;
  const double rpm = one.measured_radps * kRpmPerRadps * settings_.gear_ratio;
  const auto signed_bits = [](double value) {
    return static_cast<std::uint32_t>(static_cast<std::int32_t>(value));
  };
  switch (object.index) {
    case canopen::kStatusword:
      return statusword(wheels_[kLeft].drive) | statusword(wheels_[kRight].drive) * 0x10000U;
    case canopen::kErrorCode: return wheels_[kLeft].error | wheels_[kRight].error * 0x10000U;
    case canopen::kVelocityActual: return signed_bits(rpm * kStepsPerRpm);
    case canopen::kPositionActual: return signed_bits(turns * settings_.counts_per_turn);
    default: return stored(object.index, object.sub);
  }
}

void Zlac8015dTwin::write(Object object, std::uint32_t bits, Time now) {
  for (Entry& entry : dictionary_)
    if (entry.object == object) entry.value.bits = bits;
  if (object.index == canopen::kControlword) on_controlword(static_cast<std::uint16_t>(bits));
  if (object.index != canopen::kTargetVelocity) return;
  wheels_[object.sub == 2 ? kRight : kLeft].target = static_cast<std::int32_t>(bits);
  last_fed_ = now;
}

/// One word is for both wheels.
void Zlac8015dTwin::on_controlword(std::uint16_t word) {
  const bool resets =
      (word & canopen::kFaultReset) != 0 && (controlword_ & canopen::kFaultReset) == 0;
  controlword_ = word;
  for (Wheel& wheel : wheels_) {
    if (wheel.drive != DriveState::fault) {
      wheel.drive = next_state(wheel.drive, word);
    } else if (resets) {
      wheel.error = 0;
      wheel.drive = DriveState::switch_on_disabled;
    }
  }
}

void Zlac8015dTwin::on_nmt(std::uint8_t command) {
  switch (static_cast<canopen::NmtCommand>(command)) {
    case canopen::NmtCommand::operational: state_ = NodeState::operational; break;
    case canopen::NmtCommand::stop: state_ = NodeState::stopped; break;
    case canopen::NmtCommand::pre_operational: state_ = NodeState::pre_operational; break;
    case canopen::NmtCommand::reset_node:
    case canopen::NmtCommand::reset_communication: booted_ = false; break;
  }
}

/// The worse of two readings, unless it is said to hold: both wheels are let go of, without an
/// error.
void Zlac8015dTwin::time_out() {
  for (Wheel& wheel : wheels_) {
    wheel.target = 0;
    if (!settings_.silence_holds && wheel.drive != DriveState::fault)
      wheel.drive = DriveState::switch_on_disabled;
  }
}

void Zlac8015dTwin::on_tick(Time now, std::span<Shaft> shafts, TwinFrames& out) {
  const double dt_s = last_tick_ == kNever ? 0.0 : to_s(now - last_tick_);
  last_tick_ = now;
  if (powered_ && !booted_ && now >= (boot_at_ == kNever ? now : boot_at_)) boot(now, out);
  const auto silence = std::chrono::milliseconds(stored(kSilenceTime, 0));
  if (booted_ && silence.count() > 0 && now - last_fed_ > silence) time_out();
  move(dt_s, shafts);
  if (booted_) send_cyclic(now, out);
}

}  // namespace drover::zlac8015d
