#include "publish/cli_outlet.h"

#include <cmath>
#include <optional>

#include "json/json_text.h"
#include "json/located_json.h"
#include "publish/line_json.h"
#include "publish/rtk_navigation/trajectory_data.h"

namespace drover::publish {
namespace {

constexpr json::Limits kLimits{.max_bytes = 64 * 1024, .max_depth = 4, .max_values = 64};

std::string refusal(std::string_view reason) {
  return reply_line(false, reason);
}

std::string stop_refused_line(std::string_view reason) {
  json::JsonText reply;
  reply.open('{').key("ok").boolean(false).key("cmd").text("stop");
  return reply.key("reason").text(reason).close('}').take();
}

double length_m(const store::Track& track) {
  double length = 0;
  for (std::size_t i = 1; i < track.points.size(); ++i)
    length += std::hypot(track.points[i].x_m - track.points[i - 1].x_m,
                         track.points[i].y_m - track.points[i - 1].y_m);
  return length;
}

bool is_true(const json::Node& request, std::string_view key) {
  const auto* node = request.find(key);
  const bool* said = node == nullptr ? nullptr : node->boolean();
  return said != nullptr && *said;
}

/// What the service is asked for, but for a start, which has numbers that may be missing. Nothing:
/// it is a question.
std::optional<ControlCommand> command_of(std::string_view cmd, const std::string& name,
                                         const json::Node& request) {
  if (cmd == "task_cancel") return CancelTaskRequest{};
  if (cmd == "traj_delete") return DeleteTrajectory{name};
  if (cmd == "reset") return ResetStopRequest{};
  if (cmd == "stop") return TerminateRequest{};
  if (cmd == "release") return ReleaseRequest{is_true(request, "on_slope")};
  if (cmd == "hold") return HoldRequest{};
  if (cmd == "heading_find") return FindHeadingRequest{};
  if (cmd == "position_accept") return AcceptPositionRequest{};
  if (cmd == "learned_forget") return ForgetLearnedRequest{};
  return std::nullopt;
}

/// Why it is no request at all; empty when it is one.
std::string cmd_problem(const json::Node& request) {
  if (request.object() == nullptr)
    return "a request is an object like {\"cmd\":\"status\"}, not " + std::string(request.kind());
  const auto* cmd = request.find("cmd");
  if (cmd == nullptr) return "'cmd' is missing: what is asked for, like {\"cmd\":\"status\"}";
  if (cmd->text() == nullptr) return "'cmd' must be a text, not " + std::string(cmd->kind());
  return {};
}

}  // namespace

bool is_stop_line(std::string_view line) {
  const auto has = [line](std::string_view word) {
    return line.find(word) != std::string_view::npos;
  };
  if (line.size() > kShortMessageBytes || (!has("\"stop\"") && !has("\"task_cancel\"")))
    return false;
  const auto document = json::parse(line, kLimits);
  if (!document || document->root.object() == nullptr) return false;
  const auto cmd = text_member(document->root, "cmd");
  return cmd == "stop" || cmd == "task_cancel";
}

std::optional<CliOutlet::NamedStop> CliOutlet::named_stop(const json::Node& request) {
  const auto from = text_member(request, "from");
  const auto* number = request.find("number");
  if (from.empty() || number == nullptr || !number->integer()) return std::nullopt;
  return NamedStop{from, *number->integer()};
}

/// Its answer was lost with the connection. What was done is not done again: a person may have
/// reset it meanwhile.
bool CliOutlet::told_again(ClientId client, const NamedStop& stop, Actions& out) {
  if (stop.from != last_stop_.from || stop.number != last_stop_.number) return false;
  if (last_stop_.done)
    out.emplace_back(Reply{client, reply_line(true, "it was done already")});
  else
    waiting_.at(last_stop_.request).client = client;
  return true;
}

bool CliOutlet::on_line(ClientId client, std::string_view line, Time now, Actions& out) {
  const auto reply = [&](std::string text) {
    out.emplace_back(Reply{client, std::move(text)});
    return true;
  };
  const auto document = json::parse(line, kLimits);
  if (!document) return reply(refusal("not understood: " + document.error().text()));
  const json::Node& request = document->root;
  if (const auto problem = cmd_problem(request); !problem.empty()) return reply(refusal(problem));
  const auto cmd = text_member(request, "cmd");
  const auto name = text_member(request, "name");
  auto command = command_of(cmd, name, request);
  if (cmd == "task_start") {
    const auto* id = request.find("id");
    const auto* speed = request.find("speed");
    if (id == nullptr || !id->integer() || speed == nullptr || !speed->number())
      return reply(refusal("id (a whole number) or speed is missing"));
    command = StartTaskRequest{name, *id->integer(), *speed->number()};
  }
  if (!command) return reply(at_once(cmd, name, now));
  const auto stop = cmd == "stop" ? named_stop(request) : std::nullopt;
  if (stop && told_again(client, *stop, out)) return true;
  const auto number = next_request_++;
  if (stop) last_stop_ = {stop->from, stop->number, number};
  waiting_[number] = {client, cmd == "stop"};
  service_.on_cli(number, std::move(*command), now, out);
  return true;
}

bool CliOutlet::on_answer(const Answer& answer, Actions& out) {
  if (answer.id.source != RequestId::Source::cli) return false;
  const auto waiting = waiting_.find(answer.id.number);
  if (waiting == waiting_.end()) return false;
  const auto [client, stop] = waiting->second;
  // Who hands on stops beside other requests has to know which was not obeyed.
  out.emplace_back(Reply{client, stop && !answer.ok ? stop_refused_line(answer.text)
                                                    : reply_line(answer.ok, answer.text)});
  waiting_.erase(waiting);
  // One that was refused is to be tried again.
  if (answer.id.number == last_stop_.request) {
    last_stop_.done = answer.ok;
    if (!answer.ok) last_stop_ = {};
  }
  return true;
}

/// Questions that are answered from what is at hand.
std::string CliOutlet::at_once(std::string_view cmd, const std::string& name, Time now) const {
  // Status and track are objects of their own already.
  if (cmd == "status") return R"({"ok":true,"status":)" + status_(now) + "}";
  if (cmd == "traj_show") {
    const auto track = service_.find_track(name);
    if (!track) return refusal("there is no track named \"" + name + "\"");
    const auto list = trajectory_data_text({&*track, 1});
    return R"({"ok":true,"track":)" + list.substr(1, list.size() - 2) + "}";
  }
  json::JsonText out;
  out.open('{').key("ok").boolean(true);
  if (cmd == "version") {
    out.key("version").text(DROVER_VERSION);
  } else if (cmd == "traj_list") {
    out.key("tracks").open('[');
    for (const auto& [key, track] : service_.tracks()) {
      out.open('{').key("name").text(key);
      out.key("points").integer(static_cast<std::int64_t>(track.points.size()));
      out.key("length_m").number(length_m(track)).close('}');
    }
    out.close(']');
  } else {
    return refusal("unknown request \"" + std::string(cmd) + "\"");
  }
  return out.close('}').take();
}

}  // namespace drover::publish
