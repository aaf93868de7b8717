#include "publish/aimrt_outlet.h"

namespace drover::publish {

std::vector<WantedTopic> AimrtOutlet::wants() const {
  std::vector<WantedTopic> topics;
  if (hears_commands_)
    for (const auto& topic : channel_.command_topics()) topics.push_back({topic, 0});
  return topics;
}

std::vector<OutMessage> AimrtOutlet::on_snapshot(const Snapshot& seen, const Moment& moment,
                                                 Actions&) {
  std::vector<OutMessage> messages;
  for (auto& [topic, payload] : channel_.telemetry(seen, moment.wall_minus_monotonic))
    messages.push_back({topic->c_str(), std::move(payload)});
  return messages;
}

bool AimrtOutlet::on_message(std::string_view topic, std::string_view payload,
                             const Arrival& arrival, Time now, Actions& out) {
  const auto names = channel_.command_names(topic);
  if (!names) return false;
  channel_.on_command(*names, payload, arrival, now, arrival.wall - now.time_since_epoch(), out);
  return true;
}

}  // namespace drover::publish
