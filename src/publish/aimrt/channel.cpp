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
  if (message) return message;
  const auto why = message.error().view();
  return Reason("the message is no " + std::string(type_name(Role::joint_command, names)) +
                (why.empty() ? "" : ": " + std::string(why)));
}

std::optional<Content> content_of(std::string_view content_type) {
  for (const Content content : {Content::pb, Content::json})
    if (content_type == spelling(content)) return content;
  return std::nullopt;
}

/// Whatever it says, by how it came; empty: it is looked at.
JointTargetsRefused refused_unread(const Arrival& arrival) {
  // Old by its nature, whatever its stamp.
  if (arrival.retain != Retain::no) return {"a retained message is never followed"};
  if (!arrival.late.empty()) return {Reason(arrival.late)};
  if (arrival.just_connected) return {Reason(kJustCameWords), true};
  return {};
}

Result<JointCommandHeard, Reason> read_packet(Names names, std::string_view payload) {
  if (payload.size() > kMaxCommandBytes) return Reason("the packet is longer than 16 KiB");
  const auto packet = decode_packet(payload);
  if (!packet) return Reason(text(packet.error()));
  const auto content = content_of(packet->content_type);
  if (!content) {
    return Reason("the content type '" + json::shown(packet->content_type, 16) +
                  "' is neither pb nor json");
  }
  auto message = decoded(*packet, names, *content);
  if (!message) return message.error();
  Writer writer{names, *content, message->stamp_ns, message->sequence, message->frame_id};
  return JointCommandHeard{*message, std::move(writer)};
}

}  // namespace

Channel::Topics Channel::topics(const std::string& topic, Role role, const Wording& wording) {
  Topics found{{}, wording.content};
  for (const Names names : wording.names) found.names.push_back(mqtt_topic(topic, role, names));
  return found;
}

Channel::Channel(const ChannelConfig& config, JointCommands& commands)
    : joint_state_(topics(config.joint_state, Role::joint_state, config.joint_state_wording)),
      imu_state_(topics(config.imu_state, Role::imu_state, config.imu_state_wording)),
      touch_state_(topics(config.touch_state, Role::touch_state, config.touch_state_wording)),
      command_topics_{mqtt_topic(config.joint_command, Role::joint_command, Names::document),
                      mqtt_topic(config.joint_command, Role::joint_command, Names::aimrt_1x)},
      commands_(commands) {}

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

void Channel::on_command(Names names, std::string_view payload, const Arrival& arrival, Time now,
                         Duration wall_minus_monotonic, Actions& out) {
  const auto read = [&]() -> JointCommands::Heard {
    if (const auto refused = refused_unread(arrival); !refused.reason.empty()) return refused;
    const auto heard = read_packet(names, payload);
    if (!heard) return JointTargetsRefused{heard.error()};
    return *heard;
  };
  commands_.take(RequestId::Source::aimrt, read, now, now.time_since_epoch() + wall_minus_monotonic,
                 out);
}

}  // namespace drover::publish::aimrt
