// The messages of `mqtt_control`: strict text in, typed commands or a refusal out.
#include "publish/rtk_navigation/control.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>

#include "json/located_json.h"
#include "publish/rtk_navigation/told_command.h"
#include "publish/rtk_navigation/track_name.h"
#include "store/point_texts.h"
#include "text/letters.h"
#include "text/trimmed.h"

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

Reason read_name(const Node& object, const ControlLimits& limits, std::string& out) {
  if (auto reason = read_text(object, "name", out)) return reason;
  return name_problem(out, limits.max_name_bytes);
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
  // A recorder that heard no position must not take the place of a track that was driven yesterday.
  if (points->list()->empty()) {
    return "'data.data' has no points, nothing is saved (delete_trajectory takes a track away)";
  }
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

/// Programs that know no integers send 2.0.
Reason read_id(const Message& message, std::int64_t& out) {
  constexpr double kMost = 1e15;  // a double tells all integers up to here apart
  const Node* id = message.root.find("id");
  if (id == nullptr) return "'id' is missing";
  const double number = id->number().value_or(0.5);
  if (id->integer()) {
    out = *id->integer();
  } else if (std::abs(number) <= kMost && std::trunc(number) == number) {
    out = static_cast<std::int64_t>(number);
  } else {
    return std::string(std::trunc(number) == number ? "'id' must be an integer of 64 bits, not "
                                                    : "'id' must be an integer, not ") +
           (id->number() ? json::shown(id->spelling(message.text), 40) : std::string(id->kind()));
  }
  return std::nullopt;
}

Reason read_start(const Message& message, ControlCommand& out) {
  const Node& root = message.root;
  StartTaskRequest request;
  if (auto reason = read_name(root, message.limits, request.name)) return reason;
  if (auto reason = read_id(message, request.id)) return reason;
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

/// Who writes a stop with a capital or a blank too many means it all the same.
const Row* find_stop(std::string_view cmd) {
  const auto row = std::find_if(kRows.begin(), kRows.end(), [&](const Row& r) {
    return r.stops && text::equal_but_for_case(r.cmd, text::trimmed(cmd));
  });
  return row == kRows.end() ? nullptr : &*row;
}

/// A text that is nothing but a word, in quotes or not.
std::string_view lone_word(std::string_view text) {
  constexpr std::string_view kAround = " \t\r\n\"'";
  const auto first = text.find_first_not_of(kAround);
  if (first == text.npos) return {};
  return text.substr(first, text.find_last_not_of(kAround) - first + 1);
}

/// A text in UTF-16 as far as it is ASCII; any other without its NUL characters.
std::string without_nuls(std::string_view text) {
  for (const std::string_view mark : {"\xFF\xFE", "\xFE\xFF"})
    if (text.starts_with(mark)) text.remove_prefix(mark.size());
  std::string narrow(text);
  std::erase(narrow, '\0');
  return narrow;
}

bool has_nuls(std::string_view text) {
  return text.find('\0') != text.npos;
}

/// The stop that is told, however badly: nobody writes one by mistake, and who stops a robot must
/// not be asked for commas.
const Row* told_stop(std::string_view text) {
  if (has_nuls(text)) return told_stop(without_nuls(text));
  if (const Row* row = find_stop(lone_word(text))) return row;
  ToldCommands told(text);
  for (auto cmd = told.next(); !cmd.empty(); cmd = told.next()) {
    if (const Row* row = find_stop(cmd)) return row;
  }
  return nullptr;
}

/// A key that makes a JavaScript client change its own objects: nobody sends it in good faith.
bool carries_prototype(const Node& root) {
  const Node* data = root.find("data");
  return root.find("__proto__") != nullptr ||
         (data != nullptr && data->find("__proto__") != nullptr);
}

/// Of what stands around a command's own members. `row`: that of `cmd`, nullptr when it is unknown.
Reason address_problem(const Node& root, const std::string& cmd, const Row* row) {
  std::string cmd_type;
  if (auto reason = read_text(root, "cmd_type", cmd_type)) return reason;
  if (row == nullptr) return "there is no command " + quoted(cmd);
  if (row->cmd_type != cmd_type) {
    return "the cmd_type of " + cmd + " is " + std::string(row->cmd_type) + ", not " +
           quoted(cmd_type);
  }
  if (carries_prototype(root)) return "a member named __proto__ is not accepted";
  return std::nullopt;
}

constexpr const char* kRetained = "the message was retained by the broker: publish without retain";

ControlCommand as_stop(const Row& row, const std::string& problem) {
  std::string note = "obeyed, though the message is wrong: " + problem;
  if (row.cmd == "terminate") return TerminateRequest{std::move(note)};
  return CancelTaskRequest{std::move(note)};
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
  payload = text::without_end_of_string(payload);
  // Some platforms' writers begin each text with one: a stop of theirs is a stop.
  constexpr std::string_view kByteOrderMark = "\xEF\xBB\xBF";
  if (payload.starts_with(kByteOrderMark) && may_stop(payload))
    payload.remove_prefix(kByteOrderMark.size());
  const auto refuse = [](std::string_view cmd, std::string why) {
    return ControlRefusal{failure_cmd(cmd), std::move(why)};
  };
  const auto refuse_form = [&](std::string_view cmd,
                               const std::string& why) -> Result<ControlCommand, ControlRefusal> {
    const Row* row = told_stop(payload);
    if (row == nullptr) return refuse(cmd, why);
    if (retain == Retain::stored) return refuse(row->cmd, kRetained);
    return as_stop(*row, why);
  };
  const auto parsed = json::parse(payload, {.max_bytes = limits.max_bytes,
                                            .max_depth = limits.max_depth,
                                            .max_values = limits.max_values,
                                            .long_integers = true});
  if (!parsed.ok()) {
    const Row* told = find_row(ToldCommands(payload).next());
    return refuse_form(told == nullptr ? "" : told->cmd, parsed.error().text());
  }
  const Node& root = parsed->root;
  if (root.object() == nullptr)
    return refuse_form("", "a command is an object, not " + std::string(root.kind()));
  std::string cmd;
  if (auto reason = read_text(root, "cmd", cmd)) return refuse_form(cmd, *reason);
  const Row* row = find_row(cmd);
  if (row == nullptr && find_stop(cmd) != nullptr)
    return refuse_form(cmd, "there is no command " + quoted(cmd));
  const bool stops = row != nullptr && row->stops;
  if (stops && retain == Retain::stored) return refuse(cmd, kRetained);
  if (auto reason = address_problem(root, cmd, row)) {
    if (stops) return as_stop(*row, *reason);
    return refuse(cmd, *reason);
  }
  if (retain != Retain::no && !stops) return refuse(cmd, kRetained);
  ControlCommand command;
  if (auto reason = row->read({payload, root, limits}, command)) return refuse(cmd, *reason);
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
  if (has_nuls(payload)) return may_stop(without_nuls(payload));
  return std::any_of(kRows.begin(), kRows.end(), [&](const Row& row) {
    return row.stops && text::contains_but_for_case(payload, row.cmd);
  });
}

}  // namespace drover::publish
