// What stopped the robot and stays until somebody acts, and who that may be.
#include "engine/health/latch.h"

namespace drover::engine {
namespace {

consteval bool in_their_order() {
  for (std::size_t i = 0; i < kLatches.size(); ++i)
    if (kLatches[i].what != static_cast<Latched>(i)) return false;
  return true;
}
static_assert(in_their_order());

Reason reset_first(const Reason& stop) {
  Reason why;
  if (!stop.empty())
    why.format("reset the stop first: %.*s", static_cast<int>(stop.view().size()),
               stop.view().data());
  return why;
}

bool far_away(RequestId::Source by) {
  return by == RequestId::Source::mqtt || by == RequestId::Source::aimrt;
}

}  // namespace

void Latch::set(Latched what, const Reason& why) {
  // The speed of a wheel that runs away changes all the time: what was told first stays.
  if (what == Latched::ran_away && ran_away_) return;
  ran_away_ = ran_away_ || what == Latched::ran_away;
  const LatchRow& row = kLatches[static_cast<std::size_t>(what)];
  switch (row.by) {
    case ResetBy::any_start: task_ = why; break;
    case ResetBy::person: joints_ = why; break;
    case ResetBy::reset:
    case ResetBy::at_robot: stop_ = why; break;
  }
  // A stop that is less grave takes nothing of this back.
  at_robot_ = at_robot_ || row.by == ResetBy::at_robot;
  power_cut_ = power_cut_ || row.cuts_power;
}

void Latch::reset(Act act) {
  if (act != Act::take) task_.clear();
  if (act != Act::begin) joints_.clear();
  if (act != Act::reset) return;
  stop_.clear();
  at_robot_ = power_cut_ = ran_away_ = false;
}

Reason Latch::refuses(const ResetAsked& asked) const {
  if (!asked.runs_away.empty()) return asked.runs_away;
  if (power_cut_ && far_away(asked.by)) return "the power was cut: reset it at the robot";
  if (power_cut_ && asked.moves) return "the robot still moves";
  if (!asked.health.ready) return kJustStarted;
  if (asked.task_active) return "a task runs: cancel it first";
  if (!asked.at_rest) return "the robot is still stopping";
  if (at_robot_ && asked.by != RequestId::Source::cli)
    return "this stop is reset at the robot: drover reset";
  // What does not hear its stop is cut in a moment, and must not have been reset before.
  if (!stop_.empty() && asked.turns) return "the robot still moves";
  if (!stop_.empty() && asked.health.holds(Cause::moved)) return asked.health.text(Cause::moved);
  // The guard's hold is reset at the guard, after this: what is refused here stays held there.
  return asked.health.stop_but_guard;
}

void Latch::recall(const Remembered& remembered) {
  stop_ = remembered.stop;
  joints_ = remembered.joints_wait;
  at_robot_ = !stop_.empty() && remembered.stop_at_robot;
  power_cut_ = remembered.power_cut;
  ran_away_ = !stop_.empty() && remembered.ran_away;
}

void Latch::remember(Remembered& out) const {
  out.stop = stop_;
  out.stop_at_robot = at_robot_;
  out.power_cut = power_cut_;
  out.ran_away = ran_away_;
  out.joints_wait = joints_;
}

const Reason& Latch::why() const {
  if (!stop_.empty()) return stop_;
  return task_.empty() ? joints_ : task_;
}

Reason Latch::hinders_all() const {
  return reset_first(stop_);
}

Reason Latch::hinders_joints() const {
  return reset_first(joints_);
}

}  // namespace drover::engine
