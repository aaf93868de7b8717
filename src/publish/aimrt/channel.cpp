#include "publish/aimrt/channel.h"

#include <algorithm>

#include "config/located_json.h"
#include "publish/aimrt/messages.h"
#include "publish/aimrt/packet.h"
#include "publish/aimrt/topic.h"

namespace drover::publish::aimrt {

namespace {

/// A beat of the timer before a tenth of a second is over.
constexpr Duration kTouchPeriod = std::chrono::milliseconds(90);

bool has_touch_lines(const Snapshot& snapshot) {
  return std::any_of(snapshot.line_configured.begin(), snapshot.line_configured.end(),
                     [i = std::size_t{0}](bool configured) mutable {
                       return static_cast<Line>(i++) != Line::estop && configured;
                     });
}

}  // namespace

Channel::Channel(const ChannelConfig& config)
    : joint_state_topic_(mqtt_topic(config.joint_state, "JointState")),
      imu_state_topic_(mqtt_topic(config.imu_state, "ImuState")),
      touch_state_topic_(mqtt_topic(config.touch_state, "TouchState")),
      joint_command_topic_(mqtt_topic(config.joint_command, "JointCommand")),
      rules_(config.rules),
      command_bucket_(config.max_commands_Hz, config.command_burst),
      flood_bucket_(1, 1),
      log_bucket_(0.2, 3) {}

std::vector<Telemetry> Channel::telemetry(const Snapshot& snapshot, Duration wall_minus_monotonic) {
  std::vector<Telemetry> packets;
  const auto add = [&packets](const std::string& topic, const std::string& message) {
    packets.push_back({&topic, encode_packet(message)});
  };
  // While a drive is late the cycle's own time: no stamp comes twice. None without a new cycle.
  const Time heard = joint_time(snapshot);
  if (const Time at = heard > last_joints_ ? heard : snapshot.time; at > last_joints_) {
    last_joints_ = at;
    add(joint_state_topic_, joint_state(snapshot, at, {wall_minus_monotonic, ++joint_sequence_}));
  }
  const auto& imu = snapshot.imu;
  if (imu.configured && imu.health == SourceState::fresh && imu.time > last_imu_) {
    last_imu_ = imu.time;
    add(imu_state_topic_, imu_state(snapshot, {wall_minus_monotonic, ++imu_sequence_}));
  }
  if (touch_is_due(snapshot))
    add(touch_state_topic_, touch_state(snapshot, {wall_minus_monotonic, ++touch_sequence_}));
  return packets;
}

bool Channel::touch_is_due(const Snapshot& snapshot) {
  if (!has_touch_lines(snapshot)) return false;
  const auto lines = touched(snapshot);
  if (lines == touched_ && snapshot.time - last_touch_ < kTouchPeriod) return false;
  touched_ = lines;
  last_touch_ = snapshot.time;
  return true;
}

Result<JointTargets, Reason> Channel::judged(std::string_view payload, const Arrival& arrival,
                                             Duration wall) {
  // Old by its nature, whatever its stamp.
  if (arrival.retain != Retain::no) return Reason("a retained message is never followed");
  if (!arrival.late.empty()) return Reason(arrival.late);
  const auto packet = decode_packet(payload);
  if (!packet) return Reason(text(packet.error()));
  if (packet->content_type != kProtobuf)
    return Reason("the content type '" + json::shown(packet->content_type, 16) + "' is not pb");
  if (packet->message.size() > kMaxCommandBytes) return Reason("the message is longer than 16 KiB");
  const auto message = decode_joint_command(packet->message);
  if (!message) return Reason("the message is no JointCommand");
  auto targets = accept_joint_command(*message, rules_, wall, last_stamp_ns_);
  if (targets && message->stamp_ns != 0) last_stamp_ns_ = message->stamp_ns;
  return targets;
}

void Channel::on_command(std::string_view payload, const Arrival& arrival, Time now,
                         Duration wall_minus_monotonic, Actions& out) {
  Reason reason;
  if (!command_bucket_.take(now)) {
    // The engine's ring is for others too: a stop must find room in it.
    if (!flood_bucket_.take(now)) {
      ++unread_;
      return;
    }
    reason = "too many messages a second, slow down";
  }
  Command command{{RequestId::Source::aimrt, ++commands_}, now, {}};
  if (reason.empty()) {
    const auto targets = judged(payload, arrival, now.time_since_epoch() + wall_minus_monotonic);
    if (targets) {
      command.body = *targets;
    } else {
      reason = targets.error();
    }
  }
  if (!reason.empty()) {
    command.body = JointTargetsRefused{reason};
    if (log_bucket_.take(now)) {
      out.push_back(
          LogLine{Notice::Level::warning, "joint command refused: " + std::string(reason.view())});
    }
  }
  out.push_back(command);
}

}  // namespace drover::publish::aimrt
