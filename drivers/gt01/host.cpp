#include "drivers/gt01/host.h"

#include <algorithm>
#include <cmath>

namespace drover::gt01 {
namespace {

using std::chrono::milliseconds;

/// Beyond it a chassis that obeys moves, and tells of it.
constexpr double kPlain_mps = 0.1;
constexpr double kPlain_radps = 0.2;
constexpr double kStill_mps = 0.005;
constexpr double kStill_radps = 0.01;
/// A chassis at rest that is faster is driven by somebody.
constexpr double kDriven_mps = 0.05;
constexpr double kDriven_radps = 0.1;
/// The time that it has to come to rest.
constexpr Duration kComesToRest = milliseconds(1000);
constexpr Duration kIdleAtLast = milliseconds(1000);
/// Its wheels half a metre apart: what one of them gets wrong turns the base by so much.
constexpr double kTrack_m = 0.5;

bool beyond(const Twist& twist, double speed_mps, double turn_radps) {
  return std::abs(twist.vx_mps) >= speed_mps || std::abs(twist.wz_radps) >= turn_radps;
}

}  // namespace

StopEnds ends_of(const Settings& settings) {
  return settings.zero_holds ? StopEnds::holds : StopEnds::damps;
}

Reason silence_text(const Settings& settings) {
  if (settings.silence <= Duration{}) return "keeps its last twist for ever, as far as is known";
  Reason text;
  text.format("stops by itself after %.1f s without commands (silence_s)", to_s(settings.silence));
  return text;
}

SilenceBehaviour silence_of(const Settings& settings, std::string_view text) {
  SilenceBehaviour behaviour;
  behaviour.stops = settings.silence > Duration{};
  behaviour.after = settings.silence;
  behaviour.ends = ends_of(settings);
  behaviour.text = text;
  return behaviour;
}

Effect effect_of(const std::optional<Twist>& asked) {
  if (!asked || !std::isfinite(asked->vx_mps) || !std::isfinite(asked->wz_radps)) return {};
  return is_zero(*asked) ? Effect{FrameEffect::stop, 0}
                         : Effect{FrameEffect::motion, channel_bit(0)};
}

void Host::on_link_up(Time now) {
  heard_.last_alive = last_motion_ = condition_.at = kNever;
  sent_ = {};
  ignored_since_ = kNever;
  phase_since_ = now;
  if (arms(request_)) lock("the link was lost while armed");
}

void Host::on_good(Time received) {
  ++heard_.good;
  heard_.last_good = heard_.last_alive = received;
}

void Host::on_condition(const Condition& condition, Time received, DriverOut& out) {
  condition_ = condition;
  report_status(received, out);
}

void Host::on_motion(const Twist& told, double sigma_mps, Time received, DriverOut& out) {
  measured_ = true_of(told);
  last_motion_ = received;
  BodyMotion motion;
  motion.twist = measured_;
  motion.vx_var = sigma_mps * sigma_mps;
  motion.wz_var = motion.vx_var / (kTrack_m * kTrack_m);
  motion.known = true;
  report_heard(motion, received, out);
}

void Host::on_supply(double voltage_V, Time received, DriverOut& out) {
  if (voltage_V == voltage_V_) return;
  voltage_V_ = voltage_V;
  AxisSupply supply;
  supply.axis = axis_;
  supply.bus_V = voltage_V;
  report_heard(supply, received, out);
}

void Host::on_foreign(std::uint32_t id, Time received) {
  foreign_.on_frame(id, received);
  if (attempts_to_run()) lock(foreign_.text().view());
}

Twist Host::true_of(const Twist& told) const {
  return {told.vx_mps * settings_.speed_scale, told.wz_radps * settings_.turn_scale};
}

double Host::clamped(double value, double most) {
  if (std::isfinite(value) && std::abs(value) <= most) return value;
  ++bad_setpoints_;
  return std::isfinite(value) ? std::copysign(most, value) : 0.0;
}

Twist Host::told_of(const Twist& wanted) {
  const Twist safe{clamped(wanted.vx_mps, settings_.max_speed_mps),
                   clamped(wanted.wz_radps, settings_.max_turn_radps)};
  return {safe.vx_mps / settings_.speed_scale, safe.wz_radps / settings_.turn_scale};
}

bool Host::gone(Time now) const {
  return heard_.last_alive == kNever || now - heard_.last_alive > settings_.gone_after;
}

/// While only one of them comes nobody knows who pressed what, or where it goes.
Host::Missing Host::missing(Duration limit, Time now) const {
  if (now - condition_.at > limit) return {words_.state, condition_.at};
  if (now - last_motion_ > limit) return {words_.motion, last_motion_};
  return {};
}

void Host::lock(std::string_view why) {
  phase_ = Phase::locked;
  lock_reason_.assign(why);
}

void Host::take(AxisRequest request, Time now) {
  if (request == request_) return;
  const bool armed = arms(request_);
  request_ = request;
  if (arms(request) && armed) return;  // the same, but for where its speed comes from
  phase_since_ = now;
  ignored_since_ = kNever;
  lock_reason_.clear();
  if (arms(request)) {
    phase_ = Phase::arming;
  } else {
    phase_ = request == AxisRequest::idle ? Phase::idling : Phase::resting;
  }
}

void Host::on_setpoints(std::span<const Setpoint> wanted, Time now) {
  commanded_ = true;
  const Setpoint setpoint = wanted.empty() ? Setpoint{} : wanted[0];
  wanted_ = setpoint.twist;
  take(setpoint.request, now);
}

/// What was heard, or not, means for what is under way.
void Host::follow(Time now) {
  if (!attempts_to_run()) return;
  if (gone(now)) {
    lock(phase_ == Phase::arming ? "asked to run while the chassis was silent"
                                 : "the chassis fell silent while it was commanded");
  } else if (const Missing part = missing(settings_.gone_after, now); !part.what.empty()) {
    const bool waits = phase_ == Phase::arming && now - phase_since_ <= settings_.obeys_within;
    if (!waits) lock(silent_text(part.what, settings_.gone_after).view());
  } else if (const Reason why = trouble(now); !why.empty()) {
    lock(why.view());
  } else if (phase_ == Phase::running && !condition_.obeys) {
    lock("the chassis no longer obeys the host");
  } else if (phase_ == Phase::arming && condition_.obeys) {
    phase_ = Phase::running;
  } else if (phase_ == Phase::arming && now - phase_since_ > settings_.obeys_within) {
    lock("the chassis does not let the host command it: is its remote control on?");
  }
}

/// On a wire that does not tell who is in command this is how it shows.
void Host::watch_obedience(Time now) {
  const bool told = phase_ == Phase::running && beyond(sent_, kPlain_mps, kPlain_radps);
  if (!told || beyond(measured_, kStill_mps, kStill_radps)) {
    ignored_since_ = kNever;
  } else if (ignored_since_ == kNever) {
    ignored_since_ = now;
  } else if (now - ignored_since_ > settings_.obeys_within) {
    lock(condition_.remote_on ? "it was told to move and stands: the remote control has it"
                              : "it was told to move and stands: blocked, or not in command");
  }
}

/// A silent chassis may still hear, and one that somebody else has may keep the last twist until it
/// is given back: that one is zero. One that waits for somebody to command it is left alone.
bool Host::feeds(Time now) const {
  if (heard_.last_alive == kNever) return false;
  if (!is_zero(sent_)) return true;
  if (phase_ == Phase::idling)
    return beyond(measured_, kDriven_mps, kDriven_radps) && now - phase_since_ <= kIdleAtLast;
  return attempts_to_run() || condition_.obeys;
}

std::optional<Twist> Host::on_tick(Time now) {
  const bool decided = commanded_;
  commanded_ = false;
  follow(now);
  const bool moves = decided && (phase_ == Phase::running ||
                                 (phase_ == Phase::arming && request_ == AxisRequest::hold));
  const Twist asked = moves ? told_of(wanted_) : Twist{};
  watch_obedience(now);
  const bool stops = is_zero(asked) && !is_zero(sent_);
  const bool due = last_sent_ == kNever || now - last_sent_ >= settings_.command_period;
  if (!feeds(now) || !(due || stops)) return std::nullopt;
  sent_ = asked;
  last_sent_ = now;
  return asked;
}

/// No frame lets go of it: one that was told zero since it was asked to, or stands, has done what
/// it can. Whether it obeys shows in its speed.
bool Host::has_let_go() const {
  const bool told = last_sent_ != kNever && last_sent_ >= phase_since_;
  return phase_ == Phase::idling && is_zero(sent_) &&
         (told || !beyond(measured_, kDriven_mps, kDriven_radps));
}

/// Why it cannot be commanded.
Reason Host::trouble(Time now) const {
  if (foreign_.is_shown(now)) return foreign_.text();
  if (!condition_.trouble.empty()) return condition_.trouble;
  const bool at_rest = phase_ == Phase::resting && now - phase_since_ > kComesToRest;
  if (at_rest && condition_.remote_on && beyond(measured_, kDriven_mps, kDriven_radps))
    return "it moves without a command: the remote control has it";
  return {};
}

StatusInWords Host::status(Time now) const {
  StatusInWords status;
  status.axis = axis_;
  if (heard_.last_alive == kNever) {
    status.reason = "the chassis was not heard yet";
    return status;
  }
  if (gone(now)) {
    status.reason = silent_text("nothing heard", settings_.gone_after);
    return status;
  }
  if (const Missing part = missing(settings_.gone_after, now); !part.what.empty()) {
    status.reason = silent_text(part.what, settings_.gone_after);
    return status;
  }
  status.error_code = condition_.bits;
  const Reason why = trouble(now);
  if (phase_ == Phase::locked || !why.empty()) {
    status.state = AxisState::fault;
    status.reason = why.empty() ? lock_reason_ : why;
    status.powered = condition_.powered;
    status.stops_all = condition_.stops_all;
  } else if (phase_ == Phase::arming) {
    status.state = AxisState::arming;
  } else {
    status.state = condition_.obeys && !has_let_go() ? AxisState::running : AxisState::idle;
  }
  return status;
}

void Host::report_status(Time now, DriverOut& out) {
  const StatusInWords current = status(now);
  if (told_.is_due(current, false)) report_heard<AxisStatus>(current, now, out);
}

SourceHealth Host::health(Time now) const {
  SourceHealth health =
      heard_.health(now, "the chassis was never heard", "nothing heard", settings_.stale_after);
  if (health.state == SourceState::never_heard && health.bad > 0)
    health.reason = "bytes, but no message of the chassis: its speed, or another device?";
  health.bad += bad_setpoints_;
  if (health.state != SourceState::fresh) return health;
  const Missing part = missing(settings_.stale_after, now);
  if (!part.what.empty()) return stale(health, silent_text(part.what, part.last, now));
  if (foreign_.is_shown(now)) health.reason = foreign_.text();
  return health;
}

}  // namespace drover::gt01
