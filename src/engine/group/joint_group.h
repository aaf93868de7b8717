// Joints outside the base that belong together, under an owner of their own.
#pragma once

#include <span>
#include <vector>

#include "engine/event_queue.h"
#include "engine/group/joint_notices.h"
#include "engine/group/joint_servo.h"

namespace drover::engine {

/// The joints of a group follow a stream of commands together, or none: when one of them ends it,
/// for a fault of its drive or because it is not heard, the others hold, too. It knows nothing of
/// the base, and the base nothing of it.
class JointGroup final {
 public:
  JointGroup(const GroupConfig& config, Duration start_timeout);

  /// The joints of the message that are its own; others are somebody else's.
  void take(const JointTargets& targets, RequestId::Source source, Time now);
  /// A command that was refused before anybody looked whose joints it names.
  void refuse(const JointTargetsRefused& refused, Time now);
  /// A person's word, or a stop: what it follows ends.
  void end(const Reason& why);

  struct Input {
    Time now = kNever;
    Duration dt{};
    std::span<const AxisSnapshot> axes;  ///< all of the robot, by AxisId
    Duration stale{};                    ///< what was measured longer ago says nothing
    const Reason& hindrance;             ///< as JointServo::Input
    bool blocked = false;                ///< likewise
    bool estop = false;                  ///< it is over all
  };
  /// One cycle: writes the commands of its joints, by AxisId, and which of them may be moved.
  void step(const Input& input, std::span<AxisCommand> commands, std::span<bool> may_move,
            EventQueue& events);

  const GroupSnapshot& snapshot() const { return told_; }

 private:
  Reason trouble(const Input& input) const;
  void tell_lost(const AxisSnapshot& axis, const JointServo& joint, Time now,
                 EventQueue& events) const;
  void count(bool limited, bool hindered, Time now);
  GroupOwner owner(bool estop) const;
  Reason why_not(const Input& input, const Reason& hindrance) const;
  void tell_drives(const Input& input, EventQueue& events);
  void tell_found(const Input& input, EventQueue& events);
  void tell_pause(bool awaited, Time now, EventQueue& events);
  void notice(Time now, Notice::Level level, const char* what, std::string_view why,
              EventQueue& events) const;
  void tell(const Input& input, const Reason& lost, bool limited, EventQueue& events);
  Reason all_limited(std::span<const AxisSnapshot> axes, std::size_t room) const;

  Duration start_timeout_;
  std::vector<JointServo> joints_;  ///< made once
  JointNotices notices_;
  GroupSnapshot told_;
  GroupOwner sender_ = GroupOwner::nobody;  ///< of the last message
  std::uint64_t waiting_ = 0;               ///< messages since the last cycle
  Time limited_told_ = kNever;
  bool pause_told_ = false;     ///< since it followed last
  bool found_running_ = false;  ///< and that is not told yet
  Time found_told_ = kNever;
};

}  // namespace drover::engine
