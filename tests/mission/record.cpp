// Reading is strict: a log that is missing, empty or cut short is an error, never less to check.
#include "mission/record.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <fstream>
#include <functional>
#include <map>
#include <stdexcept>

#include "mission/robot.h"
#include "mission/wire_cia402.h"
#include "mission/wire_robomaster.h"
#include "mission/wire_twist.h"
#include "mission/wire_zlac8015d.h"

namespace drover::mission {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;

void each_line(const fs::path& file, const std::function<void(std::string_view)>& take) {
  std::ifstream stream(file);
  if (!stream) throw std::runtime_error(file.string() + ": is missing");
  std::string line;
  std::size_t number = 0;
  while (std::getline(stream, line)) {
    ++number;
    try {
      if (stream.eof()) throw std::runtime_error("cut short");
      take(line);
    } catch (const std::exception& error) {
      throw std::runtime_error(file.string() + ":" + std::to_string(number) + ": " + error.what());
    }
  }
  if (number == 0) throw std::runtime_error(file.string() + ": is empty");
}

template <typename Line>
void append(std::vector<Line>& lines, Line line) {
  if (!lines.empty() && line.time < lines.back().time) throw std::runtime_error("time goes back");
  lines.push_back(std::move(line));
}

Status read_status(const MqttLine& line, const Earth& earth) {
  Status status;
  status.time = line.time;
  status.document = json::parse(line.payload);
  const auto& nav = status.document.at("nav");
  const auto& pose = status.document.at("pose");
  const auto& rtk = status.document.at("rtk");
  status.nav = nav.at("status").get<std::string>();
  status.locate = nav.at("locate").get<std::string>();
  status.obstacle = nav.at("obstacle").get<bool>();
  for (const auto& reason : nav.value("why", json::array()))
    status.why += (status.why.empty() ? "" : "; ") + reason.get<std::string>();
  status.placed = rtk.at("latitude") != 0 || rtk.at("longitude") != 0;
  status.map = {pose.at("x").get<double>(), pose.at("y").get<double>()};
  status.sim = earth.base(rtk.at("latitude").get<double>(), rtk.at("longitude").get<double>(),
                          pose.at("yaw").get<double>());
  return status;
}

void read_control(const std::string& payload, const Earth& earth, Record& record) {
  const auto message = json::parse(payload, nullptr, false);
  if (!message.is_object()) return;  // a scenario may send nonsense
  const auto cmd = message.value("cmd", "");
  if (cmd == "save_trajectory") record.track = read_track(message, earth);
  if (cmd == "start_task") record.target_id = message.at("id").get<std::size_t>();
}

void read_mqtt(MqttLine line, const Earth& earth, Record& record) {
  if (line.topic == "base_status") record.statuses.push_back(read_status(line, earth));
  if (line.topic == "feedback") {
    const auto message = json::parse(line.payload);
    record.feedback.push_back(
        {line.time, message.at("cmd").get<std::string>(), message.value("reason", "")});
  }
  if (line.topic == "mqtt_control") read_control(line.payload, earth, record);
  if (line.topic == kJointCommandTopic || line.topic == kJointCommandArrayTopic)
    record.joint_commands.push_back(parse_joint_command(line.time, line.payload));
  append(record.mqtt, std::move(line));
}

json read_json(const fs::path& file) {
  std::ifstream stream(file);
  if (!stream) throw std::runtime_error(file.string() + ": is missing");
  return json::parse(stream, nullptr, true, true);
}

[[noreturn]] void missing(const Record& record, const std::string& what) {
  throw std::runtime_error(record.folder.string() + ": " + what);
}

constexpr std::pair<const char*, Maker> kTwistBases[] = {{"gt01_serial", Maker::gt01_serial},
                                                         {"gt01_can", Maker::gt01_can},
                                                         {"agilex_v2", Maker::agilex_v2},
                                                         {"agilex_hunter", Maker::hunter}};

/// What its drives are like.
void read_drives(const json& scenario, Record& record) {
  constexpr double kTurn = 2 * M_PI;
  record.mps_per_turnps = kTurn * kWheelRadius_m / kGear;
  for (const auto& drive : scenario.value("drives", json::array())) {
    const std::string driver = drive.value("driver", "");
    if (driver == "damiao") record.arm = ArmMaker::damiao;
    if (driver == "cubemars_mit") record.arm = ArmMaker::cubemars_mit;
    if (driver == "zlac8015d") {
      record.maker = Maker::zlac8015d;
      record.mps_per_turnps = kTurn * 0.085;
    }
    if (driver == "cia402") {
      constexpr double kMotorTurns = 25;
      record.maker = Maker::cia402;
      record.mps_per_turnps = kTurn * 0.085 / kMotorTurns;
    }
    if (driver == "robomaster_c620") record.maker = Maker::robomaster;
    const auto* const twist = std::find_if(std::begin(kTwistBases), std::end(kTwistBases),
                                           [&](const auto& base) { return driver == base.first; });
    if (twist != std::end(kTwistBases)) {
      record.maker = twist->second;
      record.mps_per_turnps = 1;
      continue;  // it has no joints
    }
    if (drive.contains("joint")) record.joints.push_back(drive.at("joint"));
    for (const auto& joint : drive.value("joints", json::array())) record.joints.push_back(joint);
  }
}

/// As its two edges.
void add_twist(Time time, const TwistCommand& twist, Record& record) {
  constexpr double kHalfTrack_m = 0.3;
  for (const double side : {-1.0, 1.0}) {
    const double edge_mps = twist.vx_mps + side * kHalfTrack_m * twist.wz_radps;
    const auto node = static_cast<std::uint8_t>(side < 0 ? 1 : 2);
    record.sent.push_back({time, {node, static_cast<float>(edge_mps), 0}});
  }
}

/// Which way they turn it is not asked: they turn the wheel, or they do not.
void add_currents(Time time, const std::array<float, robomaster::kMotors>& drives_A,
                  Record& record) {
  constexpr float kNm_per_A = 0.3F;
  for (std::uint8_t i = 0; i < drives_A.size(); ++i)
    record.sent.push_back({time, {static_cast<std::uint8_t>(i + 1), 0, kNm_per_A * drives_A[i]}});
}

void read_set_points(const CanLine& line, robomaster::Bus& bus, Record& record) {
  if (record.arm != ArmMaker::none && line.bus != "can0") return;  // an arm's
  if (record.maker == Maker::robomaster) {
    if (const auto drives_A = bus.drives_A(line.frame)) add_currents(line.time, *drives_A, record);
    return;
  }
  if (record.maker == Maker::hunter) {
    if (const auto twist = hunter::twist_command(line.frame)) add_twist(line.time, *twist, record);
  } else if (record.maker == Maker::gt01_can || record.maker == Maker::agilex_v2) {
    const auto twist = record.maker == Maker::gt01_can ? gt01::twist_command(line.frame)
                                                       : agilex_v2::twist_command(line.frame);
    if (twist) add_twist(line.time, *twist, record);
  } else if (record.maker == Maker::odrive || record.maker == Maker::cia402) {
    const auto wheel = record.maker == Maker::odrive ? wheel_command(line.frame)
                                                     : cia402::wheel_command(line.frame);
    if (wheel) record.sent.push_back({line.time, *wheel});
  } else if (const auto targets = zlac8015d::targets_turnps(line.frame)) {
    for (std::uint8_t i = 0; i < targets->size(); ++i)
      record.sent.push_back({line.time, {static_cast<std::uint8_t>(i + 1), (*targets)[i], 0}});
  }
}

}  // namespace

Record read_record(const fs::path& folder, const json& scenario) {
  Record record;
  record.folder = folder;
  read_drives(scenario, record);
  record.bumper = scenario.value(json::json_pointer("/lines/bumper"), std::string()) != "unwired";
  const Earth earth(scenario);
  robomaster::Bus bus;
  const auto read_can = [&](std::string_view line) {
    auto parsed = parse_can_line(line);
    read_set_points(parsed, bus, record);
    append(record.can, std::move(parsed));
  };
  if (scenario.contains("can")) each_line(folder / "can.log", read_can);  // it may have no bus
  each_line(folder / "mqtt.log",
            [&](std::string_view line) { read_mqtt(parse_mqtt_line(line), earth, record); });
  each_line(folder / "events.log",
            [&](std::string_view line) { append(record.events, parse_event_line(line)); });
  if (scenario.value("outputs", false))
    each_line(folder / "lines.log",
              [&](std::string_view line) { append(record.levels, parse_level_line(line)); });
  if (record.maker == Maker::gt01_serial)
    for (const gt01::Asked& asked : gt01::read_line(folder).packets)
      add_twist(asked.time, asked.twist, record);
  std::optional<TruthColumns> columns;
  each_line(folder / "truth.csv", [&](std::string_view line) {
    if (columns)
      append(record.truth, columns->parse(line));
    else
      columns.emplace(line);
  });
  if (record.truth.size() < 2) missing(record, "no true motion");
  return record;
}

json read_scenario(const std::string& name) {
  const fs::path file = fs::path(DROVER_SOURCE_DIR) / "sim/scenarios" / (name + ".json");
  auto scenario = read_json(file);
  if (!scenario.contains("robot")) return scenario;
  auto whole = read_json(file.parent_path() / scenario.at("robot").get<std::string>());
  whole.merge_patch(scenario);
  return whole;
}

fs::path logs_folder() {
  const char* folder = std::getenv("DROVER_MISSION_LOGS");
  if (folder == nullptr) throw std::runtime_error("DROVER_MISSION_LOGS is not set");
  return folder;
}

const Record& record(const std::string& name) {
  static std::map<std::string, Record> records;
  const auto at = records.find(name);
  if (at != records.end()) return at->second;
  return records[name] = read_record(logs_folder() / name, read_scenario(name));
}

std::vector<Time> Record::all(const std::string& text) const {
  std::vector<Time> times;
  for (const auto& event : events)
    if (event.text == text) times.push_back(event.time);
  return times;
}

Time Record::event(const std::string& text, std::size_t n) const {
  const auto times = all(text);
  if (times.size() < n) missing(*this, "no event '" + text + "' number " + std::to_string(n));
  return times[n - 1];
}

Time Record::answered(const std::string& cmd, std::size_t n) const {
  for (const auto& one : feedback)
    if (one.cmd == cmd && --n == 0) return one.time;
  missing(*this, "no feedback " + cmd);
}

std::vector<std::string> Record::feedback_words() const {
  std::vector<std::string> words;
  for (const auto& one : feedback) words.push_back(one.cmd);
  return words;
}

std::vector<LevelLine> Record::changes(const std::string& output, Time begin, Time end) const {
  std::vector<LevelLine> found;
  for (const auto& level : levels)
    if (level.name == output && level.time >= begin && level.time <= end) found.push_back(level);
  return found;
}

std::optional<bool> Record::level_at(const std::string& output, Time time) const {
  const auto until = changes(output, kNever, time);
  if (until.empty()) missing(*this, output + " was not seen yet");
  return until.back().high;
}

TruthLine Record::truth_at(Time time) const {
  const auto after = std::upper_bound(truth.begin(), truth.end(), time,
                                      [](Time t, const TruthLine& line) { return t < line.time; });
  if (after == truth.begin() || after == truth.end()) missing(*this, "no true motion then");
  const TruthLine& a = *(after - 1);
  const TruthLine& b = *after;
  const double share = to_s(time - a.time) / to_s(b.time - a.time);
  const auto mix = [share](double from, double to) { return from + share * (to - from); };
  const double turn_rad = std::remainder(b.yaw_rad - a.yaw_rad, 2 * M_PI);
  return {time,
          mix(a.x_m, b.x_m),
          mix(a.y_m, b.y_m),
          mix(a.z_m, b.z_m),
          a.yaw_rad + share * turn_rad,
          mix(a.vx_mps, b.vx_mps),
          mix(a.free_ahead_m, b.free_ahead_m),
          mix(a.wz_radps, b.wz_radps)};
}

std::vector<Sent> Record::moving(Time begin, Time end) const {
  std::vector<Sent> found;
  for (const auto& one : sent)
    if (one.time >= begin && one.time <= end && one.wheel.moves()) found.push_back(one);
  return found;
}

const Status& Record::first_status(const std::string& word, Time begin) const {
  for (const auto& status : statuses)
    if (status.time >= begin && (status.nav == word || status.locate == word)) return status;
  missing(*this, "no status " + word);
}

}  // namespace drover::mission
