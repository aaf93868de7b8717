// The words for states, as the command line and the status object spell them.
#pragma once

#include <string>
#include <string_view>

#include "drover/snapshot.h"
#include "publish/spelling.h"

namespace drover::publish {

constexpr std::string_view word(NavStatus status) {
  return spelling(status);
}
constexpr std::string_view word(LocateState state) {
  return spelling(state);
}

constexpr std::string_view word(SensorKind kind) {
  switch (kind) {
    case SensorKind::receiver: return "gnss";
    case SensorKind::imu: return "imu";
    case SensorKind::battery: return "battery";
  }
  return "?";
}

constexpr std::string_view word(Role role) {
  switch (role) {
    case Role::steers: return "steers";
    case Role::spare: return "spare";
    case Role::told: return "told";
  }
  return "?";
}

constexpr std::string_view word(SourceState state) {
  switch (state) {
    case SourceState::never_heard: return "never heard";
    case SourceState::fresh: return "fresh";
    case SourceState::stale: return "stale";
  }
  return "?";
}

constexpr std::string_view word(AxisState state) {
  switch (state) {
    case AxisState::unknown: return "unknown";
    case AxisState::idle: return "idle";
    case AxisState::arming: return "arming";
    case AxisState::running: return "running";
    case AxisState::fault: return "fault";
  }
  return "?";
}

constexpr std::string_view word(Owner owner) {
  switch (owner) {
    case Owner::estop: return "estop";
    case Owner::manual: return "manual";
    case Owner::task: return "task";
    case Owner::cmd_vel: return "cmd_vel";
    case Owner::joint_command: return "joint_command";
    case Owner::nobody: return "nobody";
  }
  return "?";
}

constexpr std::string_view word(HoldState state) {
  switch (state) {
    case HoldState::idle: return "not held";
    case HoldState::held: return "held";
    case HoldState::catching: return "being taken back";
    case HoldState::released: return "released";
    case HoldState::lost: return "lost";
  }
  return "?";
}

constexpr std::string_view word(GroupState state) {
  switch (state) {
    case GroupState::following: return "following";
    case GroupState::arming: return "arming";
    case GroupState::holding: return "holding";
    case GroupState::damping: return "damping";
    case GroupState::released: return "released";
    case GroupState::idle: return "idle";
  }
  return "?";
}

constexpr std::string_view word(GroupOwner owner) {
  switch (owner) {
    case GroupOwner::estop: return "estop";
    case GroupOwner::broker: return "broker";
    case GroupOwner::ros2: return "ros2";
    case GroupOwner::nobody: return "nobody";
  }
  return "?";
}

constexpr std::string_view word(Line line) {
  switch (line) {
    case Line::estop: return "estop";
    case Line::bumper: return "bumper";
    case Line::zone_far: return "zone_far";
    case Line::zone_near: return "zone_near";
  }
  return "?";
}

constexpr std::string_view word(Output output) {
  switch (output) {
    case Output::enable_relay: return "enable_relay";
    case Output::lamp: return "lamp";
    case Output::buzzer: return "buzzer";
  }
  return "?";
}

constexpr std::string_view word(BatteryFlow flow) {
  switch (flow) {
    case BatteryFlow::unknown: return "unknown";
    case BatteryFlow::idle: return "idle";
    case BatteryFlow::charging: return "charging";
    case BatteryFlow::discharging: return "discharging";
  }
  return "?";
}

constexpr std::string_view word(FixQuality quality) {
  switch (quality) {
    case FixQuality::none: return "none";
    case FixQuality::single: return "single";
    case FixQuality::dgps: return "dgps";
    case FixQuality::pps: return "pps";
    case FixQuality::rtk_fixed: return "rtk fixed";
    case FixQuality::rtk_float: return "rtk float";
    case FixQuality::estimated: return "estimated";
    case FixQuality::manual: return "manual";
    case FixQuality::simulator: return "simulator";
  }
  return "?";
}

/// "3 more": of reasons that found no room in `why`; empty when all did.
inline std::string more_reasons(const Snapshot& snapshot) {
  return snapshot.why_untold == 0 ? "" : std::to_string(snapshot.why_untold) + " more";
}

}  // namespace drover::publish
