// Whether the wheels do what they are told: blocked, not following, running away.
#include "engine/health/wheels.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "engine/base/words.h"
#include "engine/health/heard.h"

namespace drover::engine {
namespace {

constexpr double kJudgedShare = 0.05;  // of the highest speed
constexpr double kFollows = 0.2;       // of the commanded way
constexpr double kTurns = 0.03;        // of it: more is no noise of an encoder
constexpr double kWindow_s = 0.1;      // ways are compared over this long
// At the rim. A base that turned on the spot has its tyres wound up against the ground: turned the
// other way they unwind first, and a slow wheel stands or goes back meanwhile.
constexpr double kUnwinds_m = 0.12;
constexpr double kRunaway_s = 0.1;
constexpr double kRunawayMargin_mps = 0.3;
constexpr double kReachHeld_s = 0.5;  // drives lag, and a load overshoots
constexpr double kHighestSlip = 2.5;  // the estimate never goes so far

}  // namespace

WheelMonitor::WheelMonitor(const EngineConfig& config)
    : config_(config),
      base_(kinematics_of(config.base)),
      judged_radps_(joint_radps(base_, kJudgedShare * config.limits.max_speed_mps)),
      unwinds_rad_(joint_radps(base_, kUnwinds_m)),
      fastest_radps_(joint_radps(
          base_, max_rim_mps(base_, config.limits, {kHighestSlip}) + kRunawayMargin_mps)),
      margin_radps_(joint_radps(base_, kRunawayMargin_mps)),
      falls_radps2_(joint_radps(base_, config.limits.deceleration_mps2)) {}

void WheelMonitor::reset() {
  wheels_ = {};
}

void WheelMonitor::watch(Wheel& wheel, const AxisSnapshot& axis, Time now, Duration dt) {
  const double command_radps = axis.commanded_velocity_radps;
  const bool forwards = command_radps >= 0;
  const double position_rad = axis.motion.position_rad;
  double step_rad = 0;
  if (!std::isfinite(position_rad)) {  // a drive without a position is judged by its velocity
    const double velocity_radps = axis.motion.velocity_radps;
    step_rad = std::isfinite(velocity_radps) ? velocity_radps * to_s(dt) : 0.0;
  } else if (std::isfinite(wheel.last_position_rad)) {
    step_rad = position_rad - wheel.last_position_rad;
  }
  wheel.last_position_rad = position_rad;
  if (!(std::abs(command_radps) > judged_radps_)) {
    wheel.active = false;
    return;
  }
  if (!wheel.active || wheel.forwards != forwards) {
    wheel.active = true;
    wheel.forwards = forwards;
    wheel.commanded_rad = 0;
    wheel.moved_rad = 0;
    wheel.mark = now;
    wheel.owed_rad = wheel.made_rad = 0;
    wheel.window = now;
    return;
  }
  wheel.commanded_rad += std::abs(command_radps) * to_s(dt);
  wheel.owed_rad += std::abs(command_radps) * to_s(dt);
  wheel.moved_rad += forwards ? step_rad : -step_rad;
  wheel.made_rad += forwards ? step_rad : -step_rad;
  if (now - wheel.window < from_s(kWindow_s)) return;
  // Each window for itself: a wheel that stood for a moment has nothing to make up for.
  if (wheel.moved_rad >= kFollows * wheel.commanded_rad) {
    wheel.mark = now;
    wheel.owed_rad = wheel.made_rad = 0;
  }
  wheel.commanded_rad = 0;
  wheel.moved_rad = 0;
  wheel.window = now;
}

/// How fast the wheel may be at most after the commands it had.
void WheelMonitor::follow_command(Wheel& wheel, const AxisSnapshot& axis, Time now,
                                  Duration dt) const {
  const bool heard = tells_motion(axis, now, from_s(config_.health.drive_stale_s));
  const bool judged = heard && axis.state == AxisState::running;
  double asked_radps = std::abs(axis.commanded_velocity_radps);
  // A guard may be slowing it down since before this gateway began, or somebody pushed it.
  const double found_radps = std::abs(axis.motion.velocity_radps);
  const bool was_caught = wheel.caught;
  // A roll that is caught may be faster than any command: its ramp begins there.
  if (judged && wheel.let_go) wheel.caught = true;
  if (!(found_radps > fastest_radps_) || axis.state != AxisState::running) wheel.caught = false;
  wheel.let_go = heard && axis.state != AxisState::running;
  // A caught wheel has no other limit: a silence must not let it begin with a higher speed.
  const bool stays_caught = was_caught && wheel.caught;
  const bool begins = !wheel.judged && !stays_caught;
  if (begins && std::isfinite(found_radps)) asked_radps = std::max(asked_radps, found_radps);
  if (begins) wheel.began_radps = asked_radps;
  if (stays_caught) asked_radps = std::min(asked_radps, wheel.began_radps);
  if (begins || asked_radps >= wheel.reach_radps) {
    wheel.reach_radps = asked_radps;
    wheel.reached = now;
  } else if (wheel.judged && now - wheel.reached >= from_s(kReachHeld_s)) {
    wheel.reach_radps = std::max(asked_radps, wheel.reach_radps - falls_radps2_ * to_s(dt));
  }
  wheel.judged = judged;
}

bool WheelMonitor::runs_away(Wheel& wheel, const AxisSnapshot& axis, Time now, Duration dt) const {
  follow_command(wheel, axis, now, dt);
  const double most_radps = wheel.caught ? std::numeric_limits<double>::infinity() : fastest_radps_;
  const bool reached = wheel.judged || wheel.caught;
  const double limit_radps =
      reached ? std::min(most_radps, wheel.reach_radps + margin_radps_) : most_radps;
  const bool fast =
      axis.state == AxisState::running && std::abs(axis.motion.velocity_radps) > limit_radps;
  if (!fast) {
    wheel.fast_since = kNever;
    return false;
  }
  if (wheel.fast_since == kNever) wheel.fast_since = now;
  return now - wheel.fast_since >= from_s(kRunaway_s);
}

void WheelMonitor::tell_runaway(const AxisSnapshot& axis) {
  const auto joint = joint_text(base_, axis.joint);
  const auto size = static_cast<int>(joint.view().size());
  const char* unit = joint_unit(base_);
  const double radps = axis.motion.velocity_radps;
  if (std::abs(radps) > fastest_radps_) {
    reason_.format("%.*s runs away: %.1f %s", size, joint.view().data(), radps, unit);
  } else {
    reason_.format("%.*s turns by itself: %.1f %s, commanded %.1f", size, joint.view().data(),
                   radps, unit, axis.commanded_velocity_radps);
  }
}

/// Wheels that turn, but by another measure than they are told by, look blocked, too.
void WheelMonitor::tell_blocked(Duration since) {
  double owed_rad = 0;
  double made_rad = 0;
  for (const Wheel& wheel : wheels_) {
    if (!wheel.active) continue;
    owed_rad += wheel.owed_rad;
    made_rad += wheel.made_rad;
  }
  const double share = owed_rad > 0 ? made_rad / owed_rad : 0.0;
  if (std::abs(share) < kTurns) {
    reason_.format("blocked: %s for %.1f s", words_of(base_).do_not_move, to_s(since));
  } else {
    reason_.format(
        "blocked: %s made %+.0f %% of what was commanded for %.1f s: is the load too "
        "heavy, or are a drive's units or its direction wrong?",
        words_of(base_).wheels, 100 * share, to_s(since));
  }
}

WheelFault WheelMonitor::update(Time now, Duration dt, std::span<const AxisSnapshot> axes) {
  reason_.clear();
  const AxisSnapshot* behind = nullptr;
  Duration longest{};
  Duration shortest = Duration::max();
  std::size_t judged = 0;
  for (std::size_t i = 0; i < axes.size(); ++i) {
    Wheel& wheel = wheels_[i];
    if (runs_away(wheel, axes[i], now, dt)) {
      tell_runaway(axes[i]);
      return WheelFault::runaway;
    }
    watch(wheel, axes[i], now, dt);
    if (!wheel.active) continue;
    ++judged;
    const Duration age = now - wheel.mark;
    shortest = std::min(shortest, age);
    if (age >= longest && wheel.owed_rad >= unwinds_rad_) {
      longest = age;
      behind = &axes[i];
    }
  }
  if (judged == 0) return WheelFault::none;
  if (shortest >= from_s(config_.navigate.blocked_timeout_s)) {
    tell_blocked(shortest);
    return WheelFault::blocked;
  }
  // Only beside one that does follow now; when all stand, the robot is about to be blocked.
  const bool others_follow = shortest <= from_s(1.5 * kWindow_s);
  if (behind != nullptr && longest >= from_s(config_.health.follow_timeout_s) && others_follow) {
    const auto joint = joint_text(base_, behind->joint);
    reason_.format("%.*s does not follow its command", static_cast<int>(joint.view().size()),
                   joint.view().data());
    return WheelFault::not_following;
  }
  return WheelFault::none;
}

}  // namespace drover::engine
