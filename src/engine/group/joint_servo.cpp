// One joint outside the base: whether its drive is armed, whose word it follows, what it does else.
#include "engine/group/joint_servo.h"

#include <algorithm>
#include <cmath>

namespace drover::engine {
namespace {

using namespace std::chrono_literals;

constexpr Duration kSteadyFor = 300ms;
/// Whoever was stopped has to be silent for so long before he begins again.
constexpr Duration kPause = 1s;
constexpr const char* kNoLoop = "its drive is not in closed loop";

JointMeasured measured_by(const AxisSnapshot& axis) {
  const double velocity = axis.motion.velocity_radps;
  return {axis.motion.position_rad, std::isfinite(velocity) ? velocity : 0, axis.motion.effort_Nm};
}

}  // namespace

bool JointServo::sent(Time now) const {
  return heard_ != kNever && now - heard_ <= from_s(rules_.timeout_s);
}

bool JointServo::steady(Time now) const {
  return sent(now) && now - steady_since_ >= std::max(kSteadyFor, from_s(rules_.timeout_s));
}

void JointServo::overhear(Time now) {
  if (said_ != kNever && now - said_ >= kPause) waits_ = false;
  said_ = now;
}

void JointServo::take(const JointTarget& target, Time now) {
  overhear(now);
  if (!sent(now)) {
    gap_ = heard_ == kNever || now - heard_ >= kPause ? Duration{} : now - heard_;
    steady_since_ = now;
  }
  heard_ = now;
  target_ = target;
}

void JointServo::refuse(bool was_there, Time now) {
  said_ = now;
  if (heard_ != kNever || waits_ || (!engaged_ && !was_there)) return;
  waits_ = true;
  if (!was_there) return;
  reason_ = "a start of droverd, or of what brings them";
  by_itself_ = false;
}

void JointServo::end(const Reason& why) {
  // A drive that was found running is armed without anybody's command: there is nothing to end.
  const bool sent_once = said_ != kNever;
  if (sent_once && (follows_ || arming_since_ != kNever)) {
    reason_ = why;
    by_itself_ = false;
  }
  // Also a row that is only beginning: it was sent by somebody who did not know.
  waits_ = waits_ || sent_once;
  follows_ = false;
  // A stop holds whatever is still held by somebody, and arms nothing that was let go.
  ceased_ = lets_go();
  arming_since_ = kNever;
}

/// For its drive's own reason, or else in these words.
void JointServo::fail(const Input& input, const char* otherwise) {
  const Reason& fault = input.axis.fault;
  const Reason& said = fault.empty() ? input.axis.source.reason : fault;
  end(said.empty() ? Reason(otherwise) : said);
  failed_ = by_itself_ = true;
}

/// Whether what is sent is followed in this cycle, and why not.
void JointServo::judge_stream(const Input& input) {
  awaits_pause_ = false;
  if (!input.hindrance.empty()) end(input.hindrance);
  if (!sent(input.now)) return cease(input.now);
  const bool followed = follows_;
  follows_ = input.hindrance.empty() && !waits_ && steady(input.now);
  ceased_ = !follows_ && (ceased_ || followed);
  if (!input.hindrance.empty()) {
    reason_ = input.hindrance;
    by_itself_ = false;
  } else if (!follows_ && !waits_ && gap_ > Duration{}) {
    by_itself_ = true;
    reason_.format("its commands come %.0f ms apart, %.0f ms are allowed", 1e3 * to_s(gap_),
                   1e3 * rules_.timeout_s);
  } else if (waits_) {
    awaits_pause_ = true;  // and what stopped it is told on
  } else {
    reason_.clear();
  }
}

void JointServo::cease(Time now) {
  if (follows_) {
    reason_ = "its commands have ceased";
    by_itself_ = ceased_ = true;
  }
  const Time last = heard_ != kNever ? heard_ : said_;
  if (last != kNever && now - last >= kPause) {
    gap_ = {};
    reason_.clear();
  }
  follows_ = false;
  arming_since_ = kNever;
}

/// Nobody's commands are followed.
void JointServo::rest(const JointMeasured& measured, double dt_s) {
  switch (ceased_ ? rules_.on_silence : OnSilence::hold) {
    case OnSilence::hold:
      shaper_.hold(measured, dt_s, !pressed_);
      state_ = GroupState::holding;
      return;
    case OnSilence::damp:
      shaper_.damp(measured, dt_s);
      state_ = GroupState::damping;
      return;
    case OnSilence::release:
      command_ = {AxisRequest::idle, 0, {}};
      shaper_.take_over(measured);  // whoever commands it next begins where it has got to
      state_ = GroupState::released;
      return;
  }
}

/// Of what was told last: it is ended where that drives the joint beyond its limits.
void JointServo::watch_joint(const JointMeasured& measured, double dt_s) {
  if (!follows_ || !following()) return watch_.begin();
  const Reason why = watch_.look(measured, shaper_.impedance(), shaper_.velocity_radps(), dt_s);
  if (why.empty()) return;
  end(why);
  failed_ = by_itself_ = true;
}

/// What its drive measures is not believed, until somebody begins anew.
void JointServo::ask_trust(const Input& input, const JointMeasured& measured, double dt_s) {
  const double since_s = measured_ == kNever ? 0 : to_s(input.axis.last_motion - measured_);
  measured_ = input.axis.last_motion;
  if (follows_) told_trust_ = Trust::whole;
  if (told_trust_ == Trust::damps && trust_.runs_on(measured)) told_trust_ = Trust::let_go;
  if (told_trust_ != Trust::whole || input.blocked) return trust_.look_away();
  if (!leap_.why().empty()) return distrust(leap_.why());
  const Reason why =
      trust_.look(measured, since_s, shaper_.impedance(), shaper_.velocity_radps(), dt_s);
  if (!why.empty()) distrust(why);
}

void JointServo::distrust(const Reason& why) {
  end(why);
  reason_ = why;
  failed_ = by_itself_ = true;
  told_trust_ = Trust::damps;
}

/// A drive that is just found, or was somebody else's, is where it says.
JointMeasured JointServo::measured(const Input& input) {
  const JointMeasured told = measured_by(input.axis);
  const bool known = engaged_ && !input.blocked && std::isfinite(input.axis.motion.velocity_radps);
  if (!known) leap_.begin();
  return leap_.look(told, input.axis.last_motion);
}

/// Of what was told last. Who presses for long, and comes no nearer, is ended; what is held, or too
/// soft to press, is only told.
void JointServo::ask_arrival(const JointMeasured& measured, double dt_s) {
  const bool asked = following() || state_ == GroupState::holding;
  if (!asked || told_trust_ != Trust::whole) return arrival_.begin();
  const bool knew = !arrival_.why().empty();
  const bool followed = follows_ && following();
  arrival_.look(measured, shaper_.impedance(), shaper_.position_rad(), shaper_.velocity_radps(),
                followed, dt_s);
  strained_ = !knew && !arrival_.why().empty();
  if (followed && arrival_.presses()) {
    end(arrival_.why());
    failed_ = by_itself_ = pressed_ = true;
    strained_ = false;
    arrival_.begin();
  }
}

/// Damped, which is no torque where its encoder stands; what damping drives on is let go. At once:
/// what it was told was made of what is not so, and would drive it on while it goes down.
void JointServo::do_without(const JointMeasured& measured) {
  shaper_.take_over(measured);
  state_ = GroupState::damping;
  if (told_trust_ == Trust::damps) return;
  command_.request = AxisRequest::idle;
  state_ = GroupState::released;
}

/// Its drive runs, and tells where the joint is.
void JointServo::run(const Input& input) {
  const JointMeasured measured = this->measured(input);
  const double dt_s = std::max(to_s(input.dt), 0.0);
  arming_since_ = kNever;
  // What is held elsewhere goes on from where it is given back.
  if (!engaged_ || input.blocked) {
    shaper_.take_over(measured);
    arrival_.begin();
  }
  if (!engaged_) {
    trust_.begin();
    pressed_ = false;
  }
  found_ = !engaged_ && !follows_;
  engaged_ = true;
  watch_joint(measured, dt_s);
  ask_trust(input, measured, dt_s);
  if (follows_) pressed_ = false;
  ask_arrival(measured, dt_s);
  command_.request = AxisRequest::run;
  if (told_trust_ != Trust::whole) {
    do_without(measured);
  } else if (follows_ && (input.ready || following())) {
    shaper_.follow(target_, measured, dt_s);
    state_ = GroupState::following;
  } else if (follows_) {
    shaper_.hold(measured, dt_s);
    state_ = GroupState::arming;
  } else {
    rest(measured, dt_s);
  }
  command_.velocity_radps = shaper_.velocity_radps();
  command_.impedance = shaper_.impedance();
}

/// Its drive does not run: it comes into closed loop where it is, if somebody commands it.
void JointServo::arm(const Input& input) {
  // A drive that was found running may want to be asked first.
  const bool taken_over = engaged_ && input.axis.state == AxisState::arming;
  if (engaged_ && follows_ && !taken_over) fail(input, kNoLoop);
  engaged_ = taken_over;
  arrival_.begin();
  if (follows_ && arming_since_ != kNever && input.now - arming_since_ > input.start_timeout)
    fail(input, "its drive does not come into closed loop");
  if (!follows_ && !taken_over) {
    arming_since_ = kNever;
    state_ = GroupState::idle;
    return;
  }
  if (arming_since_ == kNever) arming_since_ = input.now;
  shaper_.take_over(measured_by(input.axis));
  command_ = {AxisRequest::run, 0, shaper_.impedance()};
  state_ = GroupState::arming;
}

/// What its drive held, and nobody let go, is held by nobody until it runs again. What the guard
/// has is the guard's to tell.
void JointServo::watch_drive(const Input& input) {
  const bool runs = input.heard && input.axis.state == AxisState::running;
  const bool asked_first = input.heard && input.axis.state == AxisState::arming;
  if (runs) return lost_.clear();
  const bool let_go = lets_go() || told_trust_ == Trust::let_go;
  const bool held = engaged_ && !asked_first && !input.blocked && !let_go;
  if (!held && lost_.empty()) return;
  lost_ = input.axis.fault.empty() ? input.axis.source.reason : input.axis.fault;
  if (lost_.empty()) lost_ = input.heard ? kNoLoop : "its drive is silent";
}

void JointServo::step(const Input& input) {
  command_ = {};
  failed_ = found_ = strained_ = false;
  judge_stream(input);
  watch_drive(input);
  if (!input.heard) {
    // Blind, it is told to damp, should it still hear: its last word would stand otherwise.
    engaged_ = false;
    arrival_.begin();
    state_ = GroupState::idle;
  } else if (input.axis.state == AxisState::running) {
    run(input);
  } else {
    arm(input);
  }
}

}  // namespace drover::engine
