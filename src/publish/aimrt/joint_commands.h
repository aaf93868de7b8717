// Joint commands, by whichever way they come: one owner of the joints of a group, a limit of its
// own for each way, and what becomes of a message.
//
// Pure, as the command service: time is an argument, and what must be done is appended to actions.
#pragma once

#include <functional>
#include <string>
#include <string_view>
#include <vector>

#include "publish/actions.h"
#include "publish/aimrt/joint_command.h"
#include "publish/aimrt/writers.h"
#include "publish/arrival.h"
#include "publish/token_bucket.h"

namespace drover::publish::aimrt {

struct JointCommandsConfig {
  JointCommandRules rules;
  /// After which a stream has ended; of a group, after the longest JointRule::timeout of its own.
  Duration silence = std::chrono::milliseconds(100);
  /// By each way, the broker and ROS 2: more are not looked at. 200 a second and what came late.
  double max_commands_Hz = 250;
  double command_burst = 50;
  /// Since a way was opened, nobody's are followed: at least kJustCame, and as long as they may be
  /// apart.
  Duration just_came = kJustCame;
};

/// A message that could be read, and who wrote it.
struct JointCommandHeard {
  JointCommandMessage message;
  Writer writer;
};

class JointCommands final {
 public:
  /// What came, or why it is no command.
  using Heard = Result<JointCommandHeard, JointTargetsRefused>;
  /// Reads it. Not called for what nobody looks at.
  using Read = std::function<Heard()>;

  explicit JointCommands(const JointCommandsConfig& config);

  /// A message: a JointTargets or JointTargetsRefused for the engine, and now and then a line for
  /// the log. `wall`: UTC now, since 1970.
  void take(RequestId::Source source, const Read& read, Time now, Duration wall, Actions& out);
  /// What is older, by its time stamp or by when it came to this computer, is refused.
  Duration max_age() const { return rules_.max_age; }
  /// Since a way was opened, nobody's are followed.
  Duration just_came() const { return just_came_; }
  /// Messages of a flood that nobody looked at, so far.
  std::uint64_t unread() const { return unread_; }
  /// Programs that write at once, and which of them is followed; empty when there is one or none.
  std::string_view rivals(Time now) const;
  /// Messages that were refused for that, so far.
  std::uint64_t rivals_refused() const;

 private:
  /// Whose commands the joints of a group follow; the base is the first.
  struct Group {
    Writers writers;
    std::uint64_t last_stamp_ns = 0;
  };
  static void take(Group& group, const JointCommandHeard& heard, Time now);
  Result<JointTargets, Reason> judged(const JointCommandHeard& heard, Time now, Duration wall);
  std::vector<bool> named(const JointCommandMessage& message) const;
  JointTargets told(std::size_t group, const JointTargets& targets) const;

  JointCommandRules rules_;
  std::uint64_t commands_ = 0;
  std::uint64_t unread_ = 0;
  std::vector<Group> groups_;
  /// One way by which they come: a flood by it takes nothing of the other's.
  struct Way {
    TokenBucket commands;
    TokenBucket flood{1, 1};  ///< a flood is told of, and the telling is no flood
    TokenBucket log{0.2, 3};
    TokenBucket rivals{0.2, 1};  ///< other refusals do not drown it
  };
  Way& way_of(RequestId::Source source);

  Way broker_;
  Way ros2_;
  Duration just_came_;
  std::string slow_down_;  ///< what is said when the bucket of a way is empty
};

}  // namespace drover::publish::aimrt
