// What the player does itself: the mission's steps, each with its action.
#include <csignal>
#include <stdexcept>

#include "sim/robot/control_socket.h"
#include "sim/scenario/player.h"

namespace drover::sim {

void Player::take_steps(Time t) {
  nlohmann::json truth;
  if (story_.asks_for_truth(t)) {
    try {
      truth = nlohmann::json::parse(ask(workplace_.sim_socket(), "truth"), nullptr, false);
    } catch (const std::runtime_error&) {
      // The simulator is not there: the condition does not hold.
    }
  }
  for (const auto* step : story_.take_due(t, truth)) {
    for (const auto& action : step->actions) act(action, t);
    if (!step->name.empty()) happened(step->name);
  }
}

void Player::command_joints(Time t) {
  if (const auto message = commands_.due(t)) client_->publish(commands_.topic(), *message, false);
  if (commands_.ends(t)) happened("commands_end");
}

void Player::act(const Action& action, Time now) {
  using Kind = Action::Kind;
  switch (action.kind) {
    case Kind::sim: return tell_simulator(action.text);
    case Kind::kill:
      if (action.signal == SIGKILL || action.signal == SIGTERM) killed_.insert(action.text);
      tell("signal " + std::to_string(action.signal) + " to " + action.text);
      if (!children_.signal(action.text, action.signal)) broken_ = action.text + " does not run";
      return;
    case Kind::freeze:
      tell("freeze " + action.thread + " of " + action.text);
      frozen_.reset();  // one at a time
      frozen_ = children_.hold(action.text, action.thread);
      if (!frozen_) broken_ = action.text + ": its thread " + action.thread + " cannot be held";
      return;
    case Kind::thaw:
      tell("thaw " + action.text);
      frozen_.reset();
      return;
    case Kind::start: return start(action.text);
    case Kind::publish:
      if (action.in_sim_frame || action.stamped_s_ago) return publish_to_scene(action);
      return publish(action.topic, action.text, action.retain);
    case Kind::cancel:
      return publish("mqtt_control", R"({"cmd_type":"task_control","cmd":"cancel_task"})");
    case Kind::save: return save_track();
    case Kind::start_task: return start_task(action);
    case Kind::cli: return start("drover", action.words);
    case Kind::joint_commands:
      tell("joint commands for " + std::to_string(to_s(action.stream.lasts)) + " s");
      return commands_.begin(action.stream, now);
    case Kind::object: return act_on_object(action.object, now);
    case Kind::zone: return act_on_zone(action.zone);
  }
}

void Player::tell_simulator(const std::string& command) {
  tell("sim " + command);
  view_.on_sim_command(command);
  if (const auto answer = ask(workplace_.sim_socket(), command); answer != "ok")
    broken_ = "sim " + command + ": " + answer;
}

void Player::publish(const std::string& topic, const std::string& payload, bool retain) {
  const bool sent = client_->publish(topic, payload, retain);
  std::string shown = payload.substr(0, 200);
  tell("publish " + topic + (sent ? " " : " (no broker) ") + shown +
       (shown.size() < payload.size() ? "..." : ""));
}

void Player::save_track() {
  const auto shift = map_shift(report_.fix(), mission_.origin, mission_.antenna);
  publish("mqtt_control", save_message(mission_.track_name, mission_.track, shift, mission_.origin,
                                       mission_.antenna));
}

void Player::start_task(const Action& action) {
  result_.target_id = action.id.value_or(mission_.target_id);
  const nlohmann::ordered_json message{{"cmd_type", "task_control"},
                                       {"cmd", "start_task"},
                                       {"name", mission_.track_name},
                                       {"id", result_.target_id},
                                       {"speed", action.speed_mps.value_or(mission_.speed_mps)}};
  publish("mqtt_control", message.dump());
}

}  // namespace drover::sim
