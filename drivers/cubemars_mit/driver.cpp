// The state machine: when a CubeMars motor is looked for, enabled, commanded and given up.
#include "drivers/cubemars_mit/driver.h"

namespace drover::cubemars_mit {
namespace {

using mit::is_due;
using std::chrono::milliseconds;
constexpr Duration kAttemptEach = milliseconds(20);
constexpr Duration kPoll = milliseconds(10);
/// Of a motor that was never heard: perhaps nobody is on the bus, and nothing is acknowledged.
constexpr Duration kSearch = milliseconds(100);
/// Before it is looked for by letting it go: the guard, or who was here before, may make it damp.
constexpr Duration kListen = milliseconds(200);
/// A motor that is silent for so long has lost its supply, or let down what it carried.
constexpr Duration kGivenUp = milliseconds(3000);

}  // namespace

CubemarsDriver::CubemarsDriver(const Settings& settings, AxisId axis)
    : settings_(settings),
      axis_(axis),
      packer_(settings.joint),
      recipe_(settings.joint.stop_recipe()),
      damp_(settings.joint.damp_frame()),
      talk_(settings.setpoint_period) {
  const std::uint32_t id = settings.joint.id;
  static_cast<void>(hears_.push_back(FrameFilter{id}));
  if (!settings.answers_under_its_own())
    static_cast<void>(hears_.push_back(FrameFilter{settings.master_id}));
  static_cast<void>(rules_.push_back(FrameRule{.id = id, .min_len = 8, .max_len = 8}));
  // Motors of the open firmware answer under one id, and tell by their own which of them speaks.
  // Nothing is sent under it: all there is forbidden.
  if (settings.master_id == 0)
    static_cast<void>(
        rules_.push_back(FrameRule{.id = 0, .min_len = 8, .max_len = 8, .shared = true}));
  if (settings.timeout_ms > 0) {
    silence_text_.format("goes limp after %.3f s (its time-out, as it was set in the motor)",
                         static_cast<double>(settings.timeout_ms) / 1000);
  } else {
    silence_text_ = "may follow its last command for ever: its time-out is not known";
  }
}

bool CubemarsDriver::silent(Time now) const {
  return heard_.last_alive == kNever || now - heard_.last_alive > settings_.stale_after;
}

bool CubemarsDriver::attempts_to_run() const {
  return phase_ == Phase::arming || phase_ == Phase::running;
}

/// A motor that damps until it is asked to run anew is a fault for whoever counts on it.
void CubemarsDriver::lock(std::string_view why) {
  phase_ = Phase::locked;
  if (power_ == Power::on) power_ = Power::unknown;
  fault_ = true;
  lock_reason_.assign(why);
}

void CubemarsDriver::start_arming(Time now) {
  fault_ = false;
  lock_reason_.clear();
  attempts_ = 0;
  last_attempt_ = kNever;
  phase_since_ = now;
  if (silent(now)) return lock("asked to run while the motor was silent");
  phase_ = Phase::arming;
}

void CubemarsDriver::send_command(const CanFrame& frame, Time now, DriverOut& out) {
  talk_.command(frame, mit::effect(frame, settings_.joint.id), now, out);
}

/// From now on it is told nothing else, until it is asked to run.
void CubemarsDriver::let_go(Time now) {
  power_ = Power::leaving;
  leaving_since_ = now;
  talk_.begin();
}

void CubemarsDriver::leave(Duration period, Time now, DriverOut& out) {
  const bool first = leaving_since_ == kNever;
  if (!first && !is_due(talk_.last(), period, now)) return;
  if (first) leaving_since_ = now;
  talk_.send(encode_special(settings_.joint.id, Special::disable), now, out);
}

/// Nobody else makes it damp: the guard may hang, and the motor hold a weight since before this
/// program began. Damping enables nothing, and what pushes against it is on.
void CubemarsDriver::damp_alone(Time now, DriverOut& out) {
  const bool guarded = now - listening_since_ <= 2 * mit::kStopPeriod || guard_.goes_on(now);
  if (phase_ != Phase::idling && !guarded && is_due(talk_.last(), kPoll, now))
    send_command(damp_, now, out);
}

/// Each frame brings one answer, and none only asks. What is off is told again to let go; what may
/// be on is made to damp, though nobody hears it: it may obey and only its answers be lost.
void CubemarsDriver::keep_alive(Time now, DriverOut& out) {
  if (listening_since_ == kNever) listening_since_ = now;
  const bool listens = power_ == Power::leaving && leaving_since_ == kNever;
  if (listens && now - listening_since_ < kListen) return damp_alone(now, out);
  const Time since = heard_.last_alive == kNever ? listening_since_ : heard_.last_alive;
  if (power_ == Power::unknown && now - since > kGivenUp) let_go(now);
  const bool stays_off = power_ == Power::leaving || power_ == Power::off;
  if (stays_off) return leave(silent(now) ? kSearch : kPoll, now, out);
  // One that was never heard needs no more than the guard's frames.
  if (heard_.last_good != kNever || !guard_.goes_on(now)) send_command(damp_, now, out);
}

/// The first thing that it follows is damping: what it was told before it was off may still stand
/// in it.
void CubemarsDriver::arm(Time now, DriverOut& out) {
  if (now - heard_since_ < settings_.settle || feedback_.failed()) return keep_alive(now, out);
  power_ = Power::unknown;
  const bool again = is_due(last_attempt_, kAttemptEach, now);
  if (attempts_ == kAttempts || !again) return send_command(damp_, now, out);
  ++attempts_;
  last_attempt_ = now;
  talk_.send(damp_, now, out);
  out.send(encode_special(settings_.joint.id, Special::enable));
}

/// What ends a run though no frame says so. A motor that was left alone for long forgot what it was
/// told, and would follow the next frame at once.
void CubemarsDriver::look_at_gaps(Time now) {
  if (power_ == Power::on && silent(now)) power_ = Power::unknown;
  if (attempts_to_run() && silent(now)) lock("its answers ceased while armed");
  if (phase_ == Phase::running && now - talk_.last() > settings_.unfed_after())
    lock("nothing was sent to it for so long that it may have let go");
}

void CubemarsDriver::control(const Setpoint& command, Time now, DriverOut& out) {
  look_at_gaps(now);
  switch (phase_) {
    case Phase::running: send_command(packer_.frame_of(command), now, out); return;
    case Phase::arming: arm(now, out); return;
    case Phase::idling: {
      const bool may_be_on = power_ == Power::unknown || power_ == Power::on;
      const bool due =
          letting_go_.is_due(silent(now) ? kAbsent : feedback_.motion.velocity_radps, now);
      if (may_be_on && due) let_go(now);
      break;
    }
    case Phase::resting:
    case Phase::locked: break;
  }
  keep_alive(now, out);
}

void CubemarsDriver::on_setpoints(std::span<const Setpoint> wanted, Time now, DriverOut& out) {
  if (!wanted.empty()) take(wanted.front(), now, out);
}

void CubemarsDriver::take(const Setpoint& command, Time now, DriverOut& out) {
  commanded_ = true;
  const bool was = arms(request_);
  const bool changed = command.request != request_;
  request_ = command.request;
  // From following to holding and back it stays as it is, and what was given up is armed anew.
  if (changed && arms(request_) && (!was || phase_ == Phase::locked)) start_arming(now);
  if (changed && !arms(request_)) {
    phase_ = request_ == AxisRequest::idle ? Phase::idling : Phase::resting;
    phase_since_ = now;
    letting_go_.begin(now);
    if (was) {
      fault_ = false;
      lock_reason_.clear();
    }
  }
  control(command, now, out);
}

void CubemarsDriver::on_tick(Time now, DriverOut& out) {
  // Nobody decided this cycle: damping, as at rest.
  if (!commanded_) control(Setpoint{}, now, out);
  commanded_ = false;
  report_status(now, out);
}

/// What was on may still be, and what was off was not made to be otherwise from here.
void CubemarsDriver::on_link_up(Time now) {
  heard_.last_alive = kNever;
  heard_since_ = kNever;
  listening_since_ = now;
  feedback_ = {};
  talk_.begin();
  if (power_ == Power::on) power_ = Power::unknown;
  // What was said to nobody, before there was a link, was not said.
  if (heard_.last_good == kNever) leaving_since_ = kNever;
  if (arms(request_)) lock("the link was lost while armed");
}

Effect CubemarsDriver::effect(const Message& message, Time) const {
  const CanFrame* const frame = message.frame();
  if (frame == nullptr) return {};
  FrameEffect kind = mit::effect(*frame, settings_.joint.id);
  const auto special = mit::decode_special(*frame, settings_.joint.id);
  // DAMIAO's word: this motor takes it for a set point with all at its ends.
  if (special == Special::clear_error) kind = FrameEffect::forbidden;
  // To one that was never heard it is the question whether it is there.
  if (special == Special::disable && heard_.last_good == kNever) kind = FrameEffect::harmless;
  // By its first byte an answer of the motor's, and no stop of anybody's.
  const bool may_answer = settings_.answers_under_its_own() && frame->data[0] == settings_.joint.id;
  if (kind == FrameEffect::stop && may_answer) kind = FrameEffect::forbidden;
  return {kind, kind == FrameEffect::motion ? channel_bit(0) : ChannelMask{0}};
}

double CubemarsDriver::setpoint_radps(const Message& message, std::size_t) const {
  return message.frame() == nullptr ? kAbsent : settings_.joint.setpoint_radps(*message.frame());
}

}  // namespace drover::cubemars_mit
