#include "publish/ros2_outlet.h"

#include <algorithm>
#include <optional>

#include "publish/line_json.h"

namespace drover::publish {

namespace {

constexpr std::size_t kMostText = 200;
/// The longest line of the socket: a joint command or an object as JSON in a text of JSON.
constexpr std::size_t kMostBytes = std::size_t{64} * 1024;

std::int64_t count_of(const json::Node& request, std::string_view key) {
  const auto* node = request.find(key);
  return node == nullptr ? 0 : node->integer().value_or(0);
}

std::optional<double> twist_number(const json::Node& request, std::string_view key) {
  const auto* node = request.find(key);
  return node == nullptr ? std::nullopt : node->number();
}

auto refuser(ClientId client, Actions& out) {
  return [client, &out](std::string_view why) {
    out.emplace_back(Reply{client, reply_line(false, why)});
  };
}

}  // namespace

std::vector<OutMessage> Ros2Outlet::on_snapshot(const Snapshot& seen, const Moment& moment,
                                                Actions& out) {
  wall_minus_monotonic_ = moment.wall_minus_monotonic;
  if (!follows(moment.now)) return {};
  out.emplace_back(
      Reply{client_, ros2::state_line(seen, moment.wall_minus_monotonic, turns_(), told_)});
  return {};
}

bool Ros2Outlet::on_line(ClientId client, std::string_view line, Time now, Actions& out) {
  const auto names = [line](std::string_view word) {
    return line.find(word) != std::string_view::npos;
  };
  if (!names("ros2_follow") && !names("cmd_vel") && !names("joint_command") &&
      !names("scene_message"))
    return false;
  const auto document =
      json::parse(line, {.max_bytes = kMostBytes, .max_depth = 2, .max_values = 8});
  if (!document) return false;
  const auto cmd = text_member(document->root, "cmd");
  if (cmd == "ros2_follow")
    follow(client, document->root, now, out);
  else if (cmd == "cmd_vel")
    cmd_vel(client, document->root, now, out);
  else if (cmd == "joint_command")
    joint_command(client, document->root, now, out);
  else if (cmd == "scene_message")
    scene_message(client, document->root, now, out);
  else
    return false;
  return true;
}

void Ros2Outlet::follow(ClientId client, const json::Node& request, Time now, Actions& out) {
  const auto refuse = refuser(client, out);
  if (!requests_.take(now)) return refuse("slow down: " + requests_.in_words("requests"));
  if (client != client_ && follows(now)) return refuse("another drover-ros2 shows this robot");
  if (client != client_) told_ = {};
  if (client != client_ || !follows(now)) since_ = now;
  client_ = client;
  heard_ = now;
  mode_ = json::shown(text_member(request, "mode"), kMostText);
  network_ = json::shown(text_member(request, "network"), kMostText);
  unused_ = json::shown(text_member(request, "unused"), kMostText);
  reason_ = json::shown(text_member(request, "reason"), kMostText);
  readers_ = count_of(request, "readers");
  incompatible_ = count_of(request, "incompatible");
}

void Ros2Outlet::cmd_vel(ClientId client, const json::Node& request, Time now, Actions& out) {
  const auto refuse = refuser(client, out);
  const auto give = [&](Time received, auto body) {
    Command command{{RequestId::Source::ros2, ++twist_number_}, received, {}};
    command.body = std::move(body);
    out.emplace_back(std::move(command));
  };
  if (!inputs_.cmd_vel) return refuse("cmd_vel is not opened: ros2.inputs.cmd_vel");
  if (!hands_on(client, now)) return refuse("only drover-ros2 hands cmd_vel on");
  if (!twists_.take(now)) {
    // The engine's ring is for others too: a stop must find room in it.
    if (flood_.take(now))
      give(now, TwistRefused{Reason("slow down: " + twists_.in_words("messages"))});
    return;
  }
  if (const auto why = text_member(request, "refused"); !why.empty())
    return give(now,
                TwistRefused{Reason(json::shown(why, kMostText)), flag_member(request, "ends")});
  const auto vx_mps = twist_number(request, "vx_mps");
  const auto wz_radps = twist_number(request, "wz_radps");
  const auto vy_mps = twist_number(request, "vy_mps");
  const auto at_ns = count_of(request, "at_ns");
  if (!vx_mps || !wz_radps || at_ns <= 0) return refuse("vx_mps, wz_radps or at_ns is missing");
  const double aside_mps = vy_mps.value_or(0);
  if (aside_mps != 0 && !inputs_.sideways) {
    Reason why;
    why.format("linear.y is %g: this base cannot go sideways", aside_mps);
    return give(now, TwistRefused{why});
  }
  give(std::min(now, Time{Duration{at_ns}}),
       FollowTwist{{*vx_mps, *wz_radps, aside_mps}, flag_member(request, "after_motion")});
}

/// What drover-ros2 made of a message: its values as AimRT's JSON, by the reader of the broker's.
aimrt::JointCommands::Heard Ros2Outlet::read_joint_command(const json::Node& request,
                                                           Time now) const {
  if (const auto why = text_member(request, "refused"); !why.empty())
    return JointTargetsRefused{Reason(json::shown(why, kMostText))};
  if (now - since_ < inputs_.joint_commands->just_came())
    return JointTargetsRefused{Reason(kJustCameWords), true};
  const auto writer = text_member(request, "writer");
  const Time came{Duration{count_of(request, "at_ns")}};
  if (writer.empty() || came <= Time{})
    return JointTargetsRefused{"its writer or at_ns is missing"};
  if (now - came > inputs_.joint_commands->max_age()) {
    Reason late;
    late.format("it waited for %.0f ms on this computer, %.0f ms are allowed",
                1e3 * to_s(now - came), 1e3 * to_s(inputs_.joint_commands->max_age()));
    return JointTargetsRefused{late};
  }
  auto message = aimrt::decode_joint_command_json(text_member(request, "message"));
  if (!message) return JointTargetsRefused{message.error()};
  aimrt::JointCommandHeard heard{*message, {}};
  heard.writer.stamp_ns = heard.message.stamp_ns;
  heard.writer.guid = writer;
  return heard;
}

void Ros2Outlet::joint_command(ClientId client, const json::Node& request, Time now, Actions& out) {
  const auto refuse = refuser(client, out);
  if (inputs_.joint_commands == nullptr)
    return refuse("joint_command is not opened: ros2.inputs.joint_command");
  if (!hands_on(client, now)) return refuse("only drover-ros2 hands joint commands on");
  inputs_.joint_commands->take(
      RequestId::Source::ros2, [&] { return read_joint_command(request, now); }, now,
      now.time_since_epoch() + wall_minus_monotonic_, out);
}

/// A message of MQTT's form, or why drover-ros2 could not make one. Answered as SceneTopics does.
void Ros2Outlet::scene_message(ClientId client, const json::Node& request, Time now, Actions& out) {
  const auto refuse = refuser(client, out);
  const auto topic = text_member(request, "topic");
  const bool is_object = topic == kTopicCollisionObject;
  if (!is_object && topic != kTopicPlanningConstraints)
    return refuse("topic is neither collision_object nor planning_constraints");
  if (inputs_.scene == nullptr ||
      !(is_object ? inputs_.collision_object : inputs_.planning_constraints))
    return refuse(topic + " is not opened: ros2.inputs." + topic);
  if (!hands_on(client, now)) return refuse("only drover-ros2 hands the scene on");
  const Time said = std::min(now, Time{Duration{count_of(request, "at_ns")}});
  if (said <= Time{}) return refuse("at_ns is missing");
  SceneSender sender{client, said};
  if (auto why = text_member(request, "refused"); !why.empty()) {
    (void)inputs_.scene->on_refused(topic, json::shown(text_member(request, "name"), kMostText),
                                    {text_member(request, "path"), std::move(why)}, now, out,
                                    sender);
    return;
  }
  Arrival arrival{Retain::no, {}, now.time_since_epoch() + wall_minus_monotonic_};
  std::string late;
  if (now - said > kOldestScene) {
    sender.said = now;  // its stamp is judged by when it came
    late = "it was said " + std::to_string((now - said) / std::chrono::milliseconds(1)) + " ms ago";
    arrival.late = late;
  }
  const auto message = text_member(request, "message");
  if (message.empty()) return refuse("message is missing");
  (void)inputs_.scene->on_message(topic, message, arrival, now, out, sender);
}

void Ros2Outlet::count(DaemonStatus& status) const {
  status.ros2.configured = true;
  status.ros2.connected = follows(status.now);
  if (!status.ros2.connected) return;
  status.ros2.mode = mode_;
  status.ros2.network = network_;
  status.ros2.unused = unused_;
  status.ros2.reason = reason_;
  status.ros2.readers = readers_;
  status.ros2.incompatible = incompatible_;
}

}  // namespace drover::publish
