// One joint outside the base: whether its drive is armed, whose word it follows, what it does else.
#pragma once

#include "drover/snapshot.h"
#include "engine/group/joint_arrival.h"
#include "engine/group/joint_leap.h"
#include "engine/group/joint_shaper.h"
#include "engine/group/joint_trust.h"
#include "engine/group/joint_watch.h"

namespace drover::engine {

/// Arms by a stream of commands alone, and only after that was heard for a while without a gap:
/// what comes in a burst after a line or a program hung is none. What stopped a stream once waits
/// until its commands have ceased for a second, so that a program which does not know of a stop
/// does not drive on when its cause is gone. What is refused is a command for that: it was sent.
/// So the next command that is taken shows the pause, not the silence itself: what a broker that
/// hangs holds back comes, and is refused, when it goes on. A drive that runs and follows nobody
/// holds, also one that was found so; where its commands have ceased, and nothing stopped it, it
/// damps or is let go if its rules say so. Pure.
class JointServo final {
 public:
  struct Input {
    Time now = kNever;
    Duration dt{};
    const AxisSnapshot& axis;
    bool heard = false;  ///< its drive is, and tells where it is; else something hinders
    /// Why nobody's commands are followed now; empty: they are.
    const Reason& hindrance;
    Duration start_timeout{};  ///< its drive is armed by then
    bool blocked = false;      ///< what its drive is told does not arrive: the guard has it
    bool ready = true;         ///< the drives of all that are commanded with it run
  };

  explicit JointServo(const JointRules& rules)
      : rules_(rules), shaper_(rules), watch_(rules), trust_(rules), arrival_(rules) {}

  /// A command that is sound; whether it is followed is decided by step().
  void take(const JointTarget& target, Time now);
  /// One that was refused, and may have been its: nobody pauses who sends it.
  /// Before any was taken it came from who did not hear that this program began: where its drive
  /// was found running, or he `was_there` before the way by which it came.
  void refuse(bool was_there, Time now);
  /// One that names others of its group: nobody pauses who sends it.
  void overhear(Time now);
  /// What it follows ends for a cause that lies elsewhere.
  void end(const Reason& why);

  /// One cycle.
  void step(const Input& input);
  const AxisCommand& command() const { return command_; }

  /// A row of commands asks for it, whether it may be followed or not.
  bool asked(Time now) const { return steady(now); }
  /// What is sent to it is not followed, for its reason.
  bool refuses(Time now) const { return sent(now) && !follows_ && !reason().empty(); }
  /// Somebody's commands, or its drive is armed for them.
  bool follows() const { return follows_; }
  /// Nothing hinders what is sent any more, but it did not pause since it was stopped.
  bool awaits_pause() const { return awaits_pause_; }
  /// In this cycle its drive was found running, and nobody had armed it.
  bool found_running() const { return found_; }
  bool following() const { return state_ == GroupState::following; }
  GroupState state() const { return state_; }
  /// What of its command was beyond a limit.
  JointValues limited() const { return following() ? shaper_.limited() : JointValues{}; }
  /// Why it does not follow what is sent, or why it ended, or why nobody holds what was held;
  /// empty: it does, or nothing is.
  const Reason& reason() const {
    return tells_lost() ? lost_ : reason_.empty() ? arrival_.why() : reason_;
  }
  /// That reason lies in this joint, whose name is not in it.
  bool by_itself() const { return by_itself_ || reason_.empty(); }
  /// What stopped it; empty: it is long ago, or nothing did.
  const Reason& stopped_by() const { return reason_; }
  bool stopped_by_itself() const { return by_itself_; }
  /// Why its drive does not hold it any more, though nobody let it go; empty: it does, or never
  /// did.
  const Reason& lost() const { return lost_; }
  /// Since this cycle it does not come to its set point, and nothing was ended by that.
  bool strained() const { return strained_; }
  /// Its drive ended it, or did not come into closed loop, or drove it beyond its limits, in this
  /// cycle.
  bool failed() const { return failed_; }
  /// It may be moved: its drive is told more than to damp.
  bool may_move() const { return command_.request == AxisRequest::run; }
  const JointRules& rules() const { return rules_; }

 private:
  bool sent(Time now) const;
  bool steady(Time now) const;
  void judge_stream(const Input& input);
  void cease(Time now);
  bool tells_lost() const { return !lost_.empty() && reason_.empty() && !follows_; }
  void watch_drive(const Input& input);
  bool lets_go() const { return ceased_ && rules_.on_silence == OnSilence::release; }
  void run(const Input& input);
  void rest(const JointMeasured& measured, double dt_s);
  void arm(const Input& input);
  void fail(const Input& input, const char* otherwise);
  JointMeasured measured(const Input& input);
  void distrust(const Reason& why);
  void watch_joint(const JointMeasured& measured, double dt_s);
  void ask_trust(const Input& input, const JointMeasured& measured, double dt_s);
  void ask_arrival(const JointMeasured& measured, double dt_s);
  void do_without(const JointMeasured& measured);

  JointRules rules_;
  JointShaper shaper_;
  JointWatch watch_;
  JointTrust trust_;
  JointLeap leap_;
  JointArrival arrival_;
  bool pressed_ = false;    ///< it was ended by that: its effort was no weight's
  bool strained_ = false;   ///< this cycle
  Time measured_ = kNever;  ///< what it was asked for last
  enum class Trust : std::uint8_t { whole, damps, let_go } told_trust_ = Trust::whole;
  JointTarget target_;
  Time heard_ = kNever;         ///< the last command
  Time said_ = kNever;          ///< likewise, or one that was refused
  Time steady_since_ = kNever;  ///< of a row without a gap
  Duration gap_{};              ///< before the last command, when it was too long
  bool waits_ = false;          ///< for a pause: it was stopped
  bool awaits_pause_ = false;   ///< this cycle
  bool found_ = false;          ///< likewise
  bool engaged_ = false;        ///< its drive runs, and the shaper knows of it
  bool follows_ = false;        ///< this cycle
  bool ceased_ = false;         ///< what it followed last was silent; nothing stopped it
  Time arming_since_ = kNever;
  GroupState state_ = GroupState::idle;
  Reason reason_;
  bool by_itself_ = true;
  Reason lost_;
  bool failed_ = false;
  AxisCommand command_;
};

}  // namespace drover::engine
