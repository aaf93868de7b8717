// The engine's part of holding: what a person asks, what is remembered, steep ground.
#include <cmath>

#include "drover/angle.h"
#include "engine/engine_impl.h"
#include "engine/own/arming_checks.h"

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
  e.arming.recall(remembered);
  if (remembered.mechanics_proved) e.mechanics.recall_proved();
  if (remembered.at_rest) e.rest.recall_at_rest();
  e.place.recall(remembered.place);
  e.estimator.recall_elsewhere(remembered.place.doubt_cm / 100.0);
  if (remembered.task) {
    e.events.notice(now, Notice::Level::warning,
                    "a task was on its way when the gateway ended: it is not taken up again");
  }
}

void Engine::recall(const LearnedValues& learned) {
  impl_->estimator.recall(learned);
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
  const bool moved = navigator.active() || arming.driven() || !owners.at_rest();
  const Reason why = check_release(axes, base, moved, rest.may_drive_on(), slopes);
  arming.release(id, release, why, tilt_deg(), now, events);
}

void Engine::Impl::arm_hold(const RequestId& id, Time now) {
  const bool moved = navigator.active() || arming.driven();
  arming.arm(id, check_arm(health.report(), latch, moved), now, events);
}

}  // namespace drover::engine
