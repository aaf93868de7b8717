#include <cmath>

#include "json/members.h"
#include "ros2/told.h"

namespace drover::ros2 {
namespace {

using json::Node;

const std::vector<Node> kNone;

double number(const Node& from, std::string_view key) {
  const Node* node = from.find(key);
  return node == nullptr ? kAbsent : node->number().value_or(kAbsent);
}
double number_or_0(const Node& from, std::string_view key) {
  const double value = number(from, key);
  return std::isfinite(value) ? value : 0;
}
std::int64_t integer_or_0(const Node& from, std::string_view key) {
  const Node* node = from.find(key);
  return node == nullptr ? 0 : node->integer().value_or(0);
}
Stamp_ns stamp(const Node& from, std::string_view key) {
  return integer_or_0(from, key);
}
const std::vector<Node>& list(const Node& from, std::string_view key) {
  const Node* node = from.find(key);
  return node == nullptr || node->list() == nullptr ? kNone : *node->list();
}
double nth(const std::vector<Node>& numbers, std::size_t i) {
  return i < numbers.size() ? numbers[i].number().value_or(kAbsent) : kAbsent;
}
Vector3 vector(const Node& from, std::string_view key) {
  const auto& numbers = list(from, key);
  return {nth(numbers, 0), nth(numbers, 1), nth(numbers, 2)};
}

JointsTold joints(const Node& from) {
  JointsTold joints;
  joints.at_ns = stamp(from, "at_ns");
  for (const Node& one : list(from, "each"))
    joints.each.push_back({text_member(one, "name"), number(one, "position_rad"),
                           number(one, "velocity_radps"), number(one, "effort_Nm")});
  return joints;
}

ImuTold imu(const Node& from) {
  ImuTold imu;
  imu.at_ns = stamp(from, "at_ns");
  if (const auto& q = list(from, "orientation_xyzw"); q.size() == 4)
    imu.orientation = Quaternion{nth(q, 3), nth(q, 0), nth(q, 1), nth(q, 2)};
  imu.orientation_sigma_rad = number(from, "orientation_sigma_rad");
  imu.yaw_sigma_rad = number(from, "yaw_sigma_rad");
  imu.rate_radps = vector(from, "rate_radps");
  imu.acceleration_mps2 = vector(from, "acceleration_mps2");
  imu.rate_sigma_radps = number(from, "rate_sigma_radps");
  imu.acceleration_sigma_mps2 = number(from, "acceleration_sigma_mps2");
  return imu;
}

FixTold fix(const Node& from) {
  FixTold fix;
  fix.at_ns = stamp(from, "at_ns");
  fix.receiver = text_member(from, "receiver");
  const auto quality = integer_or_0(from, "quality");
  const bool known = quality >= 0 && quality <= static_cast<int>(FixQuality::simulator);
  fix.position.quality = known ? static_cast<FixQuality>(quality) : FixQuality::none;
  fix.position.latitude_deg = number(from, "latitude_deg");
  fix.position.longitude_deg = number(from, "longitude_deg");
  fix.position.altitude_msl_m = number(from, "altitude_msl_m");
  fix.position.undulation_m = number(from, "undulation_m");
  fix.position.sigma_east_m = number(from, "sigma_east_m");
  fix.position.sigma_north_m = number(from, "sigma_north_m");
  fix.position.sigma_up_m = number(from, "sigma_up_m");
  return fix;
}

OdometryTold odometry(const Node& from) {
  const auto& variances = list(from, "variances");
  OdometryTold way;
  way.at_ns = stamp(from, "at_ns");
  way.x_m = number_or_0(from, "x_m");
  way.y_m = number_or_0(from, "y_m");
  way.yaw_rad = number_or_0(from, "yaw_rad");
  way.vx_mps = number_or_0(from, "vx_mps");
  way.wz_radps = number_or_0(from, "wz_radps");
  way.vy_mps = number_or_0(from, "vy_mps");
  std::size_t i = 0;
  for (double* variance : {&way.x_var, &way.xy_var, &way.y_var, &way.x_yaw_var, &way.y_yaw_var,
                           &way.yaw_var, &way.vx_var, &way.wz_var, &way.vy_var})
    *variance = nth(variances, i++);
  return way;
}

BatteryTold battery(const Node& from) {
  BatteryTold battery;
  battery.at_ns = stamp(from, "at_ns");
  battery.heard = flag_member(from, "heard");
  battery.sample.voltage_V = number(from, "voltage_V");
  battery.sample.current_A = number(from, "current_A");
  battery.sample.soc_percent = number(from, "soc_percent");
  battery.sample.remaining_Ah = number(from, "remaining_Ah");
  battery.sample.temperature_degC = number(from, "temperature_degC");
  const auto flow = text_member(from, "flow");
  if (flow == "idle") battery.sample.flow = BatteryFlow::idle;
  if (flow == "charging") battery.sample.flow = BatteryFlow::charging;
  if (flow == "discharging") battery.sample.flow = BatteryFlow::discharging;
  const auto alarm = integer_or_0(from, "alarm");
  if (alarm == 1) battery.sample.alarm = BatteryAlarm::warning;
  if (alarm == 2) battery.sample.alarm = BatteryAlarm::critical;
  return battery;
}

ScanTold scan(const Node& from) {
  ScanTold scan;
  scan.name = text_member(from, "name");
  scan.begin_ns = stamp(from, "begin_ns");
  scan.end_ns = stamp(from, "end_ns");
  scan.turn_Hz = number(from, "turn_Hz");
  const auto& points = list(from, "points");
  for (std::size_t i = 0; i + 2 < points.size(); i += 3)
    scan.points.push_back({nth(points, i), nth(points, i + 1), nth(points, i + 2)});
  return scan;
}

DiagnosticTold diagnostic(const Node& from) {
  DiagnosticTold one{text_member(from, "name"),
                     static_cast<int>(integer_or_0(from, "level")),
                     text_member(from, "message"),
                     {}};
  for (const Node& value : list(from, "values"))
    one.values.emplace_back(text_member(value, "key"), text_member(value, "value"));
  return one;
}

}  // namespace

Result<Told, NoTold> read_told(std::string_view line) {
  const auto document = json::parse(line, {.max_depth = 6});
  if (!document) return NoTold{"not understood: " + document.error().text()};
  const Node& root = document->root;
  if (root.find("ok") != nullptr)
    return flag_member(root, "ok")
               ? NoTold{"", true, false}
               : NoTold{text_member(root, "reason"), false, text_member(root, "cmd") == "stop"};
  if (root.find("at_ns") == nullptr) return NoTold{"not understood: at_ns is missing"};
  Told told;
  told.at_ns = stamp(root, "at_ns");
  if (const Node* part = root.find("joints")) told.joints = joints(*part);
  if (const Node* part = root.find("imu")) told.imu = imu(*part);
  if (const Node* part = root.find("fix")) told.fix = fix(*part);
  if (const Node* part = root.find("odometry")) told.odometry = odometry(*part);
  if (const Node* part = root.find("pose"))
    told.pose = PoseTold{number_or_0(*part, "x_m"), number_or_0(*part, "y_m"),
                         number_or_0(*part, "yaw_rad"), number(*part, "position_sigma_m"),
                         number(*part, "yaw_sigma_rad")};
  if (const Node* part = root.find("battery")) told.battery = battery(*part);
  if (const Node* part = root.find("touch")) {
    told.touch.emplace().at_ns = stamp(*part, "at_ns");
    for (const Node& one : list(*part, "each"))
      told.touch->each.push_back({text_member(one, "name"), flag_member(one, "touched")});
  }
  for (const Node& one : list(root, "scans")) told.scans.push_back(scan(one));
  for (const Node& one : list(root, "diagnostics")) told.diagnostics.push_back(diagnostic(one));
  return told;
}

}  // namespace drover::ros2
