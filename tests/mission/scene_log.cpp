#include "mission/scene_log.h"

#include <algorithm>
#include <cmath>
#include <fstream>
#include <map>
#include <stdexcept>

#include "mission/robot.h"

namespace drover::mission {
namespace {

using nlohmann::json;

[[noreturn]] void lacks(const SceneLog& log, const std::string& what) {
  throw std::runtime_error(log.record->folder.string() + ": " + what);
}

void read_answers(const MqttLine& line, SceneLog& log) {
  auto answers = json::parse(line.payload);
  if (!answers.is_array()) answers = json::array({answers});
  for (const auto& answer : answers)
    log.answers.push_back({line.time, answer.at("topic").get<std::string>(),
                           answer.value("id", answer.value("name", "")),
                           answer.at("result").get<std::string>() == "done",
                           answer.value("path", ""), answer.value("reason", "")});
}

void read_objects(SceneLog& log) {
  const auto file = log.record->folder / "objects.log";
  std::ifstream stream(file);
  if (!stream) lacks(log, "objects.log is missing");
  std::size_t number = 0;
  for (std::string line; std::getline(stream, line);) {
    ++number;
    try {
      if (stream.eof()) throw std::runtime_error("cut short");
      log.objects.push_back(parse_object_line(line));
    } catch (const std::exception& error) {
      throw std::runtime_error(file.string() + ":" + std::to_string(number) + ": " + error.what());
    }
  }
  if (log.objects.empty() || log.objects[0].verb != "watching") lacks(log, "nobody watched");
}

}  // namespace

SceneLog read_scene_log(const Record& record) {
  SceneLog log;
  log.record = &record;
  read_objects(log);
  for (const auto& line : record.truth)
    log.poses.push_back({line.time, line.x_m, line.y_m, line.yaw_rad, line.vx_mps, line.wz_radps});
  for (const auto& line : record.mqtt)
    if (line.topic == "scene_feedback") read_answers(line, log);
  return log;
}

const SceneLog& scene_log(const std::string& name) {
  static std::map<std::string, SceneLog> logs;
  const auto at = logs.find(name);
  if (at != logs.end()) return at->second;
  return logs[name] = read_scene_log(record(name));
}

std::vector<ObjectLine> SceneLog::all(const std::string& verb) const {
  std::vector<ObjectLine> found;
  std::copy_if(objects.begin(), objects.end(), std::back_inserter(found),
               [&verb](const ObjectLine& line) { return line.verb == verb; });
  return found;
}

std::optional<Time> first_above_ramp(const Record& record, Time from, Time until) {
  constexpr double kNearlyAll_mps2 = 0.9 * kBrakes_mps2;
  constexpr double kTrace_mps = 0.02;
  constexpr Duration kLate = std::chrono::milliseconds(50);
  double fastest_mps = 0;  // as it was until then; in a curve the outer wheel
  for (const auto& one : record.sent)
    if (one.time > from - kLate && one.time <= from)
      fastest_mps = std::max(fastest_mps, record.rim_mps(one));
  for (const auto& one : record.sent) {
    if (one.time <= from || one.time > until) continue;
    const double ramp_mps = std::max(0.0, fastest_mps - kNearlyAll_mps2 * to_s(one.time - from));
    const bool over = one.time > from + from_s(fastest_mps / kNearlyAll_mps2) + kLate;
    if (over ? one.wheel.moves() : record.rim_mps(one) > ramp_mps + kTrace_mps) return one.time;
  }
  return std::nullopt;
}

Time SceneLog::at(const std::string& verb, const std::string& name, std::size_t n) const {
  for (const auto& line : objects)
    if (line.verb == verb && line.name == name && --n == 0) return line.time;
  lacks(*this, "objects.log has no '" + verb + " " + name + "'");
}

const TruePose& SceneLog::pose_at(Time time) const {
  const auto nearer = [time](const TruePose& a, const TruePose& b) {
    return std::chrono::abs(a.time - time) < std::chrono::abs(b.time - time);
  };
  const auto it = std::min_element(poses.begin(), poses.end(), nearer);
  if (it == poses.end() || std::chrono::abs(it->time - time) > std::chrono::milliseconds(20))
    lacks(*this, "no true pose then");
  return *it;
}

double SceneLog::gap_at(Time time, const std::string& name) const {
  for (const auto& one : gaps_at(pose_at(time), objects))
    if (one.what == name) return one.gap_m;
  lacks(*this, name + " was not there then");
}

const SceneAnswer& SceneLog::answer(const std::string& id, Time begin) const {
  for (const auto& one : answers)
    if (one.id == id && one.time >= begin) return one;
  lacks(*this, "no answer to '" + id + "'");
}

}  // namespace drover::mission
