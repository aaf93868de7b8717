// The state machine: when a DAMIAO motor is asked, enabled, commanded and given up.
#include "drivers/damiao/driver.h"

#include "drivers/damiao/rules.h"

namespace drover::damiao {
namespace {

using mit::is_due;
using std::chrono::milliseconds;
constexpr Duration kRetry = milliseconds(100);
constexpr Duration kPoll = milliseconds(10);
/// Of a motor that was never heard: perhaps nobody is on the bus, and nothing is acknowledged.
constexpr Duration kSearch = milliseconds(100);

}  // namespace

DamiaoDriver::DamiaoDriver(const Settings& settings, AxisId axis)
    : settings_(settings),
      packer_(settings.joint),
      axis_(axis),
      hears_{FrameFilter{settings.master_id}, FrameFilter{settings.joint.id},
             FrameFilter{kRequestId}},
      rules_(rules_of(settings)),
      recipe_(settings.joint.stop_recipe()),
      damp_(settings.joint.damp_frame()),
      setup_(settings),
      talk_(settings.setpoint_period) {
  if (settings.timeout_ms > 0) {
    silence_text_.format("goes limp after %.3f s (its TIMEOUT, set and read back at each arming)",
                         static_cast<double>(settings.timeout_ms) / 1000);
  } else {
    silence_text_ = "follows its last command for ever: the motor's TIMEOUT is 0";
  }
}

bool DamiaoDriver::silent(Time now) const {
  return heard_.last_alive == kNever || now - heard_.last_alive > settings_.stale_after;
}

bool DamiaoDriver::attempts_to_run() const {
  return phase_ == Phase::arming || phase_ == Phase::running;
}

/// A motor that damps until it is asked to run anew is a fault for whoever counts on it.
void DamiaoDriver::lock(std::string_view why) {
  phase_ = Phase::locked;
  fault_ = true;
  lock_reason_.assign(why);
}

void DamiaoDriver::start_arming(Time now, DriverOut& out) {
  fault_ = false;
  lock_reason_.clear();
  cleared_at_ = kNever;
  first_attempt_ = last_attempt_ = kNever;
  phase_since_ = now;
  if (silent(now)) {
    lock("asked to run while the motor was silent");
    return;
  }
  phase_ = Phase::arming;
  // What is off may have lost its supply and what stands only in its memory.
  if (!feedback_.enabled() || !setup_.done()) setup_.begin();
  report_status(now, false, out);
}

void DamiaoDriver::send_command(const CanFrame& frame, Time now, DriverOut& out) {
  talk_.command(frame, damiao::effect(frame, settings_), now, out);
}

/// Each frame brings one feedback. What is surely off is asked; what is not is made to damp, though
/// nobody hears it: it may obey and only its answers be lost. So is what tells a status that nobody
/// has documented.
void DamiaoDriver::keep_alive(Time now, DriverOut& out) {
  if (heard_.last_alive == kNever) return look_for_it(now, out);
  if (silent(now) || !feedback_.off()) return send_command(damp_, now, out);
  if (is_due(talk_.last(), kPoll, now)) talk_.send(encode_request(settings_.joint.id), now, out);
}

/// It may have held a weight before this program began, or before the link was lost, and obey
/// though its answers do not come: a question would leave it to its time-out, which lets go.
/// Damping enables nothing, and its zeros are zeros in every range. Who wants it let go gets that.
void DamiaoDriver::look_for_it(Time now, DriverOut& out) {
  const bool damps = phase_ != Phase::idling && !guard_.goes_on(now);
  if (damps && is_due(talk_.last(), kPoll, now)) talk_.send(damp_, now, out);
  // One that is in another mode answers to nothing else.
  if (!is_due(last_sought_, kSearch, now)) return;
  last_sought_ = now;
  out.send(encode_request(settings_.joint.id));
}

/// The first thing that it follows is damping: what it was told before it was off may still stand
/// in it.
void DamiaoDriver::arm(Time now, DriverOut& out) {
  if (!setup_.done() || now - heard_since_ < settings_.settle) return keep_alive(now, out);
  if (first_attempt_ == kNever) first_attempt_ = now;
  if (feedback_.failed()) {
    // Once for each request: an error that comes back is for a person to look at.
    if (cleared_at_ == kNever) {
      cleared_at_ = now;
      out.send(encode_special(settings_.joint.id, Special::clear_error));
      return;
    }
  } else if (!feedback_.enabled() && is_due(last_attempt_, kRetry, now)) {
    last_attempt_ = now;
    talk_.send(damp_, now, out);
    out.send(encode_special(settings_.joint.id, Special::enable));
    return;
  }
  keep_alive(now, out);
}

void DamiaoDriver::look_at_arming(Time now) {
  if (attempts_to_run() && silent(now)) lock("its answers ceased while armed");
  if (phase_ != Phase::arming) return;
  if (setup_.failed()) return lock(setup_.reason().view());
  if (first_attempt_ == kNever || now - first_attempt_ <= settings_.arming_timeout) return;
  lock("it does not let itself be enabled");
}

void DamiaoDriver::control(const Setpoint& command, Time now, DriverOut& out) {
  look_at_arming(now);
  switch (phase_) {
    case Phase::running: send_command(packer_.frame_of(command), now, out); return;
    case Phase::arming: arm(now, out); break;
    case Phase::idling: {
      const bool again = is_due(last_attempt_, kRetry, now);
      const bool due = letting_go_.is_due(feedback_.motion.velocity_radps, now);
      if (!silent(now) && feedback_.enabled() && again && due) {
        last_attempt_ = now;
        talk_.send(encode_special(settings_.joint.id, Special::disable), now, out);
        break;
      }
      keep_alive(now, out);
      break;
    }
    case Phase::resting:
    case Phase::locked: keep_alive(now, out); break;
  }
}

void DamiaoDriver::on_setpoints(std::span<const Setpoint> wanted, Time now, DriverOut& out) {
  before_ = out.frames.size();
  if (!wanted.empty()) take(wanted.front(), now, out);
}

void DamiaoDriver::take(const Setpoint& command, Time now, DriverOut& out) {
  commanded_ = true;
  const bool was = arms(request_);
  const bool changed = command.request != request_;
  request_ = command.request;
  // From following to holding and back it stays as it is, and what was given up is armed anew.
  if (changed && arms(request_) && (!was || phase_ == Phase::locked)) start_arming(now, out);
  if (changed && !arms(request_)) {
    phase_ = request_ == AxisRequest::idle ? Phase::idling : Phase::resting;
    phase_since_ = now;
    letting_go_.begin(now);
    last_attempt_ = kNever;
    if (was) {
      fault_ = false;
      lock_reason_.clear();
    }
  }
  control(command, now, out);
}

void DamiaoDriver::on_tick(Time now, DriverOut& out) {
  // Nobody decided this cycle: damping, as at rest.
  if (!commanded_) {
    before_ = out.frames.size();
    control(Setpoint{}, now, out);
  }
  commanded_ = false;
  const bool has_room = out.frames.size() < before_ + messages_per_cycle();
  if (has_room && !silent(now)) setup_.on_tick(now, out);
  report_status(now, false, out);
}

void DamiaoDriver::on_link_up(Time) {
  heard_.last_alive = kNever;
  heard_since_ = kNever;
  feedback_ = {};
  talk_.begin();
  last_sought_ = kNever;
  setup_.forget();
  if (arms(request_)) lock("the link was lost while armed");
}

Effect DamiaoDriver::effect(const Message& message, Time) const {
  const CanFrame* const frame = message.frame();
  if (frame == nullptr) return {};
  const FrameEffect kind = damiao::effect(*frame, settings_);
  return {kind, kind == FrameEffect::motion ? channel_bit(0) : ChannelMask{0}};
}

double DamiaoDriver::setpoint_radps(const Message& message, std::size_t) const {
  return message.frame() == nullptr ? kAbsent : settings_.joint.setpoint_radps(*message.frame());
}

}  // namespace drover::damiao
