// Takes drives back that let go: at the speed that their wheels have, and down to rest.
#include "engine/own/take_back.h"

#include <algorithm>
#include <cmath>

#include "engine/health/heard.h"
#include "engine/still.h"

namespace drover::engine {
namespace {

using std::chrono::milliseconds;

/// A guard that has the bus is asked to hand it back first: under its zeros a rolling wheel would
/// stop with a jerk. Not for longer, the robot rolls.
constexpr Duration kGuardPatience = milliseconds(300);
/// A drive's report from before it heard of the request tells nothing of it.
constexpr Duration kReportDelay = milliseconds(50);
constexpr Duration kLongestAttempt = milliseconds(3000);
constexpr Duration kRetry = milliseconds(500);

}  // namespace

TakeBack::TakeBack(const EngineConfig& config)
    : base_(kinematics_of(config.base)),
      driven_(joints_of(base_)),
      stale_(from_s(config.health.drive_stale_s)),
      falls_radps2_(joint_radps(base_, config.limits.deceleration_mps2)) {}

bool TakeBack::heard(Time now, const AxisSnapshot& axis) const {
  return axis.health == SourceState::fresh && tells_motion(axis, now, stale_);
}

bool TakeBack::active() const {
  return std::any_of(catches_.begin(), catches_.end(), [](const Catch& it) { return it.active; });
}

AxisCommand TakeBack::command(AxisId id) const {
  const Catch& it = catches_[id];
  return it.active ? AxisCommand{AxisRequest::hold, it.velocity_radps} : AxisCommand{};
}

bool TakeBack::others_hold(const TakeBackInput& input) const {
  for (std::size_t i = 0; i < input.axes.size(); ++i) {
    const AxisSnapshot& axis = input.axes[i];
    const bool runs = axis.state == AxisState::running && heard(input.now, axis);
    if (driven_[i] && runs && !catches_[i].active) return true;
  }
  return false;
}

void TakeBack::begin(const TakeBackInput& input, const AxisSnapshot& axis, Catch& it) const {
  const bool waits = input.guard_has_bus && input.now - input.since < kGuardPatience;
  const bool off =
      axis.state == AxisState::idle || (axis.state == AxisState::fault && !failed(axis));
  if (waits || !off || input.now < it.next || !heard(input.now, axis)) return;
  it.active = true;
  it.since = input.now;
  const double measured_radps = axis.motion.velocity_radps;
  // Where another wheel holds already the robot does not roll: this one joins it at rest.
  const bool rolls = !input.guard_has_bus && !others_hold(input);
  const bool turns = rim_mps(base_, std::abs(measured_radps)) > kTurns_mps;
  it.velocity_radps = rolls && turns ? measured_radps : 0.0;
}

/// Until the drive runs, the lowest speed that the wheel had; from then on a ramp. Never faster
/// than the wheel.
void TakeBack::follow(const TakeBackInput& input, const AxisSnapshot& axis, Catch& it) const {
  const bool runs = axis.state == AxisState::running;
  const bool refused = axis.state == AxisState::fault && input.now - it.since > kReportDelay;
  const bool late = !runs && input.now - it.since > kLongestAttempt;  // a ramp ends by itself
  if (refused || !heard(input.now, axis) || late) {
    it = {false, kNever, input.now + kRetry, 0};
    return;
  }
  const double measured_radps = axis.motion.velocity_radps;
  const double sign = it.velocity_radps < 0 ? -1.0 : 1.0;
  const double fall_radps = runs ? falls_radps2_ * std::max(to_s(input.dt), 0.0) : 0.0;
  const double ramp_radps = std::max(sign * it.velocity_radps - fall_radps, 0.0);
  const double most_radps = std::isfinite(measured_radps) ? sign * measured_radps : 0.0;
  it.velocity_radps =
      input.guard_has_bus ? 0.0 : sign * std::clamp(ramp_radps, 0.0, std::max(most_radps, 0.0));
  if (runs && it.velocity_radps == 0) it.active = false;
}

void TakeBack::step(const TakeBackInput& input) {
  for (std::size_t i = 0; i < input.axes.size(); ++i) {
    if (!driven_[i]) continue;
    Catch& it = catches_[i];
    if (it.active) {
      follow(input, input.axes[i], it);
    } else {
      begin(input, input.axes[i], it);
    }
  }
}

}  // namespace drover::engine
