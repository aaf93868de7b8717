// Values that contradict each other.
#include <algorithm>
#include <utility>

#include "config/check_subjects.h"
#include "text/number.h"
#include "text/url.h"

namespace drover::config {

namespace {

constexpr double kMostPivot_deg = 120;  // a cusp has to be a corner

void check_backwards(Findings& found) {
  const auto& engine = found.config().engine;
  if (engine.navigate.drive == TrackDrive::ahead) return;
  if (engine.navigate.backwards_speed_mps < engine.limits.min_speed_mps)
    found.add("navigate.backwards_speed_mps", "is below limits.min_speed_mps",
              "\"navigate\": {\"drive\": \"ahead\"}, or a base that can be driven so slowly");
  if (engine.navigate.pivot_angle_deg > kMostPivot_deg)
    found.add("navigate.pivot_angle_deg", "is above 120: no cusp would be a corner",
              "\"navigate\": {\"drive\": \"ahead\"}, or up to 120");
}

}  // namespace

void check_limits(Findings& found) {
  const auto& engine = found.config().engine;
  if (engine.health.battery_critical_percent > engine.health.battery_low_percent)
    found.add("health.battery_critical_percent", "is above health.battery_low_percent");
  if (engine.health.battery_hot_degC > engine.health.battery_too_hot_degC)
    found.add("health.battery_hot_degC", "is above health.battery_too_hot_degC");
  if (engine.limits.min_speed_mps > engine.limits.max_speed_mps)
    found.add("limits.min_speed_mps", "is above limits.max_speed_mps");
  if (engine.estimate.bound_start_m > engine.estimate.bound_run_m)
    found.add("estimate.bound_start_m", "is above estimate.bound_run_m",
              "a task would start and pause at once");
  check_backwards(found);
  constexpr double kBeats = 2.5;  // two lost cycles are no failure
  const double least_ms = kBeats * 1e3 / found.config().control.tick_Hz;
  if (found.config().guard.limit_ms < least_ms)
    found.add("guard.limit_ms",
              "is shorter than 2.5 control cycles (" + text::number_text(least_ms) + " ms)");
}

namespace {

/// "password", "~/password": what would be found from a person's shell, and not by the service.
void check_path(const char* path, const std::string& written, const char* like, Findings& found) {
  if (written.starts_with('/') || found.is_wrong(path)) return;
  found.add(
      path,
      "\"" + written + "\" is no absolute path: a service has no home, and its working folder is /",
      "a path like \"" + std::string(like) + "\"");
}

}  // namespace

void check_paths(Findings& found) {
  const auto& config = found.config();
  check_path("paths.state", config.paths.state, "/var/lib/drover", found);
  check_path("paths.run", config.paths.run, "/run/drover", found);
  check_path("guard.socket", config.guard.socket, "/run/drover/guard.sock", found);
  if (!config.mqtt.password_file.empty())
    check_path("mqtt.password_file", config.mqtt.password_file, "/etc/drover/mqtt.password", found);
}

namespace {

/// "mqtt://10.0.0.5:1883": what people have from elsewhere.
void check_host(const std::string& host, Findings& found) {
  if (host.starts_with('/') || found.has_problem("mqtt.host")) return;
  const auto scheme = host.find("://");
  const std::string rest = scheme == std::string::npos ? host : host.substr(scheme + 3);
  const bool is_ipv6 = std::count(rest.begin(), rest.end(), ':') > 1;
  const auto end = rest.find_first_of(is_ipv6 ? "/ " : ":/ ");
  if (scheme == std::string::npos && end == std::string::npos) return;
  const std::string name = rest.substr(0, end);
  found.add("mqtt.host", "\"" + host + "\" is no name or address of a host",
            name.empty() ? "a name like \"127.0.0.1\"" : "\"" + name + "\"; the port is mqtt.port");
}

void check_broker_port(Findings& found) {
  if (found.is_wrong("mqtt.host")) return;
  const bool is_path = found.config().mqtt.host.starts_with('/');
  if (is_path && found.config().mqtt.port != 0 && !found.is_wrong("mqtt.port"))
    found.add("mqtt.port", "must be 0 when mqtt.host is the path of a Unix socket");
  if (!is_path && found.config().mqtt.port == 0 && !found.has_problem("mqtt.port"))
    found.add("mqtt.port", "is 0, but mqtt.host is no path of a Unix socket", "1883 is usual");
}

/// As the service's IPAddressAllow=localhost has it.
bool is_this_computer(const std::string& host) {
  return host.starts_with('/') || host.starts_with("127.") || host == "::1" || host == "localhost";
}

bool is_address(const std::string& host) {
  return host.find(':') != std::string::npos ||
         host.find_first_not_of("0123456789.") == std::string::npos;
}

/// The file is good, and yet nothing would ever come of it: the service is kept to this computer.
void warn_of_remote_broker(Findings& found) {
  const auto& mqtt = found.config().mqtt;
  if (!mqtt.enabled || is_this_computer(mqtt.host) || found.has_problem("mqtt")) return;
  if (found.accepts("remote_broker")) return;
  const std::string allow = is_address(mqtt.host)
                                ? "IPAddressAllow=" + mqtt.host
                                : "its address in place of its name, and IPAddressAllow= with that "
                                  "address";
  found.hint_at("mqtt.host",
                "\"" + mqtt.host +
                    "\" is not this computer, and droverd.service speaks with no other one: it "
                    "never connects",
                allow +
                    " under [Service] by \"systemctl edit droverd\"; when that is done, "
                    "\"accept\": [\"remote_broker\"] at the top of the file");
}

}  // namespace

void check_broker(Findings& found) {
  check_host(found.config().mqtt.host, found);
  check_broker_port(found);
  if (!found.config().mqtt.password_file.empty() && found.config().mqtt.username.empty() &&
      !found.is_wrong("mqtt.username"))
    found.add("mqtt.password_file", "is given without mqtt.username");
  warn_of_remote_broker(found);
}

void check_channel(Findings& found) {
  const auto& aimrt = found.config().aimrt;
  for (const auto& [key, topic] : {std::pair{"joint_state", &aimrt.joint_state},
                                   {"imu_state", &aimrt.imu_state},
                                   {"touch_state", &aimrt.touch_state},
                                   {"joint_command", &aimrt.joint_command}}) {
    // An MQTT topic of AimRT has at most 255 bytes, and 59 stand around this one.
    constexpr std::size_t kLongest = 196;
    const auto path = "aimrt." + std::string(key);
    if (topic->empty()) found.add(path, "is empty");
    if (text::url_encoded(*topic).size() > kLongest)
      found.add(path, "is too long", "at most 196 bytes; / and other signs count three");
  }
}

/// Joints outside the base do nothing but what they are told.
void warn_of_deaf_arms(Findings& found) {
  const auto& config = found.config();
  const bool over_mqtt = config.aimrt.enabled && config.aimrt.commands;
  const bool over_ros2 =
      config.ros2.configured && config.ros2.mode != "off" && config.ros2.inputs.joint_command;
  if (config.engine.groups.empty() || over_mqtt || over_ros2) return;
  found.hint_at("groups." + std::string(config.engine.groups[0].name.view()),
                std::string("nobody can move it: aimrt.") +
                    (config.aimrt.enabled ? "commands" : "enabled") +
                    " is false, and ros2.inputs.joint_command is closed",
                "one of the two");
}

void check_ros2(Findings& found) {
  const auto& ros2 = found.config().ros2;
  if (ros2.mode == "network" && ros2.inputs.any() && !ros2.network_inputs)
    found.add("ros2.inputs", "would be open to whoever reaches the robot's networks",
              "\"mode\": \"localhost\"; or \"network_inputs\": true, if that is meant");
  if (ros2.inputs.may_change_scene() && !found.config().scene.configured)
    found.add(ros2.inputs.collision_object ? "ros2.inputs.collision_object"
                                           : "ros2.inputs.planning_constraints",
              "is open, and there is no scene that it could go to", "a section \"scene\"");
}

}  // namespace drover::config
