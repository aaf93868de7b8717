#include "sim/scenario/action.h"

#include <cmath>
#include <csignal>
#include <sstream>

namespace drover::sim {
namespace {

using nlohmann::json;

int parse_signal(JsonReader& reader) {
  const auto text = reader.text("signal", "KILL");
  if (text == "KILL") return SIGKILL;
  if (text == "STOP") return SIGSTOP;
  if (text == "CONT") return SIGCONT;
  if (text == "TERM") return SIGTERM;
  reader.fail("signal", "must be one of KILL, STOP, CONT, TERM");
}

std::string program(JsonReader& reader, std::string_view key) {
  auto name = reader.text(key);
  for (const auto known : kPrograms)
    if (name == known) return name;
  reader.fail(key, "must be one of mosquitto, drover-sim, drover-guard, droverd");
}

/// {"velocities_radps": {"front_left": 1, "rear_left": "nan"}, "rate_Hz": 50, "for_s": 2,
///  "names": "aimrt_1x", "content": "json"}
CommandStreamSpec read_stream(JsonReader reader, const json& raw) {
  CommandStreamSpec stream;
  if (reader.has("velocities_radps")) {
    auto wheels = reader.object("velocities_radps");
    for (const auto& joint : wheels.keys()) {
      const bool text = raw.at("velocities_radps").at(joint).is_string();
      if (text && wheels.text(joint) != "nan") wheels.fail(joint, "must be a number or nan");
      stream.joints.push_back({joint, text ? NAN : wheels.number(joint)});
    }
    wheels.done();
  }
  if (reader.has("joints")) {
    auto joints = reader.object("joints");
    for (const auto& joint : joints.keys()) {
      auto values = joints.object(joint);
      stream.joints.push_back({joint, values.number("velocity_radps", 0),
                               values.number("position_rad", 0), values.number("effort_Nm", 0),
                               values.number("stiffness", 0), values.number("damping", 0)});
      values.done();
    }
    joints.done();
  }
  if (stream.joints.empty()) reader.fail("joints", "or velocities_radps must name a joint");
  stream.rate_Hz = reader.number("rate_Hz", stream.rate_Hz);
  if (!(stream.rate_Hz >= 1 && stream.rate_Hz <= 1000)) reader.fail("rate_Hz", "must be 1 to 1000");
  const double for_s = reader.number("for_s");
  if (!(for_s > 0 && for_s <= 1e6)) reader.fail("for_s", "must be above 0");
  stream.lasts = from_s(for_s);
  const auto names = reader.text("names", "document");
  if (names != "document" && names != "aimrt_1x")
    reader.fail("names", "must be document or aimrt_1x");
  const auto content = reader.text("content", "pb");
  if (content != "pb" && content != "json") reader.fail("content", "must be pb or json");
  stream.form = {names == "aimrt_1x", content == "json"};
  reader.done();
  return stream;
}

/// A list of words and numbers: a number that was drawn can stand there. Of a text its words.
std::vector<std::string> command_words(JsonReader& reader, const json& raw, std::string_view key) {
  const auto& value = raw.at(std::string(key));
  std::vector<std::string> words;
  if (!value.is_array()) {
    std::istringstream text(reader.text(key));
    for (std::string word; text >> word;) words.push_back(word);
    return words;
  }
  reader.ignore(key);
  for (const auto& word : value) {
    if (!word.is_string() && !word.is_number()) reader.fail(key, "must be words and numbers");
    words.push_back(word.is_string() ? word.get<std::string>() : word.dump());
  }
  return words;
}

/// The same in one line; a text as it stands there.
std::string command_text(JsonReader& reader, const json& raw, std::string_view key) {
  if (!raw.at(std::string(key)).is_array()) return reader.text(key);
  std::string text;
  for (const auto& word : command_words(reader, raw, key)) text += (text.empty() ? "" : " ") + word;
  return text;
}

/// "frame": "sim" and "stamped_s_ago": 5, of a message of the planning scene.
void read_frame_and_stamp(JsonReader& reader, const json& message, Action& action) {
  if (reader.has("frame")) {
    if (reader.text("frame") != "sim") reader.fail("frame", "must be sim");
    action.in_sim_frame = true;
  }
  if (reader.has("stamped_s_ago")) action.stamped_s_ago = reader.number("stamped_s_ago");
  if (message.is_string() && (action.in_sim_frame || action.stamped_s_ago))
    reader.fail("publish", "must be an object or a list to be placed or stamped");
}

}  // namespace

std::size_t read_id(JsonReader& reader, std::string_view key) {
  const double id = reader.number(key);
  if (!(id >= 1 && id <= 1e6 && id == std::floor(id))) reader.fail(key, "must be from 1 up");
  return static_cast<std::size_t>(id);
}

std::string shown_words(const std::vector<std::string>& words) {
  std::string text;
  for (const auto& word : words) {
    const bool plain = !word.empty() && word.find_first_of(" \t") == std::string::npos;
    text += (text.empty() ? "" : " ") + (plain ? word : "'" + word + "'");
  }
  return text;
}

Action read_action(JsonReader& reader, const json& raw) {
  Action action;
  using Kind = Action::Kind;
  if (reader.has("sim")) {
    action = {Kind::sim, command_text(reader, raw, "sim")};
  } else if (reader.has("kill")) {
    action.kind = Kind::kill;
    action.text = program(reader, "kill");
    action.signal = parse_signal(reader);
  } else if (reader.has("freeze")) {
    action = {Kind::freeze, program(reader, "freeze")};
    action.thread = reader.text("thread");
  } else if (reader.has("thaw")) {
    action = {Kind::thaw, program(reader, "thaw")};
  } else if (reader.has("start")) {
    action = {Kind::start, program(reader, "start")};
  } else if (reader.has("publish")) {
    const auto& message = raw.at("publish");
    action = {Kind::publish, message.is_string() ? message.get<std::string>() : message.dump()};
    action.topic = reader.text("topic", "mqtt_control");
    action.retain = reader.flag("retain", false);
    read_frame_and_stamp(reader, message, action);
  } else if (reader.has("start_task")) {
    action.kind = Kind::start_task;
    auto task = reader.object("start_task");
    if (task.has("id")) action.id = read_id(task, "id");
    if (task.has("speed_mps")) action.speed_mps = task.number("speed_mps");
    task.done();
  } else if (reader.has("cli")) {
    action.kind = Kind::cli;
    action.words = command_words(reader, raw, "cli");
  } else if (reader.has("joint_commands")) {
    action.kind = Kind::joint_commands;
    action.stream = read_stream(reader.object("joint_commands"), raw.at("joint_commands"));
  } else if (reader.has("object")) {
    action.kind = Kind::object;
    action.object = read_object(reader.object("object"), raw.at("object"));
  } else if (reader.has("zone")) {
    action.kind = Kind::zone;
    action.zone = read_zone(reader.object("zone"), raw.at("zone"));
  } else if (reader.flag("cancel", false)) {
    action.kind = Kind::cancel;
  } else if (reader.flag("save", false)) {
    action.kind = Kind::save;
  } else {
    reader.fail("",
                "must be one of sim, kill, freeze, thaw, start, publish, cancel, save, start_task, "
                "joint_commands, "
                "object, zone, cli");
  }
  reader.done();
  return action;
}

}  // namespace drover::sim
