// The engine: what a cycle does, in its order.
#include "engine/engine.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "drover/angle.h"
#include "engine/engine_impl.h"
#include "engine/navigate/navigator_checks.h"

namespace drover::engine {
namespace {

constexpr Duration kLongestCycle = std::chrono::milliseconds(50);

}  // namespace

Engine::Impl::Impl(const EngineConfig& c)
    : config(c),
      base(kinematics_of(c.base)),
      estimator(c.estimate, c.base),
      odometry(c.estimate),
      sensors(c),
      health(c),
      wheels(c),
      steering(c),
      rest(c),
      place(c.estimate),
      tilt(c.health),
      hit(c.health),
      mechanics(c),
      aside(c),
      clearance(c.clearance, c.limits, c.clearance_required, limits(base).pivots,
                limits(base).sideways && c.clearance_aside),
      navigator(c, latch),
      owners(c, latch),
      arming(c) {
  level.fill(true);
  for (const Name& joint : config.joints) {
    AxisSnapshot axis;
    axis.joint = joint;
    if (!snapshot.axes.push_back(axis)) break;
  }
  make_groups();
  axes = {snapshot.axes.data(), joints_of_base()};
  if (takes_twist(base)) {
    snapshot.base.configured = true;  // from the first on: a recording's fields are the same
    edges[0].joint = "left";
    edges[1].joint = "right";
    axes = edges;
  }
  sensors.fill(snapshot, {});
  snapshot.clearance.configured = config.clearance_required;
  snapshot.line_configured = config.line_configured;
  snapshot.output_configured = config.output_configured;
}

[[gnu::hot]] void Engine::Impl::count(const Measurement& m) {
  if (const auto* motion = std::get_if<AxisMotion>(&m.value)) {
    if (AxisSnapshot* const axis = axis_of(motion->axis)) ++axis->source.samples;
  } else if (const auto* line = std::get_if<LineState>(&m.value)) {
    const auto index = static_cast<std::size_t>(line->line);
    if (index < kLineCount) ++snapshot.line_source[index].samples;
  }
}

[[gnu::hot]] void Engine::Impl::take(const Measurement& m) {
  count(m);
  const bool in_use = sensors.take(m, estimator);
  // What a stuck or silent sensor's driver still hands on is not believed. Of those that are not in
  // use the zeros are learned.
  if (std::holds_alternative<ImuSample>(m.value)) {
    if (m.source < kMaxOfKind && sensors.imu_trusted(m.source)) estimator.on_measurement(m);
  } else if (in_use) {
    estimator.on_measurement(m);
  }
  if (!in_use) return;
  if (const auto* motion = std::get_if<AxisMotion>(&m.value)) {
    AxisSnapshot* axis = axis_of(motion->axis);
    // Frames that overtook each other never move a state backwards.
    if (axis == nullptr || m.time < axis->last_motion) return;
    axis->motion = *motion;
    axis->last_motion = m.time;
  } else if (const auto* body = std::get_if<BodyMotion>(&m.value)) {
    take_body(*body, m.time);
  } else if (const auto* status = std::get_if<AxisStatus>(&m.value)) {
    AxisSnapshot* axis = axis_of(status->axis);
    if (axis == nullptr) return;
    for (AxisSnapshot& one : axes_of(*status, *axis)) {
      one.state = status->state;
      one.error_code = status->error_code;
      one.lapsed = status->lapsed;
      one.powered = status->powered;
      one.stops_all = status->stops_all;
    }
  } else if (const auto* temperature = std::get_if<AxisTemperature>(&m.value)) {
    AxisSnapshot* axis = axis_of(temperature->axis);
    if (axis == nullptr) return;
    axis->inverter_degC = temperature->inverter_degC;
    axis->motor_degC = temperature->motor_degC;
  } else if (const auto* supply = std::get_if<AxisSupply>(&m.value)) {
    AxisSnapshot* axis = axis_of(supply->axis);
    if (axis == nullptr) return;
    axis->bus_V = supply->bus_V;
    axis->bus_A = supply->bus_A;
  } else if (const auto* position = std::get_if<GnssPosition>(&m.value)) {
    if (m.time < snapshot.gnss.position_time) return;
    fix = *position;
    snapshot.gnss.position = *position;
    snapshot.gnss.position_time = m.time;
    rest.witness().on_position(*position, m.time);
    mechanics.on_position(*position, m.time);
    aside.on_position(*position, m.time);
  } else if (const auto* velocity = std::get_if<GnssVelocity>(&m.value)) {
    if (m.time < snapshot.gnss.velocity_time) return;
    snapshot.gnss.velocity = *velocity;
    snapshot.gnss.velocity_time = m.time;
    rest.witness().on_speed(*velocity, m.time);
  } else if (const auto* heading = std::get_if<GnssHeading>(&m.value)) {
    rest.witness().on_heading(*heading, m.time);
    mechanics.on_heading(*heading, m.time);
    if (!std::isfinite(heading->heading_deg) || m.time < snapshot.gnss.heading_time) return;
    snapshot.gnss.receiver_heading_deg = heading->heading_deg;
    snapshot.gnss.heading_deg = wrap_deg(
        heading->heading_deg - antenna_of(config.estimate, m.source).heading_baseline_offset_deg);
    snapshot.gnss.heading_time = m.time;
  } else if (const auto* imu = std::get_if<ImuSample>(&m.value)) {
    if (m.time < snapshot.imu.time) return;
    snapshot.imu.sample = *imu;
    snapshot.imu.time = m.time;
    if (imu_trusted()) watch_imu(*imu, m.time);
  } else if (const auto* line = std::get_if<LineState>(&m.value)) {
    const auto index = static_cast<std::size_t>(line->line);
    if (index >= kLineCount) return;
    level[index] = line->active;
    pulse[index] = pulse[index] || line->active;
  }
}

void Engine::Impl::take_words(const Measurement& m, std::string_view words) {
  sensors.take_words(m, words);
  const auto* const status = std::get_if<AxisStatus>(&m.value);
  AxisSnapshot* const axis = status != nullptr ? axis_of(status->axis) : nullptr;
  if (axis == nullptr) return;
  for (AxisSnapshot& one : axes_of(*status, *axis)) one.fault.assign(words);
}

/// One device moves both edges of a base.
std::span<AxisSnapshot> Engine::Impl::axes_of(const AxisStatus& status, AxisSnapshot& axis) const {
  return status.axis == kBaseAxis ? axes : std::span(&axis, 1);
}

void Engine::Impl::look_at(AxisSnapshot& axis, const SourceHealth& driver, Time now) {
  axis.last_motion = std::min(axis.last_motion, now);  // a time to come must not hide a silence
  axis.health = driver.state;
}

/// What the drives were let do; how fast they run is their owner's word.
void Engine::Impl::command_axes(const Motion& motion, EngineOutput& out) {
  const Learned learned{estimate.yaw_slip_factor};
  JointVelocities radps = motion.joints ? owners.joint_velocities_radps()
                                        : setpoints(base, motion.twist, learned,
                                                    max_rim_mps(base, config.limits, learned));
  radps.resize(axes.size());
  for (std::size_t i = 0; i < axes.size(); ++i) {
    AxisCommand& command = out.axes[i] = arming.command(static_cast<AxisId>(i));
    const bool runs = command.request == AxisRequest::run;
    if (runs && std::isfinite(radps[i])) command.velocity_radps = radps[i];
    axes[i].commanded_velocity_radps = command.velocity_radps;
    out.motion_permitted = out.motion_permitted || (runs && command.velocity_radps != 0);
    out.slowing_permitted[i] = command.request == AxisRequest::hold;
  }
}

void Engine::Impl::start_task(const Command& command, const StartTask& task, Time now) {
  const RequestId& id = command.id;
  Reason why;
  if (task.overtaken) why = "a stop came after it";
  // A broker that is late by less than what shows may have had it since before.
  const bool older = id.source == RequestId::Source::mqtt && stopped_at != kNever &&
                     now - stopped_at < kBrokerLateUnnoticed;
  if (why.empty() && older && !health.report().nothing_moves())
    why = "the robot was stopped until just now, and this may be older; press again";
  // It may have waited until its track was looked along.
  const bool stopped_since =
      command.received != kNever && stopped_at != kNever && stopped_at > command.received;
  if (why.empty() && stopped_since && !health.report().nothing_moves())
    why = "the robot was stopped after this was asked for; press again";
  if (why.empty()) why = arming.hindrance();
  if (why.empty()) why = owners.hinders_task();
  if (why.empty() && health.report().stop.empty()) why = rest.turns_by_itself();
  const bool fit = check_robot(health.report(), estimator.has_origin()).empty();
  if (why.empty() && fit && !navigator.active()) why = place.ask_start(now);
  if (!why.empty()) {
    events.push(now, CommandRefused{id, why});
    if (task.path != nullptr) events.push(now, PathReleased{task.path});
    return;
  }
  navigator.start(id, task, now, estimate, estimator.has_origin(), health.report(), events);
  if (!navigator.starting()) return;
  owners.on_task_started();
  mechanics.begin_anew();
  learned_notices.tell_unknown(now, estimate, events);
}

void Engine::Impl::engage_stop(const RequestId& id, Time now) {
  latch.set(Latched::asked, "emergency stop of an operator");
  events.push(now, CommandAccepted{id, {}});
  navigator.stop(now, events);
  rest.on_stop_asked();
}

void Engine::Impl::reset_stop(const RequestId& id, Time now) {
  const bool runs_away = wheel_fault == WheelFault::runaway;
  const Reason why = latch.refuses({.by = id.source,
                                    .runs_away = runs_away ? wheel_reason : Reason(),
                                    .moves = rest.moves(now),
                                    .turns = rest.turns(),
                                    .task_active = navigator.active(),
                                    .at_rest = owners.at_rest(),
                                    .health = health.report()});
  if (!why.empty()) return events.push(now, CommandRefused{id, why});
  const bool anything = !latch.why().empty() || latch.power_cut();
  events.push(now, CommandAccepted{id, anything ? Reason() : Reason("nothing was latched")});
  latch.reset(Act::reset);
  rest.reset();
}

Engine::Engine(const EngineConfig& config) {
  const bool corners = config.base.left.size() == 2 && config.base.right.size() == 2;
  if (config.base.kind == BaseKind::mecanum && !corners)
    throw std::invalid_argument("a mecanum base has two wheels on each side");
  if (joints_needed(config.base) > config.joints.size())
    throw std::invalid_argument("the base names an axis that is not among the drives");
  const std::size_t of_base = config.joints.size() - joints_of_groups(config);
  if (joints_of_groups(config) > config.joints.size() || joints_needed(config.base) > of_base)
    throw std::invalid_argument("the joints of the base come before those of other groups");
  for (const GroupConfig& group : config.groups)
    for (const JointRules& joint : group.joints)
      if (joint.axis < of_base || joint.axis >= config.joints.size())
        throw std::invalid_argument("a group names an axis that is not its own");
  impl_ = std::make_unique<Impl>(config);
}

Engine::~Engine() = default;

[[gnu::hot]] void Engine::on_measurement(const Measurement& measurement) {
  impl_->take(measurement);
}

void Engine::on_words(const Measurement& measurement, std::string_view words) {
  impl_->take_words(measurement, words);
}

void Engine::on_command(const Command& command, Time now) {
  Impl& e = *impl_;
  const RequestId& id = command.id;
  if (const auto* task = std::get_if<StartTask>(&command.body)) {
    e.start_task(command, *task, now);
  } else if (std::holds_alternative<CancelTask>(command.body)) {
    e.navigator.cancel(id, now, e.events);
    e.owners.cancel(now, e.events);
    e.end_groups("cancelled");
    e.latch.reset(Act::cancel);
  } else if (std::holds_alternative<EngageStop>(command.body)) {
    e.engage_stop(id, now);
  } else if (std::holds_alternative<ResetStop>(command.body)) {
    e.reset_stop(id, now);
  } else if (std::holds_alternative<ProposeOrigin>(command.body)) {
    e.propose_origin(id, now);
  } else if (const auto* origin = std::get_if<SetOrigin>(&command.body)) {
    e.set_origin(id, origin->origin, now);
  } else if (const auto* targets = std::get_if<JointTargets>(&command.body)) {
    e.take_joints(*targets, id.source, now);
  } else if (const auto* refused = std::get_if<JointTargetsRefused>(&command.body)) {
    e.owners.refuse(*refused);
    for (JointGroup& group : e.groups) group.refuse(*refused, now);
  } else if (std::holds_alternative<FindHeading>(command.body)) {
    e.owners.find_heading(id, e.estimate, e.health.report(), now, e.events);
  } else if (const auto* hand = std::get_if<DriveByHand>(&command.body)) {
    e.owners.drive_by_hand(command, *hand, e.health.report(), e.mechanics.proved(), now, e.events);
  } else if (const auto* follow = std::get_if<FollowTwist>(&command.body)) {
    e.owners.take(*follow, command.received, e.no_sideways(follow->twist), now);
  } else if (const auto* turned_away = std::get_if<TwistRefused>(&command.body)) {
    e.owners.refuse(*turned_away, now);
  } else if (const auto* release = std::get_if<ReleaseHold>(&command.body)) {
    e.release_hold(id, *release, now);
  } else if (std::holds_alternative<ArmHold>(command.body)) {
    e.arm_hold(id, now);
  } else if (std::holds_alternative<AcceptPosition>(command.body)) {
    e.accept_position(id, now);
  } else if (std::holds_alternative<ForgetLearned>(command.body)) {
    e.forget_learned(id, now);
  } else {
    e.events.push(now, CommandRefused{id, "an empty command"});
  }
}

void Engine::step(Time now, const Environment& environment, EngineOutput& out) {
  Impl& e = *impl_;
  std::fill_n(out.axes.begin(), e.axes.size(), AxisCommand{});
  out.base = {};
  out.events.clear();
  out.motion_permitted = false;
  std::fill_n(out.slowing_permitted.begin(), e.axes.size(), false);
  const Duration nominal = from_s(1.0 / e.config.tick_Hz);
  const Duration dt =
      e.last_step == kNever ? nominal : std::clamp(now - e.last_step, Duration{0}, kLongestCycle);
  e.last_step = now;
  for (std::size_t i = 0; i < e.axes.size(); ++i)
    Impl::look_at(e.axes[i], takes_twist(e.base) ? environment.base : environment.axes[i], now);
  LineTable lines;
  for (std::size_t i = 0; i < kLineCount; ++i) {
    // Any edge counts: what was active for an instant is active for the cycle.
    lines.active[i] = e.level[i] || e.pulse[i];
    e.snapshot.line_health[i] = environment.lines[i].state;
  }
  e.pulse.fill(false);
  e.choose_sensors(now, environment);
  e.estimate = e.estimator.step(now);
  e.snapshot.odometry = e.odometry.step(now, e.estimate);
  const std::span<const AxisSnapshot> axes = e.axes;
  const Reason moved = e.judge_motion(now, dt, lines, environment);
  e.watch_tilt(now, environment.imu_configured);
  e.place.update(now, dt, e.estimate, {e.rest.hears_wheels(), e.rest.misses_wheels()},
                 e.estimator.origin());
  if (e.navigator.active()) e.place.told();  // by the end of the task
  e.place_count.update(e.estimate, dt, e.place.jumped_at());
  const Pose& pose = e.estimate.pose;
  e.clearance.update(
      {now,
       {.twist = {pose.vx_mps, pose.wz_radps, pose.vy_mps}, .known = e.estimate.body.known},
       e.navigator.path_number(),
       e.commanded,
       e.asked,
       e.by_joints ? e.half_track_m() : 0});
  e.health.update({now, environment, axes, lines, e.estimate, e.estimator.has_origin(),
                   e.navigator.active(), e.latch.why(), &e.sensors, e.tilt.reason(), moved,
                   e.place.jumped(), e.latch.power_cut() && e.power.opened(), e.clearance.blocked(),
                   e.clearance.unknown(), e.clearance.broken(), &e.steep, &e.hit.reason(now)});
  if (e.health.report().nothing_moves()) e.stopped_at = now;
  e.watch_wheels(now, dt);
  const double cap_mps = e.mechanics.speed_cap_mps(FirstWay::task);
  NavOutput wanted = e.navigator.step(
      {now, dt, e.estimate, e.health.report(), e.wheel_fault, e.wheel_reason, e.owners.at_rest(),
       e.owners.refusal(), cap_mps, e.clearance.caps().along_mps, e.clearance.unasked(),
       !e.config.clearance_required && e.no_sideways({}).empty()},
      e.events);
  wanted.target = e.clearance.limit(e.aside.bounded(e.mechanics.guide(wanted.target)));
  const Learned learned{e.estimate.yaw_slip_factor};
  const Twist stream = twist_of(e.base, e.owners.stream_radps(), learned);
  const Twist by_twist = e.clearance.limit(e.aside.slowed(e.mechanics.guide(e.owners.by_twist())));
  if (!environment.slept.empty()) e.owners.slow_to(e.estimate.body);
  const Motion& motion = e.owners.step(
      {now, dt, e.estimate, e.health.report(), e.wheel_fault, e.wheel_reason, wanted, cap_mps,
       std::min(e.mechanics.speed_cap_mps(FirstWay::joints), e.aside.rim_cap_mps(stream)),
       e.mechanics.speed_cap_mps(FirstWay::hand), e.arming.hindrance(), stream,
       e.clearance.caps().ahead_mps, e.clearance.rim_cap_mps(stream, track_of_turn_m(e.base) / 2),
       e.clearance.too_near(), by_twist, e.steered_radpm()},
      e.events);
  e.commanded =
      motion.joints ? twist_of(e.base, e.owners.joint_velocities_radps(), learned) : motion.twist;
  e.asked = motion.asked;
  e.by_joints = motion.joints;
  const bool other = motion.owner == Owner::manual || motion.owner == Owner::cmd_vel ||
                     motion.owner == Owner::joint_command;
  if (other) e.navigator.make_way();
  const HealthReport& report = e.health.report();
  e.power.step(now,
               {e.latch.power_cut(), report.estop || !report.estop_known,
                e.arming.waits_for_lines(), environment.relay_found_closed},
               axes);
  e.arming.step({now, dt, e.health.report(), axes, motion.drives(), e.latch.ran_away(),
                 e.latch.power_cut(), environment.guard_has_bus, motion.joints},
                e.events);
  e.command_axes(motion, out);
  if (takes_twist(e.base)) e.command_base(out);
  e.step_groups(now, dt, environment, out);
  e.motion_asked = out.motion_permitted;
  out.unsettled = (e.rest.drives_on() || e.latch.power_cut()) && !e.power.opened();
  e.navigator.on_commanded(now, out.motion_permitted, e.events);
  e.learned_notices.tell(now, e.estimate, antenna_of(e.config.estimate, e.sensors.receiver()),
                         e.events);
  e.announcer.update(now, e.health.report(), e.events);
  e.fill_snapshot(now, environment, lines, e.estimate, motion.owner);
  if (takes_twist(e.base)) e.fill_base(environment, out.base);
  e.fill_viewpoint();
  out.outputs = e.snapshot.output_on =
      e.signals.step(now, e.snapshot, out.motion_permitted, motion.drives(), e.power.closed());
  e.latch.remember(out.remembered);
  out.remembered.holding = e.arming.armed();
  out.remembered.released = e.arming.released();
  out.remembered.task = e.navigator.active();
  out.remembered.mechanics_proved = e.mechanics.proved();
  out.remembered.at_rest = e.rest.knows_rest();
  out.remembered.place = e.place.rest_place(e.estimator.origin());
  e.events.drain(out.events);
}

void Engine::on_clearance(const Clearance& found) {
  impl_->clearance.on_clearance(found);
}

const Snapshot& Engine::snapshot() const {
  return impl_->snapshot;
}

}  // namespace drover::engine
