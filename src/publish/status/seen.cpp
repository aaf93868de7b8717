// A snapshot as a view may show it now: what is old is not shown as the present.
#include "publish/status/seen.h"

namespace drover::publish {
namespace {

void age(SourceState& health) {
  if (health == SourceState::fresh) health = SourceState::stale;
}

void forget_motion(Snapshot& s) {
  s.pose.vx_mps = kAbsent;
  s.worst_vx_mps = kAbsent;
  s.pose.wz_radps = kAbsent;
  s.pose.vy_mps = kAbsent;
  s.pose.position_sigma_m = kAbsent;
  s.pose.yaw_sigma_rad = kAbsent;
  for (AxisSnapshot& axis : s.axes) {
    axis.motion.velocity_radps = kAbsent;
    axis.motion.effort_Nm = kAbsent;
    axis.commanded_velocity_radps = kAbsent;
    axis.stiffness_Nmprad = axis.damping_Nmsprad = kAbsent;
  }
  s.base.measured = s.base.commanded = {kAbsent, kAbsent};
  ClearanceSnapshot& free = s.clearance;
  free.ahead_m = free.back_m = free.along_m = free.left_rad = free.right_rad = kAbsent;
  free.first.clear();
  s.cmd_vel.active = s.joint_command.active = false;
}

}  // namespace

void tell_first(Snapshot& snapshot, std::string_view reason) {
  const auto others = snapshot.why;
  snapshot.why.clear();
  snapshot.tell_why(drover::Reason(reason));
  for (const drover::Reason& other : others) snapshot.tell_why(other);
}

void tell_last(Snapshot& snapshot, std::string_view reason) {
  const drover::Reason words(reason);
  for (const drover::Reason& told : snapshot.why)
    if (told == words) return;
  snapshot.tell_why(words);
}

Snapshot as_seen(const Snapshot& snapshot, Time now, Duration limit) {
  Snapshot seen = snapshot;
  const bool fresh = snapshot.time == kNever || now - snapshot.time <= limit;
  if (fresh) return seen;
  const drover::Reason old("not looked at: the control thread stands still");
  const auto source = [&old](SourceState& health, SourceSnapshot& what) {
    age(health);
    what.reason = old;
  };
  source(seen.gnss.health, seen.gnss.source);
  source(seen.imu.health, seen.imu.source);
  source(seen.battery.health, seen.battery.source);
  for (SensorSnapshot& sensor : seen.sensors) source(sensor.health, sensor.source);
  for (AxisSnapshot& axis : seen.axes) source(axis.health, axis.source);
  source(seen.base.health, seen.base.source);
  seen.clearance.unknown = old;
  for (std::size_t i = 0; i < kLineCount; ++i) source(seen.line_health[i], seen.line_source[i]);
  forget_motion(seen);
  seen.nav.status = NavStatus::error;
  if (seen.nav.locate == LocateState::good) seen.nav.locate = LocateState::lost;
  drover::Reason why;
  why.format("the control thread has stood still for %.1f s: nothing is known of the robot now",
             to_s(now - snapshot.time));
  tell_first(seen, why);
  return seen;
}

}  // namespace drover::publish
