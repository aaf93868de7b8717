#include "sim/scenario/mission.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <stdexcept>
#include <string_view>

#include "drover/angle.h"
#include "sim/robot/json_reader.h"
#include "text/suggestion.h"

namespace drover::sim {
namespace {

using nlohmann::json;

/// What the player tells of, beside a mission's own steps and the ends of programs; see mission.h.
constexpr std::array<std::string_view, 20> kEvents{
    "boot",         "ready",         "locate_false",     "saved",          "save_failed",
    "start_task",   "start_nav",     "start_nav_failed", "nav_success",    "nav_error",
    "obstacle",     "obstacle_gone", "cancelled",        "broker_lost",    "broker_back",
    "commands_end", "scene_done",    "scene_refused",    "object_arrived", "start_task_failed"};
constexpr std::array<std::string_view, 9> kTruthValues{
    "x_m", "y_m", "z_m", "roll_rad", "pitch_rad", "yaw_rad", "vx_mps", "wz_radps", "free_ahead_m"};

Condition read_condition(JsonReader reader) {
  const auto keys = reader.keys();
  if (keys.size() != 1) reader.fail("", "must have one member, such as x_m_above");
  for (const auto value : kTruthValues)
    for (const bool above : {true, false})
      if (keys[0] == std::string(value) + (above ? "_above" : "_below"))
        return {std::string(value), above, reader.number(keys[0])};
  reader.fail(keys[0], "is no value of the truth with _above or _below");
}

Step read_step(JsonReader& reader, const json& raw) {
  Step step;
  step.name = reader.text("name", "");
  step.after = parse_event_name(reader.text("after", "boot"));
  const double delay_s = reader.number("delay_s", 0);
  if (!(delay_s >= 0 && delay_s <= 1e6)) reader.fail("delay_s", "must be from 0 to 1000000");
  step.delay = from_s(delay_s);
  if (reader.has("when")) step.when = read_condition(reader.object("when"));
  const auto& what = raw.at("do");
  if (what.is_array()) {
    auto items = reader.list("do");
    for (std::size_t i = 0; i < items.size(); ++i)
      step.actions.push_back(read_action(items[i], what[i]));
  } else {
    auto item = reader.object("do");
    step.actions.push_back(read_action(item, what));
  }
  reader.done();
  return step;
}

Shape read_shape(JsonReader& reader) {
  Shape shape;
  if (!reader.has("straight_m") && !reader.has("turn_deg"))
    reader.fail("", "must have straight_m, or turn_deg and radius_m");
  if (reader.has("straight_m")) {
    shape.straight_m = reader.number("straight_m");
    if (!(shape.straight_m > 0)) reader.fail("straight_m", "must be above 0");
  } else {
    shape.turn_rad = to_rad(reader.number("turn_deg"));
    shape.radius_m = reader.number("radius_m");
    if (!(shape.radius_m >= 0)) reader.fail("radius_m", "must not be below 0");
  }
  shape.backwards = reader.flag("backwards", false);
  reader.done();
  return shape;
}

TrackPose read_start(JsonReader& top) {
  if (!top.has("start")) return {};
  auto start = top.object("start");
  return {start.number("x_m", 0), start.number("y_m", 0), to_rad(start.number("yaw_deg", 0))};
}

void read_places(JsonReader& top, Mission& mission) {
  auto origin = top.object("origin");
  mission.origin = {origin.number("latitude_deg"), origin.number("longitude_deg"),
                    origin.number("altitude_m", 0)};
  if (top.has("gnss")) {
    auto gnss = top.object("gnss");
    if (gnss.has("antenna")) {
      auto antenna = gnss.object("antenna");
      mission.antenna = {antenna.number("x_m", 0), antenna.number("y_m", 0)};
    }
  }
  // Where the gateway is told of another place, its tracks and its origin are made with that one.
  if (!top.has("gateway")) return;
  auto gateway = top.object("gateway");
  if (!gateway.has("estimate")) return;
  auto told = gateway.object("estimate");
  mission.antenna.x_m = told.number("antenna_x_m", mission.antenna.x_m);
  mission.antenna.y_m = told.number("antenna_y_m", mission.antenna.y_m);
}

/// What may be followed: a misspelt event would never happen, and its step never be played.
std::vector<std::string> followable(const std::vector<Step>& steps) {
  std::vector<std::string> names(kEvents.begin(), kEvents.end());
  names.emplace_back("exit_drover");
  for (const auto program : kPrograms) names.push_back("exit_" + std::string(program));
  for (const auto& step : steps)
    if (!step.name.empty()) names.push_back(step.name);
  return names;
}

void check_event(const JsonReader& reader, const EventName& event,
                 const std::vector<std::string>& known) {
  if (std::find(known.begin(), known.end(), event.name) != known.end()) return;
  const auto meant = text::did_you_mean(event.name, known);
  reader.fail("after", "there is no event and no step of the name \"" + event.name + "\"" +
                           (meant.empty() ? "" : " (" + meant + ")"));
}

void read_end(JsonReader& reader, Mission& mission) {
  if (!reader.has("end")) return;
  auto end = reader.object("end");
  mission.end_after = parse_event_name(end.text("after"));
  check_event(end, *mission.end_after, followable(mission.steps));
  mission.end_delay = from_s(end.number("delay_s", 1));
  end.done();
}

}  // namespace

EventName parse_event_name(const std::string& text) {
  const auto mark = text.find('#');
  EventName event{text.substr(0, mark), 1};
  if (mark == std::string::npos) return event;
  const auto* end = text.data() + text.size();
  const auto [at, error] = std::from_chars(text.data() + mark + 1, end, event.count);
  if (error != std::errc{} || at != end || event.count == 0 || event.name.empty())
    throw std::runtime_error("'" + text + "' is no event: say NAME or NAME#2");
  return event;
}

Mission read_mission(const json& document) {
  JsonReader top(document, "");
  Mission mission;
  mission.name = top.text("name", "");
  read_places(top, mission);
  auto reader = top.object("mission");
  std::vector<Shape> shapes;
  for (auto& item : reader.list("track")) shapes.push_back(read_shape(item));
  mission.track = make_track(read_start(top), shapes);
  mission.track_name = reader.text("track_name", mission.name);
  mission.target_id = reader.has("target_id") ? read_id(reader, "target_id") : mission.track.size();
  mission.speed_mps = reader.number("speed_mps", mission.speed_mps);
  mission.automatic = reader.flag("automatic", true);
  if (reader.has("steps")) {
    const auto& raw = document.at("mission").at("steps");
    auto items = reader.list("steps");
    for (std::size_t i = 0; i < items.size(); ++i)
      mission.steps.push_back(read_step(items[i], raw[i]));
    const auto known = followable(mission.steps);
    for (std::size_t i = 0; i < items.size(); ++i)
      check_event(items[i], mission.steps[i].after, known);
  }
  read_end(reader, mission);
  mission.timeout = from_s(reader.number("timeout_s", to_s(mission.timeout)));
  mission.expect_status = reader.text("expect_status", mission.expect_status);
  reader.done();
  return mission;
}

void set_member(json& document, const std::string& assignment) {
  const auto equals = assignment.find('=');
  if (equals == 0 || equals == std::string::npos)
    throw std::runtime_error("--set " + assignment + ": say KEY.KEY=VALUE");
  std::string pointer = "/" + assignment.substr(0, equals);
  for (auto& c : pointer)
    if (c == '.') c = '/';
  const auto text = assignment.substr(equals + 1);
  auto value = json::parse(text, nullptr, false);
  try {
    document[json::json_pointer(pointer)] = value.is_discarded() ? json(text) : std::move(value);
  } catch (const json::exception& error) {
    throw std::runtime_error("--set " + assignment + ": " + error.what());
  }
}

}  // namespace drover::sim
