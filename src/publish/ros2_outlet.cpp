#include "publish/ros2_outlet.h"

#include "json/located_json.h"
#include "publish/line_json.h"

namespace drover::publish {

namespace {

constexpr std::size_t kMostText = 200;

std::int64_t count_of(const json::Node& request, std::string_view key) {
  const auto* node = request.find(key);
  return node == nullptr ? 0 : node->integer().value_or(0);
}

}  // namespace

std::vector<OutMessage> Ros2Outlet::on_snapshot(const Snapshot& seen, const Moment& moment,
                                                Actions& out) {
  if (!follows(moment.now)) return {};
  out.emplace_back(
      Reply{client_, ros2::state_line(seen, moment.wall_minus_monotonic, turns_(), told_)});
  return {};
}

bool Ros2Outlet::on_line(ClientId client, std::string_view line, Time now, Actions& out) {
  if (line.find("ros2_follow") == std::string_view::npos) return false;
  const auto document = json::parse(line, {.max_bytes = 2048, .max_depth = 2, .max_values = 8});
  if (!document || text_member(document->root, "cmd") != "ros2_follow") return false;
  if (!requests_.take(now)) {
    out.emplace_back(
        Reply{client, reply_line(false, "slow down: " + requests_.in_words("requests"))});
    return true;
  }
  if (client != client_ && follows(now)) {
    out.emplace_back(Reply{client, reply_line(false, "another drover-ros2 shows this robot")});
    return true;
  }
  if (client != client_) told_ = {};
  client_ = client;
  heard_ = now;
  mode_ = json::shown(text_member(document->root, "mode"), kMostText);
  reason_ = json::shown(text_member(document->root, "reason"), kMostText);
  readers_ = count_of(document->root, "readers");
  incompatible_ = count_of(document->root, "incompatible");
  return true;
}

void Ros2Outlet::count(DaemonStatus& status) const {
  status.ros2.configured = true;
  status.ros2.connected = follows(status.now);
  if (!status.ros2.connected) return;
  status.ros2.mode = mode_;
  status.ros2.reason = reason_;
  status.ros2.readers = readers_;
  status.ros2.incompatible = incompatible_;
}

}  // namespace drover::publish
