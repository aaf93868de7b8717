// The messages of `mqtt_control`: strict text in, typed commands or a refusal out.
#include "publish/rtk_navigation/control.h"

#include <algorithm>
#include <array>
#include <optional>

#include "json/located_json.h"
#include "store/point_texts.h"

namespace drover::publish {
namespace {

using json::Node;
using Reason = std::optional<std::string>;

struct Message {
  std::string_view text;
  const Node& root;  ///< of that text
  const ControlLimits& limits;
};
/// Reads one command's members; returns why it cannot.
using Read = Reason (*)(const Message& message, ControlCommand& out);

std::string quoted(std::string_view text) {
  return "'" + json::shown(text, 40) + "'";
}

/// Of any name, also one that is looked up. Control characters would forge lines in logs and
/// listings.
Reason name_problem(const std::string& name, const ControlLimits& limits) {
  const auto is_control = [](char c) {
    return static_cast<unsigned char>(c) < 0x20 || static_cast<unsigned char>(c) == 0x7F;
  };
  if (std::any_of(name.begin(), name.end(), is_control)) {
    return "the name contains a control character";
  }
  if (name.size() > limits.max_name_bytes) {
    return "the name is longer than " + std::to_string(limits.max_name_bytes) + " bytes";
  }
  return std::nullopt;
}

Reason read_text(const Node& object, std::string_view key, std::string& out) {
  const Node* node = object.find(key);
  if (node == nullptr) return quoted(key) + " is missing";
  if (node->text() == nullptr) {
    return quoted(key) + " must be a text, not " + std::string(node->kind());
  }
  out = *node->text();
  return std::nullopt;
}

Reason read_number(const Node& object, std::string_view key, double& out) {
  const Node* node = object.find(key);
  if (node == nullptr) return quoted(key) + " is missing";
  const auto number = node->number();
  if (!number) return quoted(key) + " must be a number, not " + std::string(node->kind());
  out = *number;
  return std::nullopt;
}

/// A character that shows as another line or turns the text around it: C1 controls, U+2028 and
/// U+2029, and the marks of bidirectional text (U+061C, U+200E, U+200F, U+202A to U+202E, U+2066 to
/// U+2069). `name` is UTF-8.
bool has_invisible_mark(std::string_view name) {
  const auto byte = [&](std::size_t i) {
    return i < name.size() ? static_cast<unsigned char>(name[i]) : 0U;
  };
  for (std::size_t i = 0; i < name.size(); ++i) {
    const unsigned a = byte(i);
    const unsigned b = byte(i + 1);
    const unsigned c = byte(i + 2);
    if (a == 0xC2 && b >= 0x80 && b <= 0x9F) return true;
    if (a == 0xD8 && b == 0x9C) return true;
    if (a != 0xE2) continue;
    const bool general = b == 0x80 && (c == 0x8E || c == 0x8F || (c >= 0xA8 && c <= 0xAE));
    const bool isolate = b == 0x81 && c >= 0xA6 && c <= 0xA9;
    if (general || isolate) return true;
  }
  return false;
}

/// Of a new name. One that was stored before this rule can still be driven and deleted.
Reason new_name_problem(const std::string& name) {
  if (name.empty()) return "the name is empty";
  if (has_invisible_mark(name)) return "the name contains an invisible control character";
  return std::nullopt;
}

Reason read_name(const Node& object, const ControlLimits& limits, std::string& out) {
  if (auto reason = read_text(object, "name", out)) return reason;
  return name_problem(out, limits);
}

/// Appends it to the track, its numbers as they are spelled in `text`.
Reason read_point(const Node& node, std::string_view text, store::Track& track) {
  constexpr std::array kKeys = {"longitude", "latitude", "angle", "x", "y", "yaw", "z"};
  if (node.object() == nullptr) return "is no object but " + std::string(node.kind());
  std::array<double, store::kNumbersPerPoint> values{};
  store::PointText spelled;
  spelled.fill("0");
  for (std::size_t i = 0; i < kKeys.size(); ++i) {
    // save_trajectory has no z, trajectory_data has: a track that was read may be saved again.
    const Node* number = node.find(kKeys[i]);
    if (number == nullptr && i == store::kZ) continue;
    if (auto reason = read_number(node, kKeys[i], values[i])) return reason;
    spelled[i] = number->spelling(text);
  }
  const auto [longitude_deg, latitude_deg, angle_deg, x_m, y_m, yaw_rad, z_m] = values;
  track.points.push_back({longitude_deg, latitude_deg, angle_deg, x_m, y_m, yaw_rad, z_m});
  store::append_point(track.numbers, spelled);
  return std::nullopt;
}

Reason read_save(const Message& message, ControlCommand& out) {
  const Node* data = message.root.find("data");
  if (data == nullptr || data->object() == nullptr) return "'data' must be an object";
  SaveTrajectory save;
  store::Track& track = save.track;
  if (auto reason = read_name(*data, message.limits, track.name)) return reason;
  if (auto reason = new_name_problem(track.name)) return reason;
  const Node* points = data->find("data");
  if (points == nullptr || points->list() == nullptr) return "'data.data' must be a list of points";
  if (points->list()->size() > store::kMaxPointsPerTrack) {
    return "a track has at most " + std::to_string(store::kMaxPointsPerTrack) + " points";
  }
  track.points.reserve(points->list()->size());
  for (const Node& point : *points->list()) {
    if (auto reason = read_point(point, message.text, track)) {
      return "point " + std::to_string(track.points.size() + 1) + ": " + *reason;
    }
  }
  track.numbers.shrink_to_fit();
  out = std::move(save);
  return std::nullopt;
}

Reason read_delete(const Message& message, ControlCommand& out) {
  DeleteTrajectory request;
  auto reason = read_name(message.root, message.limits, request.name);
  out = std::move(request);
  return reason;
}

/// Seconds since 1970, or milliseconds as Date.now() gives them: no time is both.
Reason read_time(const Node& root, std::optional<Duration>& out) {
  constexpr double kLeast_ms = 1e11;  // 1973; in seconds the year 5138
  constexpr double kMost_ms = 9e12;   // what a Duration holds
  if (root.find("time") == nullptr) return std::nullopt;
  double time = 0;
  if (auto reason = read_number(root, "time", time)) return reason;
  if (!(time > 0 && time < kMost_ms)) return "'time' must be seconds or milliseconds since 1970";
  out = time < kLeast_ms ? from_s(std::min(time, kMost_ms * 1e-3)) : from_s(time * 1e-3);
  return std::nullopt;
}

Reason read_start(const Message& message, ControlCommand& out) {
  const Node& root = message.root;
  StartTaskRequest request;
  if (auto reason = read_name(root, message.limits, request.name)) return reason;
  const Node* id = root.find("id");
  if (id == nullptr) return "'id' is missing";
  if (!id->integer()) return "'id' must be an integer, not " + std::string(id->kind());
  request.id = *id->integer();
  if (auto reason = read_number(root, "speed", request.speed_mps)) return reason;
  if (auto reason = read_time(root, request.time)) return reason;
  out = std::move(request);
  return std::nullopt;
}

template <class Body>
Reason read_nothing(const Message&, ControlCommand& out) {
  out = Body{};
  return std::nullopt;
}

struct Row {
  std::string_view cmd_type;
  std::string_view cmd;
  Read read;
  bool stops = false;
};

constexpr std::array kRows = {
    Row{"trajectory_control", "get_all_trajectory", read_nothing<GetAllTrajectory>},
    Row{"trajectory_control", "save_trajectory", read_save},
    Row{"trajectory_control", "delete_trajectory", read_delete},
    Row{"trajectory_control", "delete_all_trajectory", read_nothing<DeleteAllTrajectory>},
    Row{"task_control", "start_task", read_start},
    Row{"task_control", "cancel_task", read_nothing<CancelTaskRequest>, true},
    Row{"task_control", "init_rtk_data", read_nothing<InitRtkData>},
    Row{"manual_control", "terminate", read_nothing<TerminateRequest>, true},
};

const Row* find_row(std::string_view cmd) {
  const auto* row =
      std::find_if(kRows.begin(), kRows.end(), [&](const Row& r) { return r.cmd == cmd; });
  return row == kRows.end() ? nullptr : row;
}

/// The first `"cmd": "..."` of the outermost object, of a text that is no JSON as a whole: only to
/// tell whose refusal it is. Empty when there is none before the error shows.
std::string_view told_cmd(std::string_view text) {
  int depth = 0;
  bool is_cmd = false;  // the last text was the key `cmd`, and nothing but a colon came since
  for (std::size_t i = 0; i < text.size(); ++i) {
    const char c = text[i];
    if (c == '{' || c == '[') ++depth;
    if (c == '}' || c == ']') --depth;
    if (c == '/') {  // a comment may quote a command
      const bool line = text.substr(i, 2) == "//";
      if (!line && text.substr(i, 2) != "/*") continue;
      const auto end = text.find(line ? "\n" : "*/", i + 2);
      if (end == text.npos) return {};
      i = line ? end : end + 1;
      continue;
    }
    if (c != '"') {
      is_cmd = is_cmd && (c == ':' || c == ' ' || c == '\t' || c == '\n' || c == '\r');
      continue;
    }
    const auto begin = i + 1;
    for (i = begin; i < text.size() && text[i] != '"'; ++i) i += text[i] == '\\' ? 1 : 0;
    if (i >= text.size()) return {};
    const auto word = text.substr(begin, i - begin);
    if (is_cmd) return word;
    is_cmd = depth == 1 && word == "cmd";
  }
  return {};
}

/// A key that makes a JavaScript client change its own objects: nobody sends it in good faith.
bool carries_prototype(const Node& root) {
  const Node* data = root.find("data");
  return root.find("__proto__") != nullptr ||
         (data != nullptr && data->find("__proto__") != nullptr);
}

}  // namespace

std::string failure_cmd(std::string_view cmd) {
  const auto plain = [](char c) {
    return (c >= 'a' && c <= 'z') || (c >= '0' && c <= '9') || c == '_';
  };
  // A client that looks for "_success" in an answer must not find what somebody else sent.
  const bool usable = !cmd.empty() && cmd.size() <= 40 && cmd.find("success") == cmd.npos &&
                      std::all_of(cmd.begin(), cmd.end(), plain);
  return std::string(usable ? cmd : "unknown") + "_failse";
}

Result<ControlCommand, ControlRefusal> parse_control(std::string_view payload, Retain retain,
                                                     const ControlLimits& limits) {
  // Some platforms' writers begin each text with one: a stop of theirs is a stop.
  constexpr std::string_view kByteOrderMark = "\xEF\xBB\xBF";
  if (payload.starts_with(kByteOrderMark) && may_stop(payload))
    payload.remove_prefix(kByteOrderMark.size());
  const auto parsed = json::parse(payload, {limits.max_bytes, limits.max_depth, limits.max_values});
  if (!parsed.ok()) {
    const Row* told = find_row(told_cmd(payload));
    return ControlRefusal{failure_cmd(told == nullptr ? "" : told->cmd), parsed.error().text()};
  }
  const Node& root = parsed->root;
  if (root.object() == nullptr) {
    return ControlRefusal{failure_cmd(""),
                          "a command is an object, not " + std::string(root.kind())};
  }
  std::string cmd;
  std::string cmd_type;
  Reason reason = read_text(root, "cmd", cmd);
  const auto refuse = [&](std::string why) {
    return ControlRefusal{failure_cmd(cmd), std::move(why)};
  };
  if (!reason) reason = read_text(root, "cmd_type", cmd_type);
  if (reason) return refuse(*reason);
  const Row* row = find_row(cmd);
  if (row == nullptr) return refuse("there is no command " + quoted(cmd));
  if (row->cmd_type != cmd_type) {
    return refuse("the cmd_type of " + std::string(cmd) + " is " + std::string(row->cmd_type) +
                  ", not " + quoted(cmd_type));
  }
  if (retain == Retain::stored || (retain == Retain::asked && !row->stops))
    return refuse("the message was retained by the broker: publish without retain");
  if (carries_prototype(root)) return refuse("a member named __proto__ is not accepted");
  ControlCommand command;
  if ((reason = row->read({payload, root, limits}, command))) return refuse(*reason);
  return command;
}

bool is_stop(const ControlCommand& command) {
  return std::holds_alternative<CancelTaskRequest>(command) ||
         std::holds_alternative<TerminateRequest>(command);
}

bool is_stop(const Result<ControlCommand, ControlRefusal>& request) {
  return request.ok() && is_stop(*request);
}

bool may_stop(std::string_view payload) {
  // A letter may be written as an escape; then only the parser knows.
  if (payload.find('\\') != std::string_view::npos) return true;
  return std::any_of(kRows.begin(), kRows.end(), [&](const Row& row) {
    return row.stops && payload.find(row.cmd) != std::string_view::npos;
  });
}

}  // namespace drover::publish
