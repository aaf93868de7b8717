#include "publish/aimrt/channel.h"

#include <algorithm>

#include "json/located_json.h"
#include "publish/aimrt/messages.h"

namespace drover::publish::aimrt {

namespace {

/// The message of a packet, whichever way it is written.
Result<JointCommandMessage, Reason> decoded(const Packet& packet, Names names, Content content) {
  if (content == Content::json) return decode_joint_command_json(packet.message);
  auto message = decode_joint_command(packet.message);
  if (message) return std::move(*message);
  return Reason("the message is no " + std::string(type_name(Role::joint_command, names)));
}

std::optional<Content> content_of(std::string_view content_type) {
  for (const Content content : {Content::pb, Content::json})
    if (content_type == spelling(content)) return content;
  return std::nullopt;
}

}  // namespace

Channel::Topics Channel::topics(const std::string& topic, Role role, const Wording& wording) {
  Topics found{{}, wording.content};
  for (const Names names : wording.names) found.names.push_back(mqtt_topic(topic, role, names));
  return found;
}

Channel::Channel(const ChannelConfig& config)
    : joint_state_(topics(config.joint_state, Role::joint_state, config.joint_state_wording)),
      imu_state_(topics(config.imu_state, Role::imu_state, config.imu_state_wording)),
      touch_state_(topics(config.touch_state, Role::touch_state, config.touch_state_wording)),
      command_topics_{mqtt_topic(config.joint_command, Role::joint_command, Names::document),
                      mqtt_topic(config.joint_command, Role::joint_command, Names::aimrt_1x)},
      rules_(config.rules),
      command_bucket_(config.max_commands_Hz, config.command_burst),
      slow_down_("slow down: " + command_bucket_.in_words("messages")),
      flood_bucket_(1, 1),
      log_bucket_(0.2, 3),
      rivals_bucket_(0.2, 1) {
  std::size_t groups = 1;
  for (const JointRule& joint : rules_.joints) groups = std::max(groups, joint.group + 1);
  groups_.assign(groups, Group{Writers(config.silence)});
}

std::string_view Channel::rivals(Time now) const {
  for (const Group& group : groups_)
    if (const auto text = group.writers.rivals(now); !text.empty()) return text;
  return {};
}

std::uint64_t Channel::rivals_refused() const {
  std::uint64_t refused = 0;
  for (const Group& group : groups_) refused += group.writers.refused();
  return refused;
}

/// By group, whether a joint of it is named; a message that names none is the base's.
std::vector<bool> Channel::named(const JointCommandMessage& message) const {
  std::vector<bool> groups(groups_.size());
  for (const auto& entry : message.joints) {
    const auto joint = find_joint(rules_, entry.name);
    if (joint != rules_.joints.end()) groups[joint->group] = true;
  }
  if (std::find(groups.begin(), groups.end(), true) == groups.end()) groups[0] = true;
  return groups;
}

std::optional<Names> Channel::command_names(std::string_view topic) const {
  for (const Names names : {Names::document, Names::aimrt_1x})
    if (topic == command_topics_[static_cast<std::size_t>(names)]) return names;
  return std::nullopt;
}

std::vector<Telemetry> Channel::telemetry(const Snapshot& snapshot, Duration wall_minus_monotonic) {
  std::vector<Telemetry> packets;
  const auto add = [&packets](const Topics& topics, const std::string& message) {
    const auto packet = encode_packet(message, topics.content);
    for (const auto& topic : topics.names) packets.push_back({&topic, packet});
  };
  if (const Time at = next_joint_time(snapshot, last_joints_); at != kNever) {
    last_joints_ = at;
    add(joint_state_,
        joint_state(snapshot, at, {wall_minus_monotonic, ++joint_sequence_}, joint_state_.content));
  }
  const auto& imu = snapshot.imu;
  if (imu.configured && imu.health == SourceState::fresh && imu.time > last_imu_) {
    last_imu_ = imu.time;
    orientation_ = imu_orientation(snapshot, orientation_);
    add(imu_state_, imu_state(snapshot, {wall_minus_monotonic, ++imu_sequence_}, imu_state_.content,
                              orientation_));
  }
  if (touch_.due(snapshot))
    add(touch_state_,
        touch_state(snapshot, {wall_minus_monotonic, ++touch_sequence_}, touch_state_.content));
  return packets;
}

Result<JointTargets, Reason> Channel::judged(Names names, std::string_view payload,
                                             const Arrival& arrival, Time now, Duration wall) {
  // Old by its nature, whatever its stamp.
  if (arrival.retain != Retain::no) return Reason("a retained message is never followed");
  if (!arrival.late.empty()) return Reason(arrival.late);
  if (payload.size() > kMaxCommandBytes) return Reason("the packet is longer than 16 KiB");
  const auto packet = decode_packet(payload);
  if (!packet) return Reason(text(packet.error()));
  const auto content = content_of(packet->content_type);
  if (!content) {
    return Reason("the content type '" + json::shown(packet->content_type, 16) +
                  "' is neither pb nor json");
  }
  const auto message = decoded(*packet, names, *content);
  if (!message) return message.error();
  return judged(*message,
                {names, *content, message->stamp_ns, message->sequence, message->frame_id}, now,
                wall);
}

Result<JointTargets, Reason> Channel::judged(const JointCommandMessage& message,
                                             const Writer& writer, Time now, Duration wall) {
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
    if (auto why = groups_[i].writers.hindrance(writer, rests, now); !why.empty()) return why;
    last_stamp_ns = std::max(last_stamp_ns, groups_[i].last_stamp_ns);
  }
  auto targets = accept_joint_command(message, rules_, wall, last_stamp_ns);
  if (!targets) return targets;
  for (std::size_t i = 0; i < groups.size(); ++i) {
    if (!groups[i]) continue;
    if (message.stamp_ns != 0) groups_[i].last_stamp_ns = message.stamp_ns;
    if (auto why = groups_[i].writers.take(writer, *targets, now); !why.empty()) return why;
  }
  return targets;
}

void Channel::on_command(Names names, std::string_view payload, const Arrival& arrival, Time now,
                         Duration wall_minus_monotonic, Actions& out) {
  Reason reason;
  if (!command_bucket_.take(now)) {
    // The engine's ring is for others too: a stop must find room in it.
    if (!flood_bucket_.take(now)) {
      ++unread_;
      return;
    }
    reason = Reason(slow_down_);
  }
  Command command{{RequestId::Source::aimrt, ++commands_}, now, {}};
  const auto rivals_before = rivals_refused();
  if (reason.empty()) {
    const auto targets =
        judged(names, payload, arrival, now, now.time_since_epoch() + wall_minus_monotonic);
    if (targets) {
      command.body = *targets;
    } else {
      reason = targets.error();
    }
  }
  if (!reason.empty()) {
    command.body = JointTargetsRefused{reason};
    const bool of_rivals = rivals_refused() != rivals_before;
    if ((of_rivals ? rivals_bucket_ : log_bucket_).take(now)) {
      out.push_back(
          LogLine{Notice::Level::warning, "joint command refused: " + std::string(reason.view())});
    }
  }
  out.push_back(command);
}

}  // namespace drover::publish::aimrt
