#include "publish/aimrt/joint_commands.h"

#include <algorithm>

namespace drover::publish::aimrt {

JointCommands::JointCommands(const JointCommandsConfig& config)
    : rules_(config.rules),
      broker_{TokenBucket(config.max_commands_Hz, config.command_burst)},
      ros2_(broker_),
      just_came_(config.just_came),
      slow_down_("slow down: " + broker_.commands.in_words("messages")) {
  std::vector<Duration> silences{config.silence};  // by group
  for (const JointRule& joint : rules_.joints) {
    silences.resize(std::max(silences.size(), joint.group + 1), config.silence);
    silences[joint.group] = std::max(silences[joint.group], joint.timeout);
  }
  for (const Duration silence : silences) groups_.push_back({Writers(silence)});
}

JointCommands::Way& JointCommands::way_of(RequestId::Source source) {
  return source == RequestId::Source::ros2 ? ros2_ : broker_;
}

std::string_view JointCommands::rivals(Time now) const {
  for (const Group& group : groups_)
    if (const auto text = group.writers.rivals(now); !text.empty()) return text;
  return {};
}

std::uint64_t JointCommands::rivals_refused() const {
  std::uint64_t refused = 0;
  for (const Group& group : groups_) refused += group.writers.refused();
  return refused;
}

/// By group, whether a joint of it is named; a message that names none is the base's.
std::vector<bool> JointCommands::named(const JointCommandMessage& message) const {
  std::vector<bool> groups(groups_.size());
  for (const auto& entry : message.joints) {
    const auto joint = find_joint(rules_, entry.name);
    if (joint != rules_.joints.end()) groups[joint->group] = true;
  }
  if (std::find(groups.begin(), groups.end(), true) == groups.end()) groups[0] = true;
  return groups;
}

/// What the message tells the joints of a group: of the base, that those it does not name rest.
/// Others are left as they are.
JointTargets JointCommands::told(std::size_t group, const JointTargets& targets) const {
  JointTargets told;
  for (std::size_t axis = 0; axis < rules_.joints.size(); ++axis) {
    if (rules_.joints[axis].group != group) continue;
    const auto named = std::find_if(
        targets.joints.begin(), targets.joints.end(),
        [axis](const JointTarget& target) { return std::size_t{target.axis} == axis; });
    // No more than the robot's joints: it fits.
    if (named != targets.joints.end())
      (void)told.joints.push_back(*named);
    else if (group == 0)
      (void)told.joints.push_back({static_cast<AxisId>(axis)});
  }
  return told;
}

void JointCommands::take(Group& group, const JointCommandHeard& heard, Time now) {
  if (heard.message.stamp_ns != 0) group.last_stamp_ns = heard.message.stamp_ns;
  group.writers.take(heard.writer, now);
}

Result<JointTargets, Reason> JointCommands::judged(const JointCommandHeard& heard, Time now,
                                                   Duration wall) {
  const auto& [message, writer] = heard;
  const auto groups = named(message);
  const bool base_rests =
      std::all_of(message.joints.begin(), message.joints.end(), [this](const auto& entry) {
        const auto joint = find_joint(rules_, entry.name);
        return entry.velocity_radps == 0 || (joint != rules_.joints.end() && joint->group != 0);
      });
  std::uint64_t last_stamp_ns = 0;
  for (std::size_t i = 0; i < groups.size(); ++i) {
    if (!groups[i]) continue;
    // Whoever takes joints outside the base over begins where they are, whatever he asks.
    const bool rests = i != 0 || base_rests;
    if (auto why = groups_[i].writers.hindrance(writer, rests, now); !why.empty()) {
      // A number that cannot be is told as that: it is none of a begin that only has to rest first.
      const auto numbers = accept_joint_command(message, rules_, wall, 0);
      return rests || numbers ? why : numbers.error();
    }
    last_stamp_ns = std::max(last_stamp_ns, groups_[i].last_stamp_ns);
  }
  auto targets = accept_joint_command(message, rules_, wall, last_stamp_ns);
  if (!targets) return targets;
  // All are asked before one takes it: what is refused leaves no other group with its program.
  for (std::size_t i = 0; i < groups.size(); ++i) {
    if (!groups[i]) continue;
    if (auto why = groups_[i].writers.weigh(writer, told(i, *targets), now); !why.empty()) {
      take(groups_[i], heard, now);  // there its program goes on, and nothing of it is followed
      return why;
    }
  }
  for (std::size_t i = 0; i < groups.size(); ++i)
    if (groups[i]) take(groups_[i], heard, now);
  return targets;
}

void JointCommands::take(RequestId::Source source, const Read& read, Time now, Duration wall,
                         Actions& out) {
  JointTargetsRefused refused;
  Way& way = way_of(source);
  if (!way.commands.take(now)) {
    // The engine's ring is for others too: a reset must find room in it.
    if (!way.flood.take(now)) {
      ++unread_;
      return;
    }
    refused.reason = Reason(slow_down_);
  }
  Command command{{source, ++commands_}, now, {}};
  const auto rivals_before = rivals_refused();
  if (refused.reason.empty()) {
    const auto heard = read();
    if (!heard) {
      refused = heard.error();
    } else if (const auto targets = judged(*heard, now, wall)) {
      command.body = *targets;
    } else {
      refused.reason = targets.error();
    }
  }
  if (!refused.reason.empty()) {
    command.body = refused;
    const bool of_rivals = rivals_refused() != rivals_before;
    if ((of_rivals ? way.rivals : way.log).take(now)) {
      out.push_back(LogLine{Notice::Level::warning,
                            "joint command refused: " + std::string(refused.reason.view())});
    }
  }
  out.push_back(command);
}

}  // namespace drover::publish::aimrt
