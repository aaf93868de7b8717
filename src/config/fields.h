// The configuration's keys: name, place, range and meaning of each, in one table per object.
//
// The same tables read drover.json, write its JSON schema and so cannot disagree. A visitor has
// number, integer, flag, text, object, list, names, point and options.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "config/config.h"
#include "drover/registry.h"

namespace drover::config {

struct Range {
  double min = 0;
  double max = 0;
};
enum class Presence : std::uint8_t { optional, required };

enum class DriverShape : std::uint8_t { can, bytes, line };
/// Names of the registered drivers of one shape.
inline std::vector<std::string> driver_names(DriverShape shape) {
  std::vector<std::string> names;
  for (const auto& entry : driver_registry())
    if (entry.make.index() == static_cast<std::size_t>(shape)) names.emplace_back(entry.name);
  return names;
}

template <class V>
void visit(V& v, PathsConfig& c) {
  v.text("state", c.state, "folder of tracks and origin");
  v.text("run", c.run, "folder of the command line's socket");
}

template <class V>
void visit(V& v, ControlConfig& c) {
  v.number("tick_Hz", c.tick_Hz, Range{50, 1000}, "control cycles a second");
  v.flag("realtime", c.realtime, "ask for SCHED_FIFO and locked memory");
  v.integer("priority", c.priority, Range{1, 69}, "SCHED_FIFO priority; the guard has 70");
}

template <class V>
void visit(V& v, BusConfig& c) {
  v.text("name", c.name, "how drives refer to it", Presence::required);
  v.text("interface", c.interface, "SocketCAN interface, or unix:PATH of a socket with CAN frames",
         Presence::required);
}

template <class V>
void visit(V& v, DriveConfig& c) {
  v.text("joint", c.joint, "name of the driven axis", Presence::required);
  v.choice("driver", c.driver, driver_names(DriverShape::can), "driver", Presence::required);
  v.text("bus", c.bus, "name of the bus it hangs on", Presence::required);
  v.options("options", c.options, c.driver, DriverShape::can);
}

template <class V>
void visit(V& v, GnssConfig& c) {
  v.choice("driver", c.driver, driver_names(DriverShape::bytes), "driver");
  v.text("port", c.port, "serial line");
  v.integer("baud", c.baud, Range{4800, 921600}, "baud rate");
  v.options("options", c.options, c.driver, DriverShape::bytes);
  c.configured = true;
}

template <class V>
void visit(V& v, LineConfig& c) {
  v.text("line", c.name, "name of the line on the chip", Presence::required);
  v.choice("driver", c.driver, driver_names(DriverShape::line), "driver");
  v.options("options", c.options, c.driver, DriverShape::line);
  c.configured = true;
}

template <class V>
void visit(V& v, LinesConfig& c) {
  v.text("chip", c.chip, "label or name of the GPIO chip, or files:DIRECTORY", Presence::required);
  v.object("estop", c.line[static_cast<std::size_t>(Line::estop)], "emergency stop");
  v.object("bumper", c.line[static_cast<std::size_t>(Line::bumper)], "bumper");
  v.object("zone_far", c.line[static_cast<std::size_t>(Line::zone_far)], "far zone: slows");
  v.object("zone_near", c.line[static_cast<std::size_t>(Line::zone_near)], "near zone: stops");
}

template <class V>
void visit(V& v, GuardConfig& c) {
  v.flag("required", c.required, "refuse to move without drover-guard");
  v.text("socket", c.socket, "where drover-guard listens");
  v.integer("limit_ms", c.limit_ms, Range{20, 1000}, "heartbeat age at which the guard stops the drives");
}

template <class V>
void visit(V& v, MqttConfig& c) {
  v.flag("enabled", c.enabled, "connect to a broker");
  v.text("host", c.host, "host name, address, or path of a Unix socket (then port 0)");
  v.integer("port", c.port, Range{0, 65535}, "port");
  v.text("client_id", c.client_id, "empty: droverd- and eight random hex digits");
  v.text("username", c.username, "user at the broker");
  v.text("password_file", c.password_file, "file whose first line is the password");
  v.integer("keepalive_s", c.keepalive_s, Range{5, 60}, "MQTT keepalive");
}

template <class V>
void visit(V& v, ProtocolConfig& c) {
  v.choice("heading", c.heading,
           {"clockwise_from_north", "counterclockwise_from_north", "counterclockwise_from_east"},
           "how rtk.angle and a point's angle count");
  v.integer("first_target_id", c.first_target_id, Range{0, 1}, "number of a track's first point");
  v.choice("power", c.power, {"percent", "volts"}, "what robot.power shows");
  v.flag("automatic_origin", c.automatic_origin,
         "take the first RTK fix as origin when none was ever stored");
}

template <class V>
void visit(V& v, engine::LimitsConfig& c) {
  v.number("max_speed_mps", c.max_speed_mps, Range{0.05, 5}, "faster requests are clamped, and it is said");
  v.number("min_speed_mps", c.min_speed_mps, Range{0.01, 1}, "slower requests are refused");
  v.number("max_yaw_rate_radps", c.max_yaw_rate_radps, Range{0.05, 5}, "fastest turn");
  v.number("acceleration_mps2", c.acceleration_mps2, Range{0.05, 5}, "speeding up");
  v.number("deceleration_mps2", c.deceleration_mps2, Range{0.05, 10}, "controlled stop");
  v.number("jerk_mps3", c.jerk_mps3, Range{0.1, 100}, "change of acceleration");
  v.number("yaw_acceleration_radps2", c.yaw_acceleration_radps2, Range{0.1, 20}, "change of turn");
}

template <class V>
void visit(V& v, engine::EstimateConfig& c) {
  v.number("antenna_x_m", c.antenna_x_m, Range{-10, 10}, "antenna ahead of base_link");
  v.number("antenna_y_m", c.antenna_y_m, Range{-10, 10}, "antenna left of base_link");
  v.number("antenna_z_m", c.antenna_z_m, Range{-10, 10}, "antenna above base_link");
  v.number("heading_baseline_offset_deg", c.heading_baseline_offset_deg, Range{-360, 360},
           "antenna line from ahead, clockwise");
  v.number("heading_sigma_deg", c.heading_sigma_deg, Range{0.05, 20}, "one sigma of the heading");
  v.number("max_correction_age_s", c.max_correction_age_s, Range{1, 600},
           "an RTK fix with older corrections counts as float");
  v.number("bound_start_m", c.bound_start_m, Range{0.01, 10}, "predicted error (two sigma) to start with");
  v.number("bound_run_m", c.bound_run_m, Range{0.01, 10}, "predicted error (two sigma) to drive with");
  v.number("bound_yaw_deg", c.bound_yaw_deg, Range{0.5, 45}, "predicted heading error (two sigma)");
  v.number("max_measurement_delay_s", c.max_measurement_delay_s, Range{0.05, 1}, "older ones are not used");
  v.number("gate_sigma", c.gate_sigma, Range{2, 20}, "innovations beyond this are not believed");
  v.number("jump_time_s", c.jump_time_s, Range{0.2, 10}, "consistent disagreement that ends a task");
}

template <class V>
void visit(V& v, engine::NavigateConfig& c) {
  v.number("start_distance_m", c.start_distance_m, Range{0.1, 20}, "farther from the track: refused");
  v.number("start_angle_deg", c.start_angle_deg, Range{5, 180}, "worse turned: refused");
  v.number("goal_tolerance_m", c.goal_tolerance_m, Range{0.02, 2}, "arrived");
  v.number("lookahead_s", c.lookahead_s, Range{0.2, 5}, "look-ahead of the tracker");
  v.number("min_lookahead_m", c.min_lookahead_m, Range{0.1, 5}, "shortest look-ahead");
  v.number("lateral_acceleration_mps2", c.lateral_acceleration_mps2, Range{0.05, 3}, "slows for curves");
  v.number("creep_speed_mps", c.creep_speed_mps, Range{0.02, 1}, "slowest speed near the goal");
  v.number("far_zone_speed_mps", c.far_zone_speed_mps, Range{0, 5}, "cap while the far zone is occupied");
  v.number("corridor_m", c.corridor_m, Range{0.05, 10}, "farther off the track: the task fails");
  v.number("resume_after_s", c.resume_after_s, Range{0.2, 60}, "of health, before a pause ends");
  v.number("obstacle_timeout_s", c.obstacle_timeout_s, Range{1, 3600}, "a longer obstacle ends the task");
  v.number("locate_timeout_s", c.locate_timeout_s, Range{1, 3600}, "a longer loss ends the task");
  v.number("start_timeout_s", c.start_timeout_s, Range{0.5, 60}, "drives not running by then: not started");
  v.number("blocked_timeout_s", c.blocked_timeout_s, Range{0.2, 60}, "commanded but not moving");
  v.number("arrival_timeout_s", c.arrival_timeout_s, Range{1, 600}, "creeping near the goal");
}

template <class V>
void visit(V& v, engine::HealthConfig& c) {
  v.number("drive_stale_s", c.drive_stale_s, Range{0.02, 2}, "silence of a drive");
  v.number("gnss_stale_s", c.gnss_stale_s, Range{0.1, 5}, "silence of the receiver");
  v.number("line_stale_s", c.line_stale_s, Range{0.01, 1}, "silence of a line");
}

/// The base names joints; the engine wants axis numbers: `left` and `right` are resolved afterwards.
struct BaseNames {
  engine::BaseConfig* base = nullptr;
  std::vector<std::string> left;
  std::vector<std::string> right;
};

template <class V>
void visit(V& v, BaseNames& c) {
  v.number("wheel_radius_m", c.base->wheel_radius_m, Range{0.01, 2}, "wheel radius", Presence::required);
  v.number("track_m", c.base->track_m, Range{0.05, 5}, "between left and right wheels", Presence::required);
  v.number("yaw_slip_factor", c.base->yaw_slip_factor, Range{0.5, 4},
           "how much wider the base behaves when it turns");
  v.names("left", c.left, "joints of the left side", Presence::required);
  v.names("right", c.right, "joints of the right side", Presence::required);
}

template <class V>
void visit(V& v, DroverConfig& c, BaseNames& base) {
  v.text("robot", c.robot_name, "name of this robot");
  v.object("paths", c.paths, "folders");
  v.object("control", c.control, "control thread");
  v.list("buses", c.buses, "CAN buses", Presence::required);
  v.list("drives", c.drives, "driven axes, in order", Presence::required);
  v.object("base", base, "the vehicle", Presence::required);
  v.object("gnss", c.gnss, "RTK receiver");
  v.object("lines", c.lines, "digital inputs");
  v.object("limits", c.engine.limits, "limits of motion");
  v.object("estimate", c.engine.estimate, "fusion");
  v.object("navigate", c.engine.navigate, "tasks");
  v.object("health", c.engine.health, "freshness");
  v.object("guard", c.guard, "drover-guard");
  v.object("mqtt", c.mqtt, "broker");
  v.object("protocol", c.protocol, "choices of the RTK navigation protocol");
}

}  // namespace drover::config
