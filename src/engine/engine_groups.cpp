// The engine's part for joints outside the base.
#include <algorithm>

#include "engine/engine_impl.h"

namespace drover::engine {
namespace {

/// Somebody is beside it, with his hands on it.
constexpr const char* kReleased = "the robot is released, to be pushed by hand: drover hold";

}  // namespace

AxisSnapshot* Engine::Impl::axis_of(AxisId id) {
  if (id == kBaseAxis) return takes_twist(base) ? axes.data() : nullptr;
  return id < snapshot.axes.size() ? &snapshot.axes[id] : nullptr;
}

void Engine::Impl::make_groups() {
  for (const GroupConfig& group : config.groups) {
    groups.emplace_back(group, from_s(config.navigate.start_timeout_s));
    (void)snapshot.groups.push_back(groups.back().snapshot());
    for (const JointRules& joint : group.joints)
      snapshot.axes[joint.axis].group = static_cast<std::uint8_t>(groups.size());
  }
}

/// Each part of a message is for whose joints it names, and leaves the others as they are.
void Engine::Impl::take_joints(const JointTargets& targets, RequestId::Source source, Time now) {
  for (JointGroup& group : groups) group.take(targets, source, now);
  JointTargets of_base;
  for (const JointTarget& target : targets.joints)
    if (target.axis >= snapshot.axes.size() || snapshot.axes[target.axis].group == 0)
      (void)of_base.joints.push_back(target);
  if (of_base.joints.empty() && !targets.joints.empty()) return;
  if (takes_twist(base))
    owners.refuse({"this robot has no joints: its base takes a twist"});
  else
    owners.take(of_base, now);
}

void Engine::Impl::end_groups(const Reason& why) {
  for (JointGroup& group : groups) group.end(why);
}

void Engine::Impl::step_groups(Time now, Duration dt, const Environment& environment,
                               EngineOutput& out) {
  if (groups.empty()) return;
  for (std::size_t i = joints_of_base(); i < snapshot.axes.size(); ++i)
    look_at(snapshot.axes[i], environment.axes[i], now);
  const HealthReport& report = health.report();
  const Reason hindrance = !report.ready                ? Reason(kJustStarted)
                           : !report.end_groups.empty() ? report.end_groups
                           : !latch.stop().empty()      ? latch.stop()
                           : arming.released()          ? Reason(kReleased)
                                                        : Reason();
  const bool blocked = environment.guard_has_bus && !environment.guard_leaves_the_rest();
  for (std::size_t i = 0; i < groups.size(); ++i) {
    groups[i].step({now,
                    dt,
                    {snapshot.axes.data(), snapshot.axes.size()},
                    from_s(config.health.drive_stale_s),
                    hindrance,
                    blocked,
                    report.estop},
                   out.axes, out.joint_may_move, events);
    snapshot.groups[i] = groups[i].snapshot();
  }
  for (std::size_t i = joints_of_base(); i < snapshot.axes.size(); ++i) {
    const AxisCommand& told = out.axes[i];
    const bool runs = told.request == AxisRequest::run && !blocked;
    snapshot.axes[i].commanded_velocity_radps = told.velocity_radps;
    snapshot.axes[i].stiffness_Nmprad = runs ? told.impedance.stiffness_Nmprad : kAbsent;
    snapshot.axes[i].damping_Nmsprad = runs ? told.impedance.damping_Nmsprad : kAbsent;
  }
}

}  // namespace drover::engine
