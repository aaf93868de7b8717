// The engine's part of holding: what a person asks, what is remembered, steep ground.
#include <cmath>

#include "drover/angle.h"
#include "engine/engine_impl.h"
#include "engine/still.h"

namespace drover::engine {
namespace {

/// A wheel over a stone is no slope.
constexpr Duration kSteepFor = std::chrono::milliseconds(300);
/// An inertial sensor that is silent for a moment leaves the ground as it was.
constexpr Duration kTiltUnknownFor = std::chrono::seconds(1);

}  // namespace

void Engine::recall(const Remembered& remembered, Time now) {
  Impl& e = *impl_;
  e.latch.recall(remembered);
  if (!remembered.stop.empty())
    e.events.notice(now, Notice::Level::warning, "a stop from before the start is still latched");
  if (!remembered.joints_wait.empty()) {
    e.events.notice(now, Notice::Level::warning,
                    "joint commands wait for a person, as before the start");
  }
  e.power.recall(remembered.power_cut);
  e.hold.recall(remembered);
  if (remembered.mechanics_proved) e.mechanics.recall_proved();
  if (remembered.task) {
    e.events.notice(now, Notice::Level::warning,
                    "a task was on its way when the gateway ended: it is not taken up again");
  }
}

/// What the ground falls by where the base stands; not a number without an inertial sensor.
double Engine::Impl::tilt_deg() const {
  if (!imu_trusted()) return kAbsent;
  return to_deg(std::acos(std::cos(estimate.roll_rad) * std::cos(estimate.pitch_rad)));
}

/// Steep ground stays so until the inertial sensor says otherwise: when it falls silent nobody
/// knows, and what nobody knows is not level. A robot without one was accepted as it is.
void Engine::Impl::watch_tilt(Time now, bool has_imu) {
  if (config.base.hold != HoldBy::level_ground_only || !has_imu) return;
  const double falls_deg = tilt_deg();
  const bool known = std::isfinite(falls_deg);
  if (known || tilt_known_at == kNever) tilt_known_at = now;
  if (!known) {
    steep_since = kNever;
    if (steep.empty() && now - tilt_known_at >= kTiltUnknownFor)
      steep = "nobody knows how steep the ground is: no inertial sensor is heard";
    return;
  }
  if (falls_deg <= config.base.max_tilt_deg) {
    steep_since = kNever;
    steep.clear();
    return;
  }
  if (steep_since == kNever) steep_since = now;
  if (now - steep_since < kSteepFor) return;
  steep.format("the ground falls by %.1f degrees; without power this base rolls: allowed %.1f",
               falls_deg, config.base.max_tilt_deg);
}

void Engine::Impl::release_hold(const RequestId& id, const ReleaseHold& release, Time now) {
  Reason why;
  if (navigator.active() || driven || !owners.at_rest()) why = "the robot is being driven";
  for (const AxisSnapshot& axis : axes) {
    const bool turns = rim_mps(base, std::abs(axis.motion.velocity_radps)) > kTurns_mps;
    if (why.empty() && axis.state == AxisState::running && turns) why = "the robot moves";
  }
  if (why.empty() && rest.may_drive_on()) why = "the base is silent: nothing reaches it";
  hold.release(id, release, why, tilt_deg(), now, events);
}

void Engine::Impl::arm_hold(const RequestId& id, Time now) {
  const HealthReport& report = health.report();
  Reason why;
  if (!report.ready) {
    why = "the gateway has just started";
  } else if (report.estop) {
    why = "the e-stop is pressed";
  } else if (!report.estop_known) {
    why = report.text(Cause::line_lost);
  } else if (latch.power_cut()) {
    why = "the drives have no power: drover reset";
  } else if (latch.ran_away()) {
    why = "a wheel ran away: drover reset";
  } else if (report.holds(Cause::foreign)) {
    why = report.text(Cause::foreign);
  } else if (driven || navigator.active()) {
    why = "the robot is being driven, and holds when it stops";
  } else if (!report.drives_ok) {
    why = report.text(Cause::drive_silent);
  }
  hold.arm(id, why, now, events);
}

/// At rest, what the hold wants goes over the rest that everybody else asked for.
void Engine::Impl::command_hold(EngineOutput& out) {
  for (std::size_t i = 0; i < axes.size(); ++i) {
    const AxisCommand& wanted = hold.command(static_cast<AxisId>(i));
    if (wanted.request == AxisRequest::rest) continue;
    out.axes[i] = wanted;
    out.slowing_permitted[i] = wanted.request == AxisRequest::hold;
    axes[i].commanded_velocity_radps = wanted.velocity_radps;
  }
}

}  // namespace drover::engine
