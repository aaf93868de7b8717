// Whether a person may arm the drives where they stand, or let them go: each refusal with its
// reason.
#pragma once

#include <span>

#include "engine/base/kinematics.h"
#include "engine/health/health.h"
#include "engine/health/latch.h"

namespace drover::engine {

/// `driven`: the robot is, or a task is on its way. Empty: they may be armed.
Reason check_arm(const HealthReport& health, const Latch& latch, bool driven);

/// `unreachable`: what is silent may go on by a command that it has. `slopes`: so does the ground.
/// Empty: they may let go.
Reason check_release(std::span<const AxisSnapshot> axes, const Kinematics& base, bool driven,
                     bool unreachable, bool slopes);

}  // namespace drover::engine
