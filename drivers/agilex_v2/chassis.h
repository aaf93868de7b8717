// What the simulated chassis of both kinds have in common.
#pragma once

#include <array>
#include <span>
#include <string_view>

#include "drivers/agilex_v2/codec.h"
#include "drivers/agilex_v2/servo.h"
#include "drover/twin.h"

namespace drover::agilex_v2 {

inline constexpr double kFull_V = 26.5;
inline constexpr Duration kBoot = std::chrono::milliseconds(500);
/// Without a command for so long it protects itself.
inline constexpr Duration kProtection = std::chrono::milliseconds(500);
inline constexpr Duration kStatePeriod = std::chrono::milliseconds(100);
inline constexpr Duration kMotionPeriod = std::chrono::milliseconds(20);

/// How it tells of an empty battery.
struct LowBattery {
  double battery_V = 0;
  std::uint16_t error = 0;
};

/// "silent", "estop", "exception", "remote", "low_battery", and "" that ends them: what was remote
/// is in standby then, and a brake stays as it was. False: it is none of these.
bool set_chassis_fault(std::string_view name, const LowBattery& low, SystemState& state,
                       bool& silent);

/// Nothing drives these wheels: gears and motors are turned along. `fresh`: the loop at rest.
void let_go(std::array<Servo, 2>& servos, const Servo& fresh, std::span<Shaft> shafts);

}  // namespace drover::agilex_v2
