// base_status and feedback: form, rate, and the agreement of what one message says.
#include <algorithm>
#include <cmath>
#include <set>

#include "mission/conduct.h"

namespace drover::mission {
namespace {

using namespace std::chrono_literals;
using nlohmann::json;

constexpr Duration kBack = 2s;
constexpr Duration kGap = 200ms;
constexpr Duration kPiledUp = 200ms;

enum class Kind { number, integer, boolean, text, texts };

bool is(const json& value, Kind kind) {
  switch (kind) {
    case Kind::number: return value.is_number() && std::isfinite(value.get<double>());
    case Kind::integer: return value.is_number_integer();
    case Kind::boolean: return value.is_boolean();
    case Kind::text: return value.is_string();
    case Kind::texts:
      return value.is_array() && std::all_of(value.begin(), value.end(),
                                             [](const json& one) { return one.is_string(); });
  }
  return false;
}

using Keys = std::vector<std::pair<const char*, Kind>>;

// RTK navigation protocol, "状态反馈 base_status"; bms.valid, robot.valid, nav.owner and nav.why
// are added to it, nav.metres_left while the position is reckoned without an RTK fix, and
// nav.error_bound_m while there is one.
const std::vector<std::pair<const char*, Keys>> kDocument{
    {"bms",
     {{"current", Kind::number},
      {"error", Kind::integer},
      {"remaining_capacity", Kind::number},
      {"soc", Kind::number},
      {"status", Kind::integer},
      {"tem", Kind::number},
      {"voltage", Kind::number},
      {"valid", Kind::boolean}}},
    {"nav",
     {{"locate", Kind::text},
      {"obstacle", Kind::boolean},
      {"status", Kind::text},
      {"owner", Kind::text},
      {"why", Kind::texts}}},
    {"pose", {{"x", Kind::number}, {"y", Kind::number}, {"yaw", Kind::number}}},
    {"robot",
     {{"power", Kind::number},
      {"robot_status", Kind::integer},
      {"vx", Kind::number},
      {"vy", Kind::number},
      {"vz", Kind::number},
      {"valid", Kind::boolean}}},
    {"rtk",
     {{"angle", Kind::number},
      {"latitude", Kind::number},
      {"longitude", Kind::number},
      {"status", Kind::integer}}},
    {"sensor", {{"imu", Kind::boolean}, {"laser", Kind::boolean}, {"robot", Kind::boolean}}},
};

std::string judge_part(const std::string& name, json part, const Keys& keys) {
  for (const char* key : {"metres_left", "error_bound_m"}) {
    if (!part.is_object() || name != "nav" || !part.contains(key)) continue;
    if (!is(part.at(key), Kind::number) || part.at(key).get<double>() < 0)
      return std::string("nav.") + key + " is no distance";
    part.erase(key);
  }
  if (!part.is_object() || part.size() != keys.size()) return name + " has other keys";
  for (const auto& [key, kind] : keys) {
    if (!part.contains(key)) return name + "." + key + " is missing";
    if (!is(part.at(key), kind)) return name + "." + key + " is of another type";
  }
  return {};
}

std::string judge_status(const Status& status) {
  if (status.document.size() != kDocument.size()) return "other keys";
  for (const auto& [name, keys] : kDocument) {
    if (!status.document.contains(name)) return std::string(name) + " is missing";
    if (auto why = judge_part(name, status.document.at(name), keys); !why.empty()) return why;
  }
  static const std::set<std::string> kLocate{"LOCATE_UNINIT", "LOCATE_TRUE", "LOCATE_FALSE"};
  static const std::set<std::string> kNav{"NAV_FREE", "NAV_RUN", "NAV_SUCCESS", "NAV_ERROR"};
  static const std::set<int> kRtk{0, 1, 2, 4, 5};
  if (!kLocate.contains(status.locate)) return "nav.locate " + status.locate;
  if (!kNav.contains(status.nav)) return "nav.status " + status.nav;
  const auto& rtk = status.document.at("rtk");
  if (!kRtk.contains(rtk.at("status").get<int>())) return "rtk.status";
  const double angle_deg = rtk.at("angle").get<double>();
  return angle_deg >= 0 && angle_deg < 360 ? std::string{} : "rtk.angle is no heading";
}

void judge_interval(const Record& record, const Interval& interval, Problems& problems) {
  std::vector<Time> times;
  for (const auto& status : record.statuses)
    if (status.time >= interval.begin && status.time <= interval.end) times.push_back(status.time);
  const auto where = " from " + seconds(interval.begin) + " to " + seconds(interval.end);
  if (times.empty()) {
    if (interval.end - interval.begin > kBack) add(problems, "no base_status" + where);
    return;
  }
  if (times.front() - interval.begin > kBack) add(problems, "base_status came late" + where);
  if (interval.end - times.back() > kGap) add(problems, "base_status ended early" + where);
  for (std::size_t i = 1; i < times.size(); ++i)
    if (times[i] - times[i - 1] > kGap)
      add(problems,
          seconds(times[i]) + ": base_status after a gap of " + seconds(times[i] - times[i - 1]));
  if (interval.end - interval.begin < 5s) return;
  // What had piled up while one of them stood still comes first, all at once.
  std::erase_if(times, [&](Time time) { return time < interval.begin + kPiledUp; });
  const double rate_Hz = static_cast<double>(times.size() - 1) / to_s(times.back() - times.front());
  if (!(std::abs(rate_Hz - 10.0) <= 0.1))
    add(problems, "base_status at " + std::to_string(rate_Hz) + " Hz" + where);
}

/// AimRT's messages and their packet, in hex: content type "pb", no context, a header first.
std::string judge_packet(const MqttLine& line) {
  static const std::set<std::string> kTopics{
      "/channel/%2Fjoint_state/pb%3Aaimrt.protocols.sensor.JointState",
      "/channel/%2Fjoint_state/pb%3Aaimrt.protocols.sensor.JointStateArray",
      "/channel/%2Fimu_state/pb%3Aaimrt.protocols.sensor.ImuState",
      "/channel/%2Ftouch_state/pb%3Aaimrt.protocols.sensor.TouchState"};
  // A scenario may send nonsense.
  if (line.topic.ends_with(".JointCommand") || line.topic.ends_with(".JointCommandArray"))
    return "";
  if (!kTopics.contains(line.topic)) return "a topic of no document";
  if (line.retained) return "is retained";
  return line.payload.starts_with("027062000a") ? "" : "is no packet: " + line.payload;
}

/// How often the origin of the map was set by then. It is answered when it is in force.
std::size_t origins_set(const Record& record, Time when) {
  return static_cast<std::size_t>(
      std::count_if(record.feedback.begin(), record.feedback.end(), [when](const Feedback& one) {
        return one.cmd == "init_rtk_data_success" && one.time <= when;
      }));
}

}  // namespace

Problems check_form(const Record& record) {
  Problems problems;
  for (const auto& status : record.statuses)
    if (const auto why = judge_status(status); !why.empty())
      add(problems, seconds(status.time) + ": base_status: " + why);
  for (const auto& line : record.mqtt) {
    const bool ours = line.topic == "base_status" || line.topic == "feedback" ||
                      line.topic == "trajectory_data" || line.topic == "scene_feedback";
    if (ours && line.retained) add(problems, seconds(line.time) + ": retained " + line.topic);
    // Added to the document: whether the gateway is there, as the broker's last will tells it.
    const bool online =
        line.topic == "drover/online" && (line.payload == "1" || line.payload == "0");
    const bool aimrt = line.topic.starts_with("/channel/");
    if (aimrt) {
      if (const auto why = judge_packet(line); !why.empty())
        add(problems, seconds(line.time) + ": " + line.topic + ": " + why);
    }
    const bool asked = line.topic == "mqtt_control" || line.topic == "collision_object" ||
                       line.topic == "planning_constraints";
    if (!ours && !online && !aimrt && !asked)
      add(problems, seconds(line.time) + ": a topic of no document: " + line.topic);
    if (line.topic != "feedback") continue;
    const auto message = json::parse(line.payload);
    if (message.value("cmd_type", "") != "feedback" || !message.contains("cmd") ||
        (message.at("cmd").get<std::string>().ends_with("_failse") &&
         message.value("reason", "").empty()))
      add(problems, seconds(line.time) + ": " + line.payload);
  }
  return problems;
}

std::vector<Interval> alive(const Record& record) {
  std::vector<Interval> intervals;
  bool gateway = false;
  bool broker = false;
  for (const auto& event : record.events) {
    const bool before = gateway && broker;
    const auto says = [&event](const char* text) { return event.text == text; };
    if (says("start droverd") || says("signal 18 to droverd") || says("thaw droverd"))
      gateway = true;
    if (says("signal 9 to droverd") || says("signal 15 to droverd") ||
        says("signal 19 to droverd") || says("freeze publish of droverd"))
      gateway = false;
    if (says("start mosquitto") || says("signal 18 to mosquitto")) broker = true;
    if (says("signal 9 to mosquitto") || says("signal 15 to mosquitto") ||
        says("signal 19 to mosquitto"))
      broker = false;
    if (says("the end")) gateway = broker = false;
    const bool now = gateway && broker;
    const Duration old = says("signal 18 to mosquitto") ? kPiledUp : Duration{};
    if (now && !before) intervals.push_back({event.time + old, Time::max()});
    if (!now && before) intervals.back().end = event.time;
  }
  return intervals;
}

bool held_back(const Record& record, Time time) {
  const auto woken = record.all("signal 18 to mosquitto");
  return std::any_of(woken.begin(), woken.end(),
                     [=](Time one) { return time >= one && time <= one + kPiledUp; });
}

Problems check_rate(const Record& record) {
  Problems problems;
  const auto intervals = alive(record);
  if (intervals.empty()) add(problems, "the gateway never ran");
  for (const auto& interval : intervals) {
    if (interval.end == Time::max())
      add(problems, "the record has no end");
    else
      judge_interval(record, interval, problems);
  }
  return problems;
}

Problems check_pose(const Record& record) {
  // Between the robot's map and the simulator's frame lies one shift, the same until the origin of
  // the map is set anew.
  constexpr double kSame_m = 0.003;
  constexpr double kSame_deg = 0.01;
  Problems problems;
  const Status* first = nullptr;
  std::size_t maps = 0;
  for (const auto& status : record.statuses) {
    if (status.locate != "LOCATE_TRUE") continue;
    const auto before = origins_set(record, status.time);
    if (first == nullptr || before != maps) first = &status;
    maps = before;
    const double dx_m = (status.sim.x_m - status.map.x_m) - (first->sim.x_m - first->map.x_m);
    const double dy_m = (status.sim.y_m - status.map.y_m) - (first->sim.y_m - first->map.y_m);
    if (!(std::hypot(dx_m, dy_m) <= kSame_m))
      add(problems, seconds(status.time) + ": pose and rtk are " +
                        std::to_string(std::hypot(dx_m, dy_m)) + " m apart");
    const double yaw_deg = status.document.at("pose").at("yaw").get<double>() * 180 / M_PI;
    const double angle_deg = status.document.at("rtk").at("angle").get<double>();
    if (!(std::abs(std::remainder(90.0 - yaw_deg - angle_deg, 360.0)) <= kSame_deg))
      add(problems, seconds(status.time) + ": yaw and angle differ");
  }
  if (first == nullptr) add(problems, "it was never located");
  return problems;
}

}  // namespace drover::mission
