// What the rig says to the robot and hears from it: commands, status, the record of the bus.
#include <signal.h>

#include <cmath>
#include <cstdio>
#include <cstring>
#include <fstream>
#include <limits>

#include "integration/robot_rig.h"
#include "json/json_text.h"
#include "json/located_json.h"

namespace drover::test {

void RobotRig::control(std::string_view text, bool retained) {
  client_.publish("mqtt_control", text, retained);
}

void RobotRig::wait_until_believed() {
  (void)wait_until([end = now_s() + 1.5] { return now_s() > end; });
}

std::string RobotRig::track_ahead(const std::string& name, double length_m) const {
  constexpr double kMetresPerDegree = 111'320;
  const double x_m = status_number("pose", "x");
  const double y_m = status_number("pose", "y");
  const double latitude_deg = status_number("rtk", "latitude");
  const double longitude_deg = status_number("rtk", "longitude");
  // The receiver's place is the antenna's: it and x, y fit together by where the robot faces.
  const double angle_deg = status_number("rtk", "angle");
  const double yaw_rad = status_number("pose", "yaw");
  json::JsonText text;
  text.open('{').key("cmd_type").text("trajectory_control").key("cmd").text("save_trajectory");
  text.key("data").open('{').key("name").text(name).key("data").open('[');
  for (double s_m = 0; s_m < length_m + 0.01; s_m += 0.5) {
    text.open('{').key("angle").number(angle_deg).key("latitude").number(latitude_deg);
    text.key("longitude")
        .number(longitude_deg +
                s_m / kMetresPerDegree / std::cos(latitude_deg * std::acos(-1.0) / 180));
    text.key("x").number(x_m + s_m).key("y").number(y_m).key("yaw").number(yaw_rad).close('}');
  }
  text.close(']').close('}').close('}');
  return text.str();
}

void RobotRig::save_track(const std::string& name, double length_m) {
  // What came while a command was run was told before it, maybe by a robot that was lost then: of
  // such a message place and x, y fit no track.
  (void)wait_until([end = now_s() + 0.3] { return now_s() > end; });
  ASSERT_TRUE(wait_for_locate()) << client_.last("base_status");
  const auto before = client_.heard().size();
  control(track_ahead(name, length_m));
  ASSERT_TRUE(wait_for_feedback("save_trajectory_success", before));
}

void RobotRig::start_task(const std::string& name, int id, double speed_mps) {
  json::JsonText text;
  text.open('{').key("cmd_type").text("task_control").key("cmd").text("start_task");
  text.key("name").text(name).key("id").integer(id).key("speed").number(speed_mps).close('}');
  control(text.str());
}

double RobotRig::start_until_accepted(const std::string& name, int id) {
  double sent_s = 0;
  EXPECT_TRUE(wait_until([&] {
    sent_s = now_s();
    const auto before = client_.heard().size();
    start_task(name, id);
    if (!wait_until([&] { return !client_.feedback(before).empty(); })) return false;
    if (client_.feedback(before).front() == "start_task_success") return true;
    // The same start again within a second counts as one that was delivered twice.
    (void)wait_until([end = now_s() + 1.2] { return now_s() > end; });
    return false;
  })) << client_.last("feedback");
  return sent_s;
}

void RobotRig::drive(double length_m) {
  ASSERT_NO_FATAL_FAILURE(save_track("row", length_m));
  const auto before = client_.heard().size();
  (void)start_until_accepted("row", static_cast<int>(length_m / 0.5) + 1);
  ASSERT_TRUE(wait_for_feedback("start_nav_success", before));
  ASSERT_TRUE(wait_until([&] { return true_speed_mps() > 0.1; }));
}

std::string RobotRig::status_text(std::string_view section, std::string_view key) const {
  const auto document = json::parse(client_.last("base_status"));
  const auto* part = document ? document->root.find(section) : nullptr;
  const auto* value = part != nullptr ? part->find(key) : nullptr;
  if (value == nullptr) return {};
  if (const auto* text = value->text()) return *text;
  if (const auto* flag = value->boolean()) return *flag ? "true" : "false";
  return {};
}

double RobotRig::status_number(std::string_view section, std::string_view key) const {
  const auto document = json::parse(client_.last("base_status"));
  const auto* part = document ? document->root.find(section) : nullptr;
  const auto* value = part != nullptr ? part->find(key) : nullptr;
  const auto number = value != nullptr ? value->number() : std::nullopt;
  return number.value_or(std::numeric_limits<double>::quiet_NaN());
}

double RobotRig::true_speed_mps() {
  const auto truth = json::parse(sim({"truth"}));
  const auto* vx = truth ? truth->root.find("vx_mps") : nullptr;
  EXPECT_NE(vx, nullptr) << sim_.output();
  return vx != nullptr ? std::abs(vx->number().value_or(99)) : 99;
}

std::vector<SetPoint> RobotRig::set_points_on_the_bus() {
  sim_.signal(SIGTERM);
  EXPECT_EQ(sim_.wait(std::chrono::seconds(60)), 0) << sim_.output();
  constexpr unsigned kSetInputVel = 0x0D;  // ODrive CANSimple: node in bits 5 to 10, command below
  std::vector<SetPoint> points;
  std::ifstream file(folder_ / "log" / "can.log");
  std::string line;
  while (std::getline(file, line)) {
    SetPoint point;
    unsigned id = 0;
    unsigned b[4]{};
    if (std::sscanf(line.c_str(), "(%lf) can%u %3x#%2x%2x%2x%2x", &point.time_s, &point.bus, &id,
                    &b[0], &b[1], &b[2], &b[3]) != 7 ||
        (id & 0x1FU) != kSetInputVel)
      continue;
    const std::uint32_t bits = b[0] | b[1] << 8U | b[2] << 16U | b[3] << 24U;
    std::memcpy(&point.velocity_turnps, &bits, sizeof bits);
    point.node = id >> 5U;
    points.push_back(point);
  }
  return points;
}

}  // namespace drover::test
