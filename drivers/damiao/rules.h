// The allow-list of a DAMIAO motor.
#pragma once

#include <array>

#include "drivers/damiao/settings.h"
#include "drover/actuator.h"

namespace drover::damiao {

std::array<FrameRule, 2> rules_of(const Settings& settings);
FrameEffect effect(const CanFrame& frame, const Settings& settings);
/// The registers that this driver reads.
std::span<const std::uint8_t> read_registers();

}  // namespace drover::damiao
