// Who moves the base, decided in one place: e-stop, manual, task, cmd_vel, joint commands, in that
// order.
#include "engine/own/owners.h"

#include <algorithm>
#include <cmath>

namespace drover::engine {
namespace {

constexpr const char* kNoPivot = "this base cannot turn on the spot: it steers";
constexpr const char* kByHand = "a person drives the robot with a key";
constexpr const char* kByTask = "a task owns the drives";
constexpr Duration kOldestTarget = std::chrono::milliseconds(100);

/// The same curve, its fastest rim no faster than that.
Twist slowed(const Kinematics& base, const Twist& twist, double cap_mps) {
  const double rim_mps = fastest_mps(base, twist);
  if (!(rim_mps > cap_mps)) return twist;
  const double share = std::max(cap_mps, 0.0) / rim_mps;
  return {share * twist.vx_mps, share * twist.wz_radps, share * twist.vy_mps};
}

}  // namespace

Owners::Owners(const EngineConfig& config, Latch& latch)
    : config_(config),
      latch_(latch),
      base_(kinematics_of(config.base)),
      body_(limits(base_)),
      twist_gate_(config.limits, kOldestTarget, body_),
      joint_gate_(config.base, config.limits),
      stream_(from_s(config.health.joint_command_timeout_s)),
      creep_(config),
      hand_busy_(kJustStarted),
      busy_(kJustStarted),
      twists_busy_(kJustStarted) {}

void Owners::take(const JointTargets& targets, Time now) {
  Reason busy = cmd_vel_.following() ? Reason("cmd_vel drives the robot") : busy_;
  if (busy.empty()) busy = latch_.hinders_joints();
  // What runs may go on, and nothing new begins.
  if (busy.empty() && !stream_.following()) busy = no_start_;
  stream_.take(targets, busy, now);
}

void Owners::take(const FollowTwist& follow, Time received, std::string_view no_sideways,
                  Time now) {
  if (follow.twist.vy_mps != 0 && !no_sideways.empty()) {
    Reason why;
    why.format("linear.y is %g: %.*s", follow.twist.vy_mps, static_cast<int>(no_sideways.size()),
               no_sideways.data());
    return cmd_vel_.refuse(why, now);
  }
  if (!body_.pivots && is_turn(follow.twist)) return cmd_vel_.refuse(kNoPivot, now);
  Reason busy = stream_.following() ? Reason("joint commands drive the robot") : twists_busy_;
  if (busy.empty()) busy = latch_.hinders_joints();
  if (busy.empty() && !cmd_vel_.following()) busy = no_start_;
  cmd_vel_.take(follow, received, busy, now);
}

void Owners::refuse(const TwistRefused& refused, Time now) {
  if (refused.ends) cmd_vel_.end(refused.reason);
  cmd_vel_.refuse(refused.reason, now);
}

double Owners::timeout_s(Owner owner) const {
  switch (owner) {
    case Owner::manual: return hand_.active() ? to_s(HandDrive::kHeld) : creep_.timeout_s();
    case Owner::task: return to_s(kOldestTarget);
    case Owner::cmd_vel: return to_s(TwistStream::kTimeout);
    case Owner::joint_command: return config_.health.joint_command_timeout_s;
    case Owner::estop:
    case Owner::nobody: break;
  }
  return kAbsent;
}

void Owners::find_heading(const RequestId& id, const Estimate& estimate, const HealthReport& health,
                          Time now, EventQueue& events) {
  Reason why = busy_;
  if (why.empty() && (!at_rest() || stream_.wants_motion() || cmd_vel_.wants_motion()))
    why = "the robot moves";
  if (why.empty() && health.near_zone) why = health.obstacle();
  if (why.empty()) why = health.no_start;
  creep_.start(id, why, estimate, health, now, events);
  if (!creep_.active()) return;
  stream_.end("the heading is being looked for");
  cmd_vel_.end("the heading is being looked for");
  latch_.reset(Act::take);
}

void Owners::drive_by_hand(const Command& command, const DriveByHand& wanted,
                           const HealthReport& health, bool proved, Time now, EventQueue& events) {
  Reason why = hand_busy_;
  // What runs may go on, and nothing new begins.
  if (why.empty() && !hand_.active_of(wanted.hand)) {
    if (stream_.wants_motion() || cmd_vel_.wants_motion() || !at_rest()) why = "the robot moves";
    if (why.empty()) why = health.no_start;
  }
  if (why.empty() && health.near_zone && !is_zero(wanted.twist)) why = health.obstacle();
  if (why.empty() && !body_.pivots && is_turn(wanted.twist)) why = kNoPivot;
  const Reason note = proved ? "" : "slowly, until wheels, gyro and receiver are seen to agree";
  hand_.take(command, wanted, why, note, now, events);
}

void Owners::cancel(Time now, EventQueue& events) {
  creep_.end("cancelled", now, events);
  hand_.end("cancelled", now, events);
  stream_.end("cancelled");
  cmd_vel_.end("cancelled");
}

Reason Owners::hinders_task() const {
  if (creep_.active()) return "the heading is being looked for: wait, or cancel it";
  if (hand_.active()) return "a person drives the robot with a key: wait, or cancel it";
  if (cmd_vel_.wants_motion() || (motion_.owner == Owner::cmd_vel && !at_rest()))
    return "cmd_vel moves the robot: end it first";
  if (stream_.wants_motion() || !joint_gate_.at_rest()) {
    return "joint commands move the robot: end them first";
  }
  return {};
}

void Owners::on_task_started() {
  stream_.end(kByTask);
  cmd_vel_.end(kByTask);
  latch_.reset(Act::take);
  if (at_rest()) twist_gate_.reset();
}

/// Why nobody but a task may move the base now.
Reason Owners::hindrance(const OwnInput& input) const {
  if (const Reason why = input.health.hinders_all(); !why.empty()) return why;
  if (!input.health.end_free_driving.empty()) return input.health.end_free_driving;
  if (const Reason why = latch_.hinders_all(); !why.empty()) return why;
  if (!input.not_held.empty()) return input.not_held;
  if (input.task.drives) return kByTask;
  return {};
}

/// Why joint commands may not move it either.
Reason Owners::hinders_joints(const OwnInput& input) const {
  if (const Reason why = hindrance(input); !why.empty()) return why;
  if (creep_.active()) return "the heading is being looked for";
  if (hand_.active()) return kByHand;
  // One gate moves at a time: what a stream asked would hide a ramp, and then go on with it.
  if (!twist_gate_.at_rest()) return "the robot comes to rest";
  return {};
}

/// Why cmd_vel may not move it either.
Reason Owners::hinders_twists(const OwnInput& input) const {
  if (const Reason why = hindrance(input); !why.empty()) return why;
  if (creep_.active()) return "the heading is being looked for";
  if (hand_.active()) return kByHand;
  if (!joint_gate_.at_rest() || (!cmd_vel_.following() && !twist_gate_.at_rest()))
    return "the robot comes to rest";
  return {};
}

Owner Owners::rank(const OwnInput& input) const {
  if (input.health.estop) return Owner::estop;
  if (creep_.active() || hand_.active()) return Owner::manual;
  if (input.task.drives) return Owner::task;
  if (cmd_vel_.following()) return Owner::cmd_vel;
  if (stream_.following()) return Owner::joint_command;
  return Owner::nobody;
}

Twist Owners::asked(const OwnInput& input, const Twist& creep) const {
  switch (motion_.owner) {
    case Owner::manual: return creep_.active() ? creep : hand_.wanted();
    case Owner::task: return input.task.asked;
    case Owner::cmd_vel: return cmd_vel_.wanted();
    case Owner::joint_command: return input.stream;
    case Owner::estop:
    case Owner::nobody: break;
  }
  return {};
}

/// Why everything stops without a ramp.
Reason Owners::why_at_once(const OwnInput& input) const {
  if (input.wheels != WheelFault::none) return input.wheel_reason;
  return input.health.stop.empty() ? latch_.stop() : input.health.stop;
}

/// `anyone`: whoever drove, or else only the streams.
void Owners::latch(const Reason& why, bool anyone) {
  // What moves after the end of its stream is still that stream's motion.
  const bool streams = stream_.following() || !joint_gate_.at_rest() || cmd_vel_.following() ||
                       motion_.owner == Owner::cmd_vel;
  const bool drove = motion_.owner == Owner::task || motion_.owner == Owner::manual;
  if (!streams && !(anyone && drove)) return;
  latch_.set(Latched::stream_stopped, why);
  stream_.end(why);
  cmd_vel_.end(why);
}

/// What ends the stream, and how its motion ends then.
Stop Owners::watch_stream(const OwnInput& input, bool at_once) {
  stream_.step(input.now);
  if (at_once) latch(why_at_once(input), input.health.holds_any(kByPeople));
  if (!busy_.empty()) stream_.end(busy_);
  if (input.health.near_zone && stream_.wants_motion()) stream_.meet(input.health.obstacle());
  if (!stream_.following()) {
    stream_drives_.begin();
    return Stop::controlled;
  }
  const bool late = input.now - stream_.since() > from_s(config_.navigate.start_timeout_s);
  switch (stream_drives_.look(input.health.drives_running, late)) {
    case Drives::asked:
    case Drives::arming: return Stop::controlled;
    case Drives::armed: return Stop::none;
    case Drives::late:
    case Drives::lost: break;
  }
  latch(input.health.not_running, false);
  return Stop::immediate;
}

/// What ends driving by hand, and how fast it is let go on.
Owners::ByTwist Owners::watch_hand(const OwnInput& input, bool at_once, double cap_mps,
                                   EventQueue& events) {
  hand_.step(input.now);
  hand_busy_ = hindrance(input);
  if (hand_busy_.empty() && creep_.active()) hand_busy_ = "the heading is being looked for";
  if (at_once) hand_.end(why_at_once(input), input.now, events);
  if (!hand_busy_.empty()) hand_.end(hand_busy_, input.now, events);
  const Twist wanted = hand_.wanted();
  if (input.health.near_zone && !is_zero(wanted))
    hand_.end(input.health.obstacle(), input.now, events);
  if (!hand_.active()) {
    hand_since_ = kNever;
    hand_moved_ = false;
    return {};
  }
  if (hand_since_ == kNever) {
    hand_since_ = input.now;
    hand_drives_.begin();
  }
  const bool late = input.now - hand_since_ > from_s(config_.navigate.start_timeout_s);
  const Drives drives = hand_drives_.look(input.health.drives_running, late);
  switch (drives) {
    case Drives::armed: break;
    case Drives::asked:
    case Drives::arming: return {};
    case Drives::late:
    case Drives::lost:
      hand_.end(input.health.not_running, input.now, events);
      return {{}, drives == Drives::lost};
  }
  if (is_zero(wanted)) return {};
  // What is latched stays: whoever holds a key thinks of what it moves, and not of a stream of
  // joint commands that waits for a person since it was stopped.
  if (!hand_moved_) events.notice(input.now, Notice::Level::info, kByHand);
  hand_moved_ = true;
  return {slowed(base_, input.twist, cap_mps)};
}

/// What ends cmd_vel, and how fast it is let go on.
Owners::ByTwist Owners::watch_cmd_vel(const OwnInput& input, bool at_once, double cap_mps) {
  cmd_vel_.step(input.now);
  if (at_once) cmd_vel_.end(why_at_once(input));
  twists_busy_ = hinders_twists(input);
  if (!twists_busy_.empty()) cmd_vel_.end(twists_busy_);
  if (input.health.near_zone && cmd_vel_.wants_motion()) cmd_vel_.meet(input.health.obstacle());
  if (!cmd_vel_.following()) {
    cmd_vel_drives_.begin();
    return {};
  }
  const bool late = input.now - cmd_vel_.since() > from_s(config_.navigate.start_timeout_s);
  switch (cmd_vel_drives_.look(input.health.drives_running, late)) {
    case Drives::armed: break;
    case Drives::asked:
    case Drives::arming: return {};
    case Drives::late:
    case Drives::lost: latch(input.health.not_running, false); return {{}, true};
  }
  // What it asked for before something ended it is not in `input.twist` any more.
  return {is_zero(cmd_vel_.wanted()) ? Twist{} : slowed(base_, input.twist, cap_mps)};
}

const Motion& Owners::step(const OwnInput& input, EventQueue& events) {
  no_start_ = input.health.no_start;
  const bool at_once = input.task.stop == Stop::immediate || !input.health.stop.empty() ||
                       input.wheels != WheelFault::none;
  if (at_once) creep_.end(why_at_once(input), input.now, events);
  if (!input.health.end_task.empty()) creep_.end(input.health.end_task, input.now, events);
  Twist creep = creep_.step(input.now, input.dt, input.estimate, input.health, events);
  // A task keeps the far zone's speed by itself, so that it slows along its track.
  const double zone_mps = input.health.far_zone ? config_.navigate.far_zone_speed_mps : 1e9;
  const Twist search = creep;
  creep.vx_mps = std::min({creep.vx_mps, input.speed_cap_mps, zone_mps, input.ahead_cap_mps});
  const auto [by_hand, hand_lost] =
      watch_hand(input, at_once, std::min(input.hand_cap_mps, zone_mps), events);
  busy_ = hinders_joints(input);
  const Stop stream_stop = watch_stream(input, at_once);
  const auto [by_program, program_lost] =
      watch_cmd_vel(input, at_once, std::min(input.joints_cap_mps, zone_mps));

  motion_.owner = rank(input);
  motion_.asked = asked(input, search);
  const bool manual = motion_.owner == Owner::manual;
  const Offer offer{motion_.owner == Owner::joint_command ? Owner::nobody : motion_.owner,
                    motion_.owner == Owner::cmd_vel ? by_program
                    : !manual                       ? input.task.target
                    : creep_.active()               ? creep
                                                    : by_hand,
                    input.now};
  const bool no_ramp = at_once || input.too_near;
  // A key that is up is a stop: with all of the deceleration, along the curve.
  const bool key_is_up = manual && hand_.active() && is_zero(by_hand);
  const bool program = motion_.owner == Owner::cmd_vel;
  // One side is dead: a ramp of the other one would turn the robot.
  const bool one_side = hand_lost || program_lost || creep_.lost();
  const Stop twist_stop = no_ramp || one_side                             ? Stop::immediate
                          : key_is_up || (program && is_zero(by_program)) ? Stop::controlled
                          : manual || program                             ? Stop::none
                                                                          : input.task.stop;
  twist_gate_.find_wheels(input.curvature_radpm);
  motion_.twist = twist_gate_.step(input.now, input.dt, {&offer, 1}, twist_stop);
  // One gate moves at a time: the other waits until it has come to rest.
  const Stop joint_stop = no_ramp                 ? Stop::immediate
                          : twist_gate_.at_rest() ? stream_stop
                                                  : Stop::controlled;
  joint_gate_.step(input.dt, stream_.velocities_radps(), input.estimate.yaw_slip_factor,
                   std::min({input.joints_cap_mps, zone_mps, input.rim_cap_mps}), joint_stop);
  motion_.joints = motion_.owner == Owner::joint_command || !joint_gate_.at_rest();
  motion_.at_once = at_once;
  // A stop ramp is still the motion of the one who drove.
  if (manual || program || motion_.owner == Owner::task) drove_ = motion_.owner;
  if (motion_.owner == Owner::nobody && !at_rest()) {
    motion_.owner = motion_.joints ? Owner::joint_command : drove_;
  }
  stream_.announce(input.now, events);
  cmd_vel_.announce(input.now, events);
  return motion_;
}

}  // namespace drover::engine
