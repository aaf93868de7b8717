// The row of commands that a joint is sent: when they came, and whether without a gap.
#pragma once

#include "drover/command.h"
#include "drover/time.h"

namespace drover::engine {

/// Whoever was stopped has to be silent for a while before he begins again. What is refused is a
/// command for that: it was sent. So the next command that is taken shows the pause, not the
/// silence itself: what a broker that hangs holds back comes, and is refused, when it goes on.
/// Pure.
class CommandRow final {
 public:
  /// `timeout`: longer without a command, and they have ceased.
  explicit CommandRow(Duration timeout) : timeout_(timeout) {}

  /// What comes next is sent by somebody else.
  void change_hands();
  /// A command that is taken, in the joint's own frame (rad, rad/s, Nm).
  void take(const JointTarget& target, Time now);
  /// One that is taken by others of its group.
  void overhear(Time now);
  /// One that nobody took.
  void refuse(Time now) { said_ = now; }
  /// It is stopped, and whoever sends it has to pause. Nobody has to before anything was sent.
  void stop() { must_pause_ = must_pause_ || was_sent(); }

  /// The last command that was taken.
  const JointTarget& target() const { return target_; }
  /// Any command ever, taken or not.
  bool was_sent() const { return said_ != kNever; }
  bool was_taken() const { return taken_ != kNever; }
  bool must_pause() const { return must_pause_; }
  /// Commands come now.
  bool goes_on(Time now) const { return was_taken() && now - taken_ <= timeout_; }
  /// They do, and did for long enough without a gap.
  bool is_steady(Time now) const;
  /// They ceased, and that is long ago.
  bool is_over(Time now) const;
  /// Between its sender's last two commands, when they came too far apart; else nothing.
  Duration gap() const { return gap_; }

 private:
  Duration steady_for() const;
  Duration gap_before(Time now) const;

  Duration timeout_;
  JointTarget target_;
  Time taken_ = kNever;  ///< the last that was
  Time said_ = kNever;   ///< likewise, or one that was refused, or was others'
  Time since_ = kNever;  ///< without a gap
  Duration gap_{};
  bool changed_hands_ = false;  ///< since the last that was taken
  bool must_pause_ = false;
};

}  // namespace drover::engine
