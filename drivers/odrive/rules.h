// What may leave towards an ODrive axis, and what each frame does.
#pragma once

#include "drivers/odrive/settings.h"
#include "drover/driver.h"

namespace drover::odrive {

using RuleList = FixedVector<FrameRule, 16>;

/// Exactly the ids and lengths that the driver sends with these settings.
RuleList rules_of(const Settings& settings);
/// Judges the payload too: another axis state, another mode, any other parameter is forbidden.
FrameEffect effect(const CanFrame& frame, const Settings& settings);

/// The values asked for, one after the other.
std::span<const std::uint8_t> polled_commands(Firmware firmware);
/// Those of them that tell why a drive stopped.
std::span<const std::uint8_t> error_commands(Firmware firmware);

}  // namespace drover::odrive
