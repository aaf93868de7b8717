// A stream of messages that a program drives by: when it may begin, and when it has ended.
#pragma once

#include "drover/command.h"
#include "drover/snapshot.h"
#include "engine/event_queue.h"

namespace drover::engine {

/// How a kind of stream is told of.
struct StreamWords {
  const char* refused;  ///< "joint command refused: "
  const char* ended;    ///< "joint commands ended: "
  const char* come;     ///< "joint commands come"
  const char* begins;   ///< "a stream of joint commands begins with velocity 0"
  const char* silent;   ///< "the stream of joint commands fell silent"
};

/// Before anything moves every message has to say zero for a while, so that a program that was
/// stopped while it drove does not drive on when the cause is gone, not even when another one
/// writes zeros between. A stream ends when it falls silent.
class Stream {
 public:
  /// A message that was not permitted before it came here, which the journal knows already.
  void refuse_quietly(const Reason& why);
  /// Ends it for a cause that lies elsewhere.
  void end(std::string_view why);
  /// Ends it for what is in its way.
  void meet(const Reason& obstacle);
  /// Once a cycle: notices silence.
  void step(Time now);
  /// Tells what was refused or has ended, once for a row of messages of which the same holds.
  void announce(Time now, EventQueue& events);

  bool following() const { return following_; }
  /// What is sent to it was refused, or ended it before an obstacle, until a second ago. Nobody
  /// asks for motion then, so nothing else would tell the sender why the robot stands.
  bool refuses(Time now) const;
  /// What was in the way of the last one, until another begins; empty: it ended otherwise.
  const Reason& obstacle() const { return obstacle_; }
  const Reason& reason() const { return reason_; }
  Time last() const { return last_; }
  Time since() const { return since_; }  ///< when it began
  StreamSnapshot snapshot() const { return {following_, accepted_, refused_, reason_}; }

 protected:
  Stream(Duration timeout, const StreamWords& words) : timeout_(timeout), words_(words) {}
  ~Stream() = default;

  /// A message that is sound; `neutral`: it asks for no motion. `busy`: why none can be followed
  /// now; empty: they can. False: it is not followed.
  bool follow(bool neutral, std::string_view busy, Time now);
  /// One that is not sound: the journal is told, and what is followed goes on.
  void refuse(const Reason& why, Time now);

 private:
  bool rested(Time now) const;
  void watch_zeros(bool neutral, Time now);
  void watch_rate(Time now);
  Reason not_begun(Time now) const;

  Duration timeout_;
  StreamWords words_;
  bool following_ = false;
  bool may_move_ = false;  ///< it has shown its rest
  Time zeros_since_ = kNever;
  Time last_zero_ = kNever;
  Time heard_ = kNever;      ///< the last message, whatever became of it
  Time row_since_ = kNever;  ///< of messages that were near enough to each other
  Duration gap_{};  ///< between two messages of late that were too far apart for one stream
  Time gap_at_ = kNever;
  Time last_ = kNever;
  Time since_ = kNever;
  std::uint64_t accepted_ = 0;
  std::uint64_t refused_ = 0;
  Reason reason_;
  Reason obstacle_;
  Time refused_at_ = kNever;  ///< since one was followed last
  Reason news_;               ///< not announced yet; the newest is told
  Reason told_;
  Time told_at_ = kNever;
  Time same_until_ = kNever;  ///< until then the same is no news
};

}  // namespace drover::engine
