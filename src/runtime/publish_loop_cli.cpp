// The command line's requests to the publish thread, and their answers.
#include <cmath>

#include "json/json_text.h"
#include "json/located_json.h"
#include "publish/rtk_navigation/trajectory_data.h"
#include "runtime/clock.h"
#include "runtime/publish_loop.h"

namespace drover::runtime {

namespace {

std::string refusal(std::string_view reason) {
  return json::JsonText()
      .open('{')
      .key("ok")
      .boolean(false)
      .key("reason")
      .text(reason)
      .close('}')
      .take();
}

double length_m(const store::Track& track) {
  double length = 0;
  for (std::size_t i = 1; i < track.points.size(); ++i)
    length += std::hypot(track.points[i].x_m - track.points[i - 1].x_m,
                         track.points[i].y_m - track.points[i - 1].y_m);
  return length;
}

}  // namespace

void PublishLoop::on_cli_line(CliServer::ClientId client, std::string_view line, Time now) {
  const auto document =
      json::parse(line, {.max_bytes = 64 * 1024, .max_depth = 4, .max_values = 64});
  if (!document) return cli_.reply(client, refusal("not understood: " + document.error().text()));
  const auto text_of = [&](std::string_view key) {
    const auto* node = document->root.find(key);
    return node != nullptr && node->text() != nullptr ? *node->text() : std::string();
  };
  const auto cmd = text_of("cmd");
  const auto name = text_of("name");
  const auto request = [&](publish::ControlCommand command) {
    const auto number = next_request_++;
    waiting_[number] = client;
    service_.on_cli(number, std::move(command), now, actions_);
    carry_out(actions_);
  };
  if (cmd == "task_start") {
    const auto* id = document->root.find("id");
    const auto* speed = document->root.find("speed");
    if (id == nullptr || !id->integer() || speed == nullptr || !speed->number())
      return cli_.reply(client, refusal("id (a whole number) or speed is missing"));
    return request(publish::StartTaskRequest{name, *id->integer(), *speed->number()});
  }
  if (cmd == "task_cancel") return request(publish::CancelTaskRequest{});
  if (cmd == "traj_delete") return request(publish::DeleteTrajectory{name});
  if (cmd == "reset") return request(publish::ResetStopRequest{});
  if (cmd == "stop") return request(publish::TerminateRequest{});
  if (cmd == "release") {
    const auto* on_slope = document->root.find("on_slope");
    const bool* said = on_slope == nullptr ? nullptr : on_slope->boolean();
    return request(publish::ReleaseRequest{said != nullptr && *said});
  }
  if (cmd == "hold") return request(publish::HoldRequest{});
  if (cmd == "heading_find") return request(publish::FindHeadingRequest{});
  cli_.reply(client, cli_reply(cmd, name));
}

/// Questions that are answered from what is at hand.
std::string PublishLoop::cli_reply(std::string_view cmd, const std::string& name) {
  json::JsonText out;
  out.open('{').key("ok").boolean(true);
  if (cmd == "version") {
    out.key("version").text(DROVER_VERSION);
  } else if (cmd == "status") {
    publish::DaemonStatus daemon;
    daemon.robot = config_.robot_name;
    daemon.broker_connected = broker_ && broker_->connected();
    daemon.broker_text = broker_ ? broker_text_ : "not configured";
    daemon.now = monotonic_now();
    daemon.uptime_s = to_s(daemon.now - started_);
    daemon.telemetry_dropped = broker_ ? broker_->dropped() : 0;
    daemon.answers_lost = lost_answers_ + (stops_ != nullptr ? stops_->lost_answers() : 0);
    for (const auto& each : outlets_) each.outlet->count(daemon);
    daemon.events_lost = control_.lost_events.load(std::memory_order_relaxed);
    daemon.stop_trouble = storage_.stop_trouble.latest().view();
    // The status is an object of its own already.
    return R"({"ok":true,"status":)" + publish::status_json(seen(daemon.now), daemon) + "}";
  } else if (cmd == "traj_list") {
    out.key("tracks").open('[');
    for (const auto& [key, track] : service_.tracks()) {
      out.open('{').key("name").text(key);
      out.key("points").integer(static_cast<std::int64_t>(track.points.size()));
      out.key("length_m").number(length_m(track)).close('}');
    }
    out.close(']');
  } else if (cmd == "traj_show") {
    const auto track = service_.find_track(name);
    if (!track) return refusal("there is no track named \"" + name + "\"");
    const auto list = publish::trajectory_data_text({&*track, 1});
    return R"({"ok":true,"track":)" + list.substr(1, list.size() - 2) + "}";
  } else {
    return refusal("unknown request \"" + std::string(cmd) + "\"");
  }
  out.close('}');
  return out.take();
}

}  // namespace drover::runtime
