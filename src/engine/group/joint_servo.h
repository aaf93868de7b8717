// One joint outside the base: whether its drive is armed, whose word it follows, what it does else.
#pragma once

#include "drover/snapshot.h"
#include "engine/group/command_row.h"
#include "engine/group/joint_arrival.h"
#include "engine/group/joint_leap.h"
#include "engine/group/joint_shaper.h"
#include "engine/group/joint_trust.h"
#include "engine/group/joint_watch.h"

namespace drover::engine {

/// Arms by a stream of commands alone, and only after that was heard for a while without a gap:
/// what comes in a burst after a line or a program hung is none. What stopped a stream once waits
/// until its commands have ceased for a second, so that a program which does not know of a stop
/// does not drive on when its cause is gone. A drive that runs and follows nobody holds, also one
/// that was found so; where its commands have ceased, and nothing stopped it, it damps or is let go
/// if its rules say so. Places, speeds and torques are the joint's own, at its output: rad, rad/s
/// and Nm about its zero and by its sign, as its driver tells and takes them. Pure.
class JointServo final {
 public:
  struct Input {
    Time now = kNever;
    Duration dt{};             ///< since the cycle before
    const AxisSnapshot& axis;  ///< its own
    bool heard = false;        ///< its drive is, and tells where it is; else something hinders
    /// Why nobody's commands are followed now; empty: they are.
    const Reason& hindrance;
    Duration start_timeout{};  ///< its drive is armed by then
    bool blocked = false;      ///< what its drive is told does not arrive: the guard has it
    bool ready = true;         ///< the drives of all that are commanded with it run
  };

  explicit JointServo(const JointRules& rules)
      : rules_(rules), row_(from_s(rules.timeout_s)), loop_(rules) {}

  /// What comes next is sent by somebody else.
  void change_hands() { row_.change_hands(); }
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
  /// What its drive is told in this cycle.
  const AxisCommand& command() const { return command_; }

  /// A row of commands asks for it, whether it may be followed or not.
  bool asked(Time now) const { return row_.is_steady(now); }
  /// What is sent to it is not followed, for its reason.
  bool refuses(Time now) const { return row_.goes_on(now) && !follows_ && !reason().empty(); }
  /// Somebody's commands, or its drive is armed for them.
  bool follows() const { return follows_; }
  /// Nothing hinders what is sent any more, but it did not pause since it was stopped.
  bool awaits_pause() const { return cycle_.awaits_pause; }
  /// In this cycle its drive was found running, and nobody had armed it.
  bool found_running() const { return cycle_.found; }
  bool following() const { return state_ == GroupState::following; }
  GroupState state() const { return state_; }
  /// What of its command was beyond a limit.
  JointValues limited() const { return following() ? loop_.shaper.limited() : JointValues{}; }
  /// Why it does not follow what is sent, or why it ended, or why nobody holds what was held;
  /// empty: it does, or nothing is.
  const Reason& reason() const {
    return tells_lost() ? lost_ : ended_.why.empty() ? loop_.arrival.why() : ended_.why;
  }
  /// That reason lies in this joint, whose name is not in it.
  bool by_itself() const { return ended_.by_itself || ended_.why.empty(); }
  /// What stopped it; empty: it is long ago, or nothing did.
  const Reason& stopped_by() const { return ended_.why; }
  bool stopped_by_itself() const { return ended_.by_itself; }
  /// Why its drive does not hold it any more, though nobody let it go; empty: it does, or never
  /// did.
  const Reason& lost() const { return lost_; }
  /// Since this cycle it does not come to its set point, and nothing was ended by that.
  bool strained() const { return cycle_.strained; }
  /// Its drive ended it, or did not come into closed loop, or drove it beyond its limits, in this
  /// cycle.
  bool failed() const { return cycle_.failed; }
  /// It may be moved: its drive is told more than to damp.
  bool may_move() const { return command_.request == AxisRequest::run; }
  const JointRules& rules() const { return rules_; }

 private:
  /// How what it followed last ended, or why what is sent is not followed.
  struct Ended {
    Reason why;             ///< empty: it is long ago, or nothing is
    bool by_itself = true;  ///< that lies in this joint, whose name is not in it
    bool silent = false;    ///< its commands ceased; nothing stopped it
  };
  /// All that is known of the joint since its drive came into closed loop, and before that as new.
  struct Loop {
    explicit Loop(const JointRules& rules)
        : shaper(rules), watch(rules), trust(rules), arrival(rules) {}

    bool closed = false;  ///< its drive runs, and the shaper knows of it
    JointShaper shaper;
    JointWatch watch;
    JointTrust trust;
    JointLeap leap;
    JointArrival arrival;
    bool pressed = false;  ///< it was ended by that: its effort was no weight's
  };
  /// What one cycle finds, of that alone.
  struct Cycle {
    bool awaits_pause = false;
    bool found = false;
    bool strained = false;
    bool failed = false;
  };
  /// What its drive measures is taken for. Not believed it is also over the end of its loop.
  enum class Trust : std::uint8_t { whole, damps, let_go };

  // Whose word it follows.
  void judge_stream(const Input& input);
  void cease(Time now);
  void fail(const Reason& why);
  void fail_by_drive(const Input& input, const char* otherwise);
  bool lets_go() const { return ended_.silent && rules_.on_silence == OnSilence::release; }

  // What its drive does.
  void watch_drive(const Input& input);
  bool tells_lost() const { return !lost_.empty() && ended_.why.empty() && !follows_; }
  void leave_loop() { loop_ = Loop(rules_); }
  void arm(const Input& input);
  void run(const Input& input);

  // What it does while that runs.
  JointMeasured measured(const Input& input);
  void watch_joint(const JointMeasured& measured, double dt_s);
  void ask_trust(const Input& input, const JointMeasured& measured);
  void distrust(const Reason& why);
  void ask_arrival(const JointMeasured& measured, double dt_s);
  void do_without(const JointMeasured& measured);
  void rest(const JointMeasured& measured, double dt_s);

  JointRules rules_;
  CommandRow row_;
  bool follows_ = false;        ///< it, this cycle
  Time arming_since_ = kNever;  ///< for it, or because its drive asked first
  Ended ended_;
  Loop loop_;
  Trust told_trust_ = Trust::whole;
  Time measured_ = kNever;  ///< what was asked last whether it is believed
  Reason lost_;
  Cycle cycle_;
  GroupState state_ = GroupState::idle;
  AxisCommand command_;
};

}  // namespace drover::engine
