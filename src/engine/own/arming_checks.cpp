// Whether a person may arm the drives where they stand, or let them go: each refusal with its
// reason.
#include "engine/own/arming_checks.h"

#include <cmath>

#include "engine/still.h"

namespace drover::engine {

namespace {

/// A line that cannot be read counts as pressed, and nobody finds a button to turn.
Reason why_estop(const HealthReport& health) {
  const bool lost = health.holds(Cause::line_lost) && !health.holds(Cause::estop);
  const Reason why = lost ? health.text(Cause::line_lost) : Reason();
  return why.empty() ? Reason("the e-stop is pressed") : why;
}

}  // namespace

Reason check_arm(const HealthReport& health, const Latch& latch, bool driven) {
  if (!health.ready) return kJustStarted;
  if (health.estop) return why_estop(health);
  if (!health.estop_known) return health.text(Cause::line_lost);
  if (latch.power_cut()) return "the drives have no power: drover reset";
  if (latch.ran_away()) return "a wheel ran away: drover reset";
  if (health.holds(Cause::foreign)) return health.text(Cause::foreign);
  if (driven) return "the robot is being driven, and holds when it stops";
  if (health.holds(Cause::drive_silent)) return health.text(Cause::drive_silent);
  if (health.holds(Cause::base_stop)) return health.text(Cause::base_stop);
  if (!health.drives_ok) return health.text(Cause::drive_fault);
  return {};
}

Reason check_release(std::span<const AxisSnapshot> axes, const Kinematics& base, bool driven,
                     bool unreachable, bool slopes) {
  if (driven) return "the robot is being driven";
  for (const AxisSnapshot& axis : axes) {
    // On a slope what only brakes creeps, and who lets it go answers for that.
    const double still_mps = slopes ? kTurns_mps : kStands_mps;
    const bool turns = rim_mps(base, std::abs(axis.motion.velocity_radps)) > still_mps;
    if (axis.state == AxisState::running && turns) return "the robot moves";
  }
  if (unreachable) return "the base is silent: nothing reaches it";
  return {};
}

}  // namespace drover::engine
