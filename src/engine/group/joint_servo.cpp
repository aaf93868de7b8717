// One joint outside the base: whether its drive is armed, whose word it follows, what it does else.
#include "engine/group/joint_servo.h"

#include <algorithm>
#include <cmath>

namespace drover::engine {
namespace {

constexpr const char* kNoLoop = "its drive is not in closed loop";

JointMeasured measured_by(const AxisSnapshot& axis) {
  const double velocity = axis.motion.velocity_radps;
  return {axis.motion.position_rad, std::isfinite(velocity) ? velocity : 0, axis.motion.effort_Nm};
}

}  // namespace

void JointServo::take(const JointTarget& target, Time now) {
  row_.take(target, now);
}

void JointServo::overhear(Time now) {
  row_.overhear(now);
}

void JointServo::refuse(bool was_there, Time now) {
  row_.refuse(now);
  if (row_.was_taken() || row_.must_pause() || (!loop_.closed && !was_there)) return;
  row_.stop();
  if (!was_there) return;
  ended_.why = "a start of droverd, or of what brings them";
  ended_.by_itself = false;
}

void JointServo::end(const Reason& why) {
  // A drive that was found running is armed without anybody's command: there is nothing to end.
  if (row_.was_sent() && (follows_ || arming_since_ != kNever)) {
    ended_.why = why;
    ended_.by_itself = false;
  }
  // Also a row that is only beginning: it was sent by somebody who did not know.
  row_.stop();
  follows_ = false;
  // A stop holds whatever is still held by somebody, and arms nothing that was let go.
  ended_.silent = lets_go();
  arming_since_ = kNever;
}

void JointServo::step(const Input& input) {
  command_ = {};
  cycle_ = {};
  judge_stream(input);
  watch_drive(input);
  if (!input.heard) {
    // Blind, it is told to damp, should it still hear: its last word would stand otherwise.
    leave_loop();
    state_ = GroupState::idle;
  } else if (input.axis.state == AxisState::running) {
    run(input);
  } else {
    arm(input);
  }
}

/// Whether what is sent is followed in this cycle, and why not.
void JointServo::judge_stream(const Input& input) {
  if (!input.hindrance.empty()) end(input.hindrance);
  if (!row_.goes_on(input.now)) return cease(input.now);
  const bool followed = follows_;
  follows_ = input.hindrance.empty() && !row_.must_pause() && row_.is_steady(input.now);
  ended_.silent = !follows_ && (ended_.silent || followed);
  if (!input.hindrance.empty()) {
    ended_.why = input.hindrance;
    ended_.by_itself = false;
  } else if (!follows_ && !row_.must_pause() && row_.gap() > Duration{}) {
    ended_.by_itself = true;
    ended_.why.format("its commands come %.0f ms apart, %.0f ms are allowed",
                      1e3 * to_s(row_.gap()), 1e3 * rules_.timeout_s);
  } else if (row_.must_pause()) {
    cycle_.awaits_pause = true;  // and what stopped it is told on
  } else {
    ended_.why.clear();
  }
}

void JointServo::cease(Time now) {
  if (follows_) {
    ended_.why = "its commands have ceased";
    ended_.by_itself = ended_.silent = true;
  }
  if (row_.is_over(now)) ended_.why.clear();
  follows_ = false;
  arming_since_ = kNever;
}

/// What it follows ends for a cause that lies in itself.
void JointServo::fail(const Reason& why) {
  end(why);
  ended_.by_itself = cycle_.failed = true;
}

/// For its drive's own reason, or else in these words.
void JointServo::fail_by_drive(const Input& input, const char* otherwise) {
  const Reason& fault = input.axis.fault;
  const Reason& said = fault.empty() ? input.axis.source.reason : fault;
  fail(said.empty() ? Reason(otherwise) : said);
}

/// What its drive held, and nobody let go, is held by nobody until it runs again. What the guard
/// has is the guard's to tell.
void JointServo::watch_drive(const Input& input) {
  const bool runs = input.heard && input.axis.state == AxisState::running;
  const bool asked_first = input.heard && input.axis.state == AxisState::arming;
  if (runs) return lost_.clear();
  const bool let_go = lets_go() || told_trust_ == Trust::let_go;
  const bool held = loop_.closed && !asked_first && !input.blocked && !let_go;
  if (!held && lost_.empty()) return;
  lost_ = input.axis.fault.empty() ? input.axis.source.reason : input.axis.fault;
  if (lost_.empty()) lost_ = input.heard ? kNoLoop : "its drive is silent";
}

/// Its drive does not run: it comes into closed loop where it is, if somebody commands it.
void JointServo::arm(const Input& input) {
  // A drive that was found running may want to be asked first.
  const bool taken_over = loop_.closed && input.axis.state == AxisState::arming;
  if (loop_.closed && follows_ && !taken_over) fail_by_drive(input, kNoLoop);
  if (taken_over) {
    loop_.arrival.begin();
  } else {
    leave_loop();
  }
  if (follows_ && arming_since_ != kNever && input.now - arming_since_ > input.start_timeout)
    fail_by_drive(input, "its drive does not come into closed loop");
  if (!follows_ && !taken_over) {
    arming_since_ = kNever;
    state_ = GroupState::idle;
    return;
  }
  if (arming_since_ == kNever) arming_since_ = input.now;
  loop_.shaper.take_over(measured_by(input.axis));
  command_ = {AxisRequest::run, 0, loop_.shaper.impedance()};
  state_ = GroupState::arming;
}

/// Its drive runs, and tells where the joint is.
void JointServo::run(const Input& input) {
  const JointMeasured measured = this->measured(input);
  const double dt_s = std::max(to_s(input.dt), 0.0);
  arming_since_ = kNever;
  // What is held elsewhere goes on from where it is given back.
  if (!loop_.closed || input.blocked) {
    loop_.shaper.take_over(measured);
    loop_.arrival.begin();
  }
  cycle_.found = !loop_.closed && !follows_;
  loop_.closed = true;
  watch_joint(measured, dt_s);
  ask_trust(input, measured);
  if (follows_) loop_.pressed = false;
  ask_arrival(measured, dt_s);
  command_.request = AxisRequest::run;
  if (told_trust_ != Trust::whole) {
    do_without(measured);
  } else if (follows_ && (input.ready || following())) {
    loop_.shaper.follow(row_.target(), measured, dt_s);
    state_ = GroupState::following;
  } else if (follows_) {
    loop_.shaper.hold(measured, dt_s);
    state_ = GroupState::arming;
  } else {
    rest(measured, dt_s);
  }
  command_.velocity_radps = loop_.shaper.velocity_radps();
  command_.impedance = loop_.shaper.impedance();
  // None of it arrives: the guard can only damp it.
  if (input.blocked) state_ = GroupState::damping;
}

/// A drive that is just found, or was somebody else's, is where it says.
JointMeasured JointServo::measured(const Input& input) {
  const JointMeasured told = measured_by(input.axis);
  const bool known =
      loop_.closed && !input.blocked && std::isfinite(input.axis.motion.velocity_radps);
  if (!known) loop_.leap.begin();
  return loop_.leap.look(told, input.axis.last_motion);
}

/// Of what was told last: it is ended where that drives the joint beyond its limits.
void JointServo::watch_joint(const JointMeasured& measured, double dt_s) {
  if (!follows_ || !following()) return loop_.watch.begin();
  const JointShaper& told = loop_.shaper;
  const Reason why = loop_.watch.look(measured, told.impedance(), told.velocity_radps(), dt_s);
  if (!why.empty()) fail(why);
}

/// What its drive measures is not believed, until somebody begins anew.
void JointServo::ask_trust(const Input& input, const JointMeasured& measured) {
  const double since_s = measured_ == kNever ? 0 : to_s(input.axis.last_motion - measured_);
  measured_ = input.axis.last_motion;
  if (follows_) told_trust_ = Trust::whole;
  if (told_trust_ == Trust::damps && loop_.trust.runs_on(measured)) told_trust_ = Trust::let_go;
  if (told_trust_ != Trust::whole || input.blocked) return loop_.trust.look_away();
  if (!loop_.leap.why().empty()) return distrust(loop_.leap.why());
  // What was let go was told no law to go against, though its drive may say that it runs.
  if (state_ == GroupState::released) return loop_.trust.look_away();
  const JointShaper& told = loop_.shaper;
  const Reason why = loop_.trust.look(measured, since_s, told.impedance(), told.velocity_radps());
  if (!why.empty()) distrust(why);
}

void JointServo::distrust(const Reason& why) {
  fail(why);
  ended_.why = why;  // also of one that followed nobody
  told_trust_ = Trust::damps;
}

/// Of what was told last. Who presses for long, and comes no nearer, is ended; what is held, or too
/// soft to press, is only told.
void JointServo::ask_arrival(const JointMeasured& measured, double dt_s) {
  JointArrival& arrival = loop_.arrival;
  const bool asked = following() || state_ == GroupState::holding;
  if (!asked || told_trust_ != Trust::whole) return arrival.begin();
  const bool knew = !arrival.why().empty();
  const bool followed = follows_ && following();
  const JointShaper& told = loop_.shaper;
  arrival.look(measured, told.impedance(), told.position_rad(), told.velocity_radps(), followed,
               dt_s);
  cycle_.strained = !knew && !arrival.why().empty();
  if (!followed || !arrival.presses()) return;
  fail(arrival.why());
  loop_.pressed = true;
  cycle_.strained = false;
  arrival.begin();
}

/// Damped, which is no torque where its encoder stands; what damping drives on is let go. At once:
/// what it was told was made of what is not so, and would drive it on while it goes down.
void JointServo::do_without(const JointMeasured& measured) {
  loop_.shaper.take_over(measured);
  state_ = GroupState::damping;
  if (told_trust_ == Trust::damps) return;
  command_.request = AxisRequest::idle;
  state_ = GroupState::released;
}

/// Nobody's commands are followed.
void JointServo::rest(const JointMeasured& measured, double dt_s) {
  switch (ended_.silent ? rules_.on_silence : OnSilence::hold) {
    case OnSilence::hold:
      loop_.shaper.hold(measured, dt_s, !loop_.pressed);
      state_ = GroupState::holding;
      return;
    case OnSilence::damp:
      loop_.shaper.damp(measured, dt_s);
      state_ = GroupState::damping;
      return;
    case OnSilence::release:
      command_ = {AxisRequest::idle, 0, {}};
      loop_.shaper.take_over(measured);  // whoever commands it next begins where it has got to
      state_ = GroupState::released;
      return;
  }
}

}  // namespace drover::engine
