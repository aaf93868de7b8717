// The state machine: when an ODrive axis is armed, fed, commanded and given up.
#include "drivers/odrive/driver.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace drover::odrive {
namespace {

using std::chrono::milliseconds;
constexpr Duration kRetry = milliseconds(100);
/// A heartbeat that was under way when the request left tells nothing of it.
constexpr Duration kSettle = milliseconds(20);
/// Errors that were cleared must be gone in the heartbeat after the next.
constexpr Duration kClearTime = milliseconds(250);
constexpr double kSlow_radps = 0.1;
constexpr Duration kIdleAtLast = milliseconds(1000);

StopRecipe recipe_of(std::uint8_t node) {
  StopRecipe recipe;
  StopRound zero;
  static_cast<void>(zero.frames.push_back(encode_set_input_vel(node, 0)));
  static_cast<void>(recipe.rounds.push_back(zero));
  recipe.period = milliseconds(10);
  // Closed loop at zero holds on a slope, and the frames keep the watchdog from letting go.
  recipe.ends = StopEnds::holds;
  return recipe;
}

}  // namespace

OdriveDriver::OdriveDriver(const Settings& settings, AxisId axis)
    : settings_(settings),
      axis_(axis),
      hears_{frame_id(settings.node, 0), 0x7E0, false},
      rules_(rules_of(settings)),
      recipe_(recipe_of(settings.node)),
      poller_(settings),
      watchdog_(settings) {
  if (settings.watchdog_timeout_s > 0) {
    silence_text_.format("free-wheels after %.3f s (its watchdog, %s)", settings.watchdog_timeout_s,
                         settings.sets_watchdog() ? "set and read back at each arming"
                                                  : "saved in the drive as configured");
  } else {
    silence_text_ = "keeps its last velocity for ever: the drive has no watchdog set";
  }
}

bool OdriveDriver::silent(Time now) const {
  return heard_.last_alive == kNever || now - heard_.last_alive > settings_.heartbeat_timeout;
}

bool OdriveDriver::attempts_to_run() const {
  return phase_ == Phase::configuring || phase_ == Phase::arming || phase_ == Phase::running;
}

/// A drive that holds at zero until it is asked to run anew is a fault for whoever counts on it.
void OdriveDriver::lock(std::string_view why) {
  phase_ = Phase::locked;
  fault_ = true;
  lock_reason_.assign(why);
}

void OdriveDriver::start_arming(Time now, DriverOut& out) {
  fault_ = false;
  lock_reason_.clear();
  cleared_at_ = kNever;
  attempted_ = false;
  arming_step_ = ArmingStep::first;
  phase_since_ = now;
  if (silent(now)) {
    lock("asked to run while the drive was silent");
    return;
  }
  phase_ = Phase::arming;
  if (settings_.sets_watchdog()) {
    phase_ = Phase::configuring;
    watchdog_.begin(now);
  }
  report_status(now, false, out);
}

/// What the newest heartbeat means for what is under way.
void OdriveDriver::follow_heartbeat(Time now) {
  const bool closed_loop = heartbeat_.state == kStateClosedLoop;
  if (phase_ == Phase::running) {
    // The state alone is a fault too: a drive whose motor or encoder is unplugged may report no
    // error at all.
    if (heartbeat_.failed() || !closed_loop) {
      lock(closed_loop ? "drive reports an error" : "left closed loop");
      poller_.hurry();
    }
  } else if (phase_ == Phase::arming && attempted_) {
    if (heartbeat_.failed()) {
      if (cleared_at_ != kNever && now - cleared_at_ > kClearTime) {
        lock("error does not clear");
        poller_.hurry();
      }
    } else if (closed_loop && now - phase_since_ >= kSettle) {
      phase_ = Phase::running;
    }
  }
}

double OdriveDriver::motor_turnps(double velocity_radps) {
  const double turnps =
      velocity_radps * settings_.gear_ratio * settings_.sign / (2 * std::numbers::pi);
  if (!std::isfinite(turnps)) {
    ++bad_setpoints_;
    return 0;
  }
  if (std::abs(turnps) > settings_.velocity_limit_turnps) {
    ++bad_setpoints_;
    return std::copysign(settings_.velocity_limit_turnps, turnps);
  }
  return turnps;
}

void OdriveDriver::send_setpoint(double turnps, Time now, bool at_once, DriverOut& out) {
  const bool stops = turnps == 0 && last_turnps_ != 0;
  if (!at_once && !stops && now - last_setpoint_ < settings_.setpoint_period) return;
  last_setpoint_ = now;
  last_turnps_ = turnps;
  out.send(encode_set_input_vel(settings_.node, turnps));
}

/// One step a cycle: the bus takes two frames of each drive in one, what is more is lost, and all
/// drives are armed at once.
void OdriveDriver::arm(Time now, DriverOut& out) {
  switch (arming_step_) {
    case ArmingStep::first:
      last_attempt_ = now;
      if (heartbeat_.failed() && cleared_at_ == kNever) {
        // Once for each request: an error that comes back is for a person to look at.
        cleared_at_ = now;
        out.send(encode_clear_errors(settings_.node));
        errors_ = {};
        arming_step_ = ArmingStep::mode;
        break;
      }
      [[fallthrough]];
    case ArmingStep::mode:
      out.send(encode_set_controller_mode(settings_.node, kControlVelocity, kInputPassthrough));
      arming_step_ = ArmingStep::state;
      break;
    case ArmingStep::state:
      attempted_ = true;
      // A wheel that rolls is caught at its own speed.
      send_setpoint(holding_turnps_, now, true, out);
      out.send(encode_set_axis_state(settings_.node, kStateClosedLoop));
      arming_step_ = ArmingStep::first;
      break;
  }
}

void OdriveDriver::control(const Setpoint& command, Time now, DriverOut& out) {
  const bool holds = command.request == AxisRequest::hold;
  holding_turnps_ = holds ? motor_turnps(command.velocity_radps) : 0;
  if (heard_.last_alive == kNever) return feed_blindly(command.held, now, out);
  if (attempts_to_run() && silent(now)) lock("heartbeat ceased while armed");
  if (phase_ == Phase::configuring || phase_ == Phase::arming) {
    if (now - phase_since_ > settings_.arming_timeout) {
      Reason why = "does not enter closed loop";
      const auto result = procedure_text(heartbeat_.procedure_result);
      if (!result.empty())
        why.format("does not enter closed loop: %.*s", static_cast<int>(result.size()),
                   result.data());
      lock(why);
      poller_.hurry();
    }
  }
  const bool attempt = now - last_attempt_ >= kRetry;
  switch (phase_) {
    case Phase::configuring:
      watchdog_.on_tick(now, out);
      if (watchdog_.failed()) {
        lock(watchdog_.reason());
      } else if (watchdog_.done()) {
        phase_ = Phase::arming;
        phase_since_ = now;
      }
      break;
    case Phase::arming:
      if (arming_step_ != ArmingStep::first || !attempted_ || attempt) arm(now, out);
      break;
    case Phase::running:
      send_setpoint(motor_turnps(command.velocity_radps), now, false, out);
      return;
    case Phase::idling:
      if (heartbeat_.state != kStateIdle && attempt &&
          (std::abs(velocity_radps_) < kSlow_radps || now - phase_since_ > kIdleAtLast)) {
        last_attempt_ = now;
        send_setpoint(0, now, true, out);
        out.send(encode_set_axis_state(settings_.node, kStateIdle));
      }
      break;
    case Phase::resting:
    case Phase::locked: break;
  }
  if (has_room(out)) send_setpoint(phase_ == Phase::locked ? 0 : holding_turnps_, now, false, out);
}

/// Never a frame to a node that was not heard, unless it holds the robot, by what it said before
/// its link was lost or by what the program before this one knew: its answers alone may be lost,
/// and its watchdog would let go. A zero arms nothing. Not one that a person let go of.
void OdriveDriver::feed_blindly(bool held, Time now, DriverOut& out) {
  if (request_ == AxisRequest::idle) may_hold_ = false;
  const bool feeds = (may_hold_ || held) && request_ != AxisRequest::idle;
  if (feeds) send_setpoint(0, now, false, out);
}

/// Of this cycle: what is more than its share would be lost on the bus.
bool OdriveDriver::has_room(const DriverOut& out) const {
  return out.frames.size() < before_ + messages_per_cycle();
}

void OdriveDriver::on_setpoints(std::span<const Setpoint> wanted, Time now, DriverOut& out) {
  before_ = out.frames.size();
  if (!wanted.empty()) take(wanted.front(), now, out);
}

void OdriveDriver::take(const Setpoint& command, Time now, DriverOut& out) {
  commanded_ = true;
  if (command.request != request_) {
    const AxisRequest before = request_;
    request_ = command.request;
    if (arms(request_)) {
      start_arming(now, out);
    } else {
      phase_ = request_ == AxisRequest::idle ? Phase::idling : Phase::resting;
      phase_since_ = now;
      if (arms(before)) {
        fault_ = false;
        lock_reason_.clear();
      }
    }
  }
  control(command, now, out);
}

void OdriveDriver::on_tick(Time now, DriverOut& out) {
  // Nobody decided this cycle: zero, as at rest.
  if (!commanded_) {
    before_ = out.frames.size();
    control(Setpoint{}, now, out);
  }
  commanded_ = false;
  if (heard_.last_alive != kNever && has_room(out)) poller_.on_tick(now, out);
  report_status(now, false, out);
}

void OdriveDriver::on_link_up(Time now) {
  heard_.last_alive = kNever;
  last_estimates_ = kNever;
  heartbeat_ = {};
  errors_ = {};
  effort_at_ = kNever;
  last_turnps_ = 0;
  poller_.restart(now);
  if (arms(request_)) lock("the link was lost while armed");
}

Effect OdriveDriver::effect(const Message& message, Time) const {
  const CanFrame* const frame = message.frame();
  if (frame == nullptr) return {};
  const FrameEffect kind = odrive::effect(*frame, settings_);
  return {kind, kind == FrameEffect::motion ? channel_bit(0) : ChannelMask{0}};
}

double OdriveDriver::setpoint_radps(const Message& message, std::size_t) const {
  if (message.frame() == nullptr) return kAbsent;
  const CanFrame& frame = *message.frame();
  const bool velocity =
      belongs_to(frame, settings_.node) && command_of(frame.id) == cmd::kSetInputVel;
  const auto pair = velocity && !frame.remote ? decode_floats(frame) : std::nullopt;
  // With a torque on top it is not the velocity alone that moves the wheel.
  if (!pair || pair->second != 0.0F) return kAbsent;
  return static_cast<double>(pair->first) * 2 * std::numbers::pi * settings_.sign /
         settings_.gear_ratio;
}

SilenceBehaviour OdriveDriver::silence() const {
  SilenceBehaviour behaviour;
  behaviour.stops = settings_.watchdog_timeout_s > 0;
  behaviour.after = from_s(settings_.watchdog_timeout_s);
  behaviour.text = silence_text_.view();
  return behaviour;
}

}  // namespace drover::odrive
