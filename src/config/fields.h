// The configuration's keys: name, place, range and meaning of each, in one table per object.
//
// The same tables read drover.json, write its JSON schema and so cannot disagree. A visitor has
// number, integer, flag, text, choice, object, list, table, others, names, options, keys_of_kind
// and keys_of_base.
#pragma once

#include <array>
#include <cstdint>
#include <initializer_list>
#include <string>
#include <vector>

#include "config/config.h"
#include "config/fields_engine.h"
#include "drover/registry.h"

namespace drover::config {

/// As many as the runtime has room for.
inline constexpr std::size_t kMaxBuses = 8;

/// As many as the status has room for, beside the outputs.
inline constexpr std::size_t kMaxLinks = 17;
inline constexpr std::size_t kMaxDevices = 80;

/// Of the scene.
inline constexpr std::size_t kMaxCorners = 32;
inline constexpr std::size_t kMaxFrames = 32;

/// Names of all drivers.
inline std::vector<std::string> driver_names() {
  std::vector<std::string> names;
  for (const auto& entry : driver_registry()) names.emplace_back(entry.name);
  return names;
}

/// A key that only devices of some kinds have.
struct KindKey {
  std::string_view key;
  unsigned kinds = 0;  ///< bits by SlotKind
  Presence presence = Presence::optional;

  bool fits(SlotKind kind) const { return (kinds >> static_cast<unsigned>(kind) & 1U) != 0; }
};

constexpr unsigned kinds(std::initializer_list<SlotKind> all) {
  unsigned bits = 0;
  for (const SlotKind kind : all) bits |= 1U << static_cast<unsigned>(kind);
  return bits;
}

inline constexpr KindKey kKindKeys[] = {
    {"joints", kinds({SlotKind::drive}), Presence::optional},
    {"accept", kinds({SlotKind::drive}), Presence::optional},
    {"map", kinds({SlotKind::battery}), Presence::required},
    {"unit", kinds({SlotKind::battery}), Presence::optional},
    {"period_s", kinds({SlotKind::battery}), Presence::optional},
    {"line", kinds({SlotKind::line}), Presence::required},
    {"is", kinds({SlotKind::line}), Presence::required},
    {"role", kinds({SlotKind::gnss, SlotKind::imu, SlotKind::battery}), Presence::optional},
    {"antenna_x_m", kinds({SlotKind::gnss}), Presence::optional},
    {"antenna_y_m", kinds({SlotKind::gnss}), Presence::optional},
    {"antenna_z_m", kinds({SlotKind::gnss}), Presence::optional},
    {"heading_baseline_offset_deg", kinds({SlotKind::gnss}), Presence::optional},
};

inline bool has_key(const DriverEntry& entry, const KindKey& key) {
  return key.fits(entry.kind) && !(key.key == "joints" && takes_twist(entry));
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
void visit(V& v, LinkConfig& c) {
  v.text("can", c.can, "SocketCAN interface, or unix:PATH of a socket with CAN frames",
         Presence::alternative);
  v.text("serial", c.serial, "serial line", Presence::alternative);
  v.text("modbus", c.modbus, "serial line, or tcp:ADDRESS:PORT with an IPv4 address",
         Presence::alternative);
  v.text("gpio", c.gpio, "label or name of a GPIO chip, or files:DIRECTORY", Presence::alternative);
  v.integer("baud", c.baud, Range{0, 10000000},
            "of a serial line; 0: as its device usually has it, mostly 115200; on modbus as its "
            "map says");
  v.choice("parity", c.parity, {"none", "even", "odd"}, "of a serial line with modbus");
}

template <class V>
void visit(V& v, JointConfig& c) {
  v.text("channel", c.channel, "which of the device's axes; left out when it has one");
}

template <class V>
void visit(V& v, DeviceConfig& c) {
  v.choice("driver", c.driver, driver_names(), "driver", Presence::required);
  v.text("link", c.link, "name of the link it hangs on", Presence::required);
  v.options("options", c.options, c.driver);
  v.table("joints", c.joints, Count{1, kMaxChannels},
          "axes by name; left out: one, with the device's name");
  v.names("accept", c.accept, Count{0, 1},
          "no_watchdog: this drive goes on for ever when frames cease, and that is known");
  v.text("map", c.map,
         "file of the device's registers: beside this file, or one of the installed maps");
  v.integer("unit", c.unit, Range{0, 247}, "Modbus unit; left out: the device's usual one");
  v.number("period_s", c.period_s, Range{0.2, 60}, "how often it is asked");
  v.text("line", c.line, "name of the line on the chip, or its number where it has none");
  v.choice("is", c.is, {kLineKeys.begin(), kLineKeys.end()},
           "emergency stop, bumper, far zone (slows) or near zone (stops)");
  v.choice(
      "role", c.role, {"steers", "spare", "told"},
      "the robot goes by it; takes over when that is not well; only shown. The first of a kind "
      "steers unless it says otherwise");
  visit_antenna(v, c, Presence::inherited);
  v.keys_of_kind(c.driver);
}

/// As `follows` and `on_silence` are written, by JointFollows and OnSilence.
inline constexpr std::array<std::string_view, 4> kFollowsWords{"impedance", "position", "velocity",
                                                               "effort"};
inline constexpr std::array<std::string_view, 3> kSilenceWords{"hold", "damp", "release"};

/// A joint outside the base.
struct GroupJoint {
  engine::JointRules rules;  ///< but for its axis, and the two words
  std::string follows{kFollowsWords[0]};
  std::string on_silence{kSilenceWords[0]};
  std::string name;  ///< its key in the table
};

/// Joints outside the base that belong together.
struct JointGroup {
  std::vector<GroupJoint> joints;
  std::string name;  ///< its key in the table
};

template <class V>
void visit(V& v, GroupJoint& c) {
  engine::JointRules& r = c.rules;
  v.choice("follows", c.follows, {kFollowsWords.begin(), kFollowsWords.end()},
           "which values of a joint command: all five (impedance); position, with a velocity; "
           "velocity; or effort, with damping. The others have to be 0");
  v.number("min_rad", r.min_rad, Range{-1000, 1000}, "lowest position", Presence::required);
  v.number("max_rad", r.max_rad, Range{-1000, 1000}, "highest position", Presence::required);
  v.number("max_velocity_radps", r.max_velocity_radps, Range{0.01, 100}, "fastest",
           Presence::required);
  v.number("max_acceleration_radps2", r.max_acceleration_radps2, Range{0.1, 10000},
           "how fast the velocity of its set point changes");
  v.number("max_effort_Nm", r.max_effort_Nm, Range{0.01, 10000},
           "highest effort, and what stiffness makes of a distance", Presence::required);
  v.number("stiffness_Nmprad", r.stiffness_Nmprad, Range{0, 10000},
           "of holding, and of following a position or velocity");
  v.number("damping_Nmsprad", r.damping_Nmsprad, Range{0, 1000}, "likewise, and of damping");
  v.number("rise_s", r.rise_s, Range{0.02, 10},
           "in which stiffness and effort come up from nothing");
  v.number("timeout_s", r.timeout_s, Range{0.02, 1}, "longer without a command: they have ceased");
  v.choice("on_silence", c.on_silence, {kSilenceWords.begin(), kSilenceWords.end()},
           "when commands cease (a stop always holds): hold where it is, damp (it sinks slowly), "
           "release (the drive lets go)");
  v.flag(
      "carries_weight", r.carries_weight,
      "without power it sinks or falls; held, it keeps the effort that carried it. To be said of "
      "each joint");
}

template <class V>
void visit(V& v, JointGroup& c) {
  v.table("joints", c.joints, Count{1, engine::kMaxOfGroup}, "its joints, by name",
          Presence::required);
}

/// What the groups of joints refer to by name.
struct GroupNames {
  BaseNames base;
  std::vector<JointGroup> others;
};

template <class V>
void visit(V& v, GroupNames& c) {
  v.object("base", c.base, "the vehicle", Presence::required);
  v.others(c.others, engine::kMaxGroups, "joints beside the base: an arm, a mast");
}

template <class V>
void visit(V& v, OutputConfig& c) {
  v.text("line", c.name, "name of the line on the chip, or its number where it has none",
         Presence::required);
  v.flag("active_low", c.active_low, "on is electrically low");
  c.configured = true;
}

template <class V>
void visit(V& v, OutputsConfig& c) {
  v.text("link", c.link, "name of the link to their chip", Presence::required);
  v.object("enable_relay", c.output[static_cast<std::size_t>(Output::enable_relay)],
           "power of the drives: off while an e-stop is pressed");
  v.object("lamp", c.output[static_cast<std::size_t>(Output::lamp)], "state, for people near it");
  v.object("buzzer", c.output[static_cast<std::size_t>(Output::buzzer)],
           "two beeps before motion, a long one at a stop");
  v.object("watchdog", c.watchdog, "pulsed by drover-guard for a hardware watchdog");
}

template <class V>
void visit(V& v, GuardConfig& c) {
  v.flag("required", c.required, "refuse to move without drover-guard");
  v.text("socket", c.socket, "where drover-guard listens");
  v.integer("limit_ms", c.limit_ms, Range{20, 1000},
            "heartbeat age at which the guard stops the drives");
}

template <class V>
void visit(V& v, MqttConfig& c) {
  v.flag("enabled", c.enabled, "connect to a broker");
  v.text("host", c.host, "host name, address, or path of a Unix socket (then port 0)");
  v.integer("port", c.port, Range{0, 65535}, "port");
  v.text("client_id", c.client_id, "empty: droverd- and eight random hex digits");
  v.text("username", c.username, "user at the broker");
  v.text("password_file", c.password_file,
         "file whose first line is the password; waited for while it is missing");
  v.integer("keepalive_s", c.keepalive_s, Range{5, 60}, "MQTT keepalive");
}

template <class V>
void visit(V& v, ProtocolConfig& c) {
  v.choice("heading", c.heading,
           {"clockwise_from_north", "counterclockwise_from_north", "counterclockwise_from_east"},
           "how rtk.angle and a point's angle count");
  v.integer("first_target_id", c.first_target_id, Range{0, 1}, "number of a track's first point");
  v.choice("power", c.power, {"percent", "volts"}, "what robot.power shows");
  v.choice("vz", c.vz, {"yaw_rate", "steering_angle"},
           "what robot.vz shows; steering_angle: of a base of kind ackermann");
  v.flag("start_needs_time", c.start_needs_time,
         "refuse a start_task that does not tell when it was pressed (member time)");
  v.flag("automatic_origin", c.automatic_origin,
         "take the first RTK fix as origin when none was ever stored");
}

template <class V>
void visit(V& v, AimrtConfig& c) {
  v.flag("enabled", c.enabled, "publish AimRT's messages on the broker");
  v.number("rate_Hz", c.rate_Hz, Range{1, 200},
           "joint and IMU messages a second; touch has its own pace");
  v.flag("commands", c.commands, "follow joint commands");
  v.integer("max_command_age_ms", c.max_command_age_ms, Range{10, 10000},
            "a joint command with an older time stamp is refused");
  v.text("joint_state", c.joint_state, "channel topic of JointState");
  v.text("imu_state", c.imu_state, "channel topic of ImuState");
  v.text("touch_state", c.touch_state, "channel topic of TouchState");
  v.text("joint_command", c.joint_command, "channel topic of JointCommand");
  v.choice("joint_state_names", c.joint_state_names, {"document", "aimrt_1x", "both"},
           "JointState (document), JointStateArray (aimrt_1x), or both");
  v.choice("touch_state_names", c.touch_state_names, {"document", "aimrt_1x", "both"},
           "TouchState (document), TouchSensorStateArray (aimrt_1x), or both");
  v.choice("joint_state_content", c.joint_state_content, {"pb", "json"}, "protobuf or JSON");
  v.choice("imu_state_content", c.imu_state_content, {"pb", "json"}, "protobuf or JSON");
  v.choice("touch_state_content", c.touch_state_content, {"pb", "json"}, "protobuf or JSON");
}

template <class V>
void visit(V& v, Ros2InputsConfig& c) {
  v.flag("e_stop", c.e_stop, "true on /e_stop (std_msgs/Bool) is an emergency stop");
  v.choice("cmd_vel", c.cmd_vel, {"closed", "twist", "twist_stamped"},
           "drive by /cmd_vel, and as what it comes: geometry_msgs/Twist or TwistStamped");
  v.flag("joint_command", c.joint_command,
         "follow joint commands on /joint_command (aimrt_msgs/JointCommandArray)");
  v.flag("collision_object", c.collision_object,
         "objects around the robot come on /collision_object (moveit_msgs/CollisionObject)");
  v.flag("planning_constraints", c.planning_constraints,
         "constraints come on /planning_constraints (moveit_msgs/Constraints)");
}

template <class V>
void visit(V& v, Ros2Config& c) {
  v.choice("mode", c.mode, {"off", "localhost", "network"},
           "who is met: nobody, programs on this computer, or whoever reaches its networks");
  v.integer("domain", c.domain, Range{0, 232}, "DDS domain, as ROS_DOMAIN_ID");
  v.number("rate_Hz", c.rate_Hz, Range{1, 200}, "joints, IMU, odometry and frames a second");
  v.object("inputs", c.inputs, "what is heard: each is closed until it is opened");
  v.flag("network_inputs", c.network_inputs,
         "with mode network: whoever reaches the robot's networks may use the inputs");
  v.text("interface", c.interface,
         "with mode network: the network that is used, wlan0 say; left out, the first");
  c.configured = true;
}

template <class V>
void visit(V& v, CornerConfig& c) {
  v.number("x_m", c.x_m, Range{-20, 20}, "ahead of base_link", Presence::required);
  v.number("y_m", c.y_m, Range{-20, 20}, "left of base_link", Presence::required);
}

template <class V>
void visit(V& v, FrameConfig& c) {
  v.number("x_m", c.x_m, Range{-20, 20}, "ahead of base_link");
  v.number("y_m", c.y_m, Range{-20, 20}, "left of base_link");
  v.number("z_m", c.z_m, Range{-20, 20}, "above base_link, which is on the ground");
  v.number("roll_deg", c.roll_deg, Range{-360, 360}, "about its x, after yaw and pitch");
  v.number("pitch_deg", c.pitch_deg, Range{-360, 360}, "about its y, after yaw");
  v.number("yaw_deg", c.yaw_deg, Range{-360, 360}, "counter-clockwise from ahead");
}

template <class V>
void visit(V& v, FieldConfig& c) {
  v.number("ahead_m", c.ahead_m, Range{0.2, 10}, "from the front edge of the footprint on");
  v.number("beside_m", c.beside_m, Range{0.1, 5}, "to each side of base_link");
}

template <class V>
void visit(V& v, SceneConfig& c) {
  v.list(
      "footprint", c.footprint, Count{3, kMaxCorners},
      "corners of what the robot covers of the ground, seen from above: in order, convex, around "
      "base_link",
      Presence::required);
  v.number("height_m", c.height_m, Range{0.05, 20}, "top of the robot: what hangs higher is free");
  v.number("ground_clearance_m", c.ground_clearance_m, Range{0, 5}, "what is lower is driven over");
  v.choice("heights", c.heights, {"robot", "ignore"},
           "robot: only what is between ground clearance and height is in the way; ignore: "
           "everything is, on uneven land");
  v.number(
      "margin_m", c.margin_m, Range{0, 5},
      "kept free around the footprint, beside the errors of position and heading; 0.02 m at least");
  v.number("ahead_m", c.ahead_m, Range{0.2, 100},
           "looked at along the present curve, ahead and back; bounds the speed");
  v.number("along_m", c.along_m, Range{0.2, 200},
           "looked at along the track; bounds the speed of a task");
  v.number("reaction_s", c.clearance.reaction_s, Range{0.1, 5},
           "from something that appears to the base's braking: sensor, scene, cycle and drives");
  v.number(
      "again_m", c.clearance.again_m, Range{0.01, 5},
      "so much freer than at the least, or 0.4 m in all, and for again_s, before what was blocked "
      "is free again");
  v.number("again_s", c.clearance.again_s, Range{0.2, 60}, "see again_m");
  v.number("wait_s", c.clearance.wait_s, Range{0.5, 60},
           "a task whose track was not looked along for so long ends");
  v.number("max_object_age_s", c.max_object_age_s, Range{0, 31'536'000},
           "stored objects that are older when they are loaded are left out; 0: none is too old");
  v.table("frames", c.frames, Count{0, kMaxFrames},
          "frames on the base by name, for messages that say where something is");
  v.object("field", c.field, "what a scanner sees in it is in the way");
  c.configured = true;
}

template <class V>
void visit(V& v, DroverConfig& c, GroupNames& groups) {
  v.text("robot", c.robot_name, "name of this robot");
  v.object("paths", c.paths, "folders");
  v.object("control", c.control, "control thread");
  v.table("links", c.links, Count{1, kMaxLinks}, "ways to devices, by name", Presence::required);
  v.table("devices", c.devices, Count{1, kMaxDevices}, "devices, by name", Presence::required);
  v.object("groups", groups, "what the joints are parts of", Presence::required);
  v.object("limits", c.engine.limits, "limits of motion");
  v.object("estimate", c.engine.estimate, "fusion");
  v.object("navigate", c.engine.navigate, "tasks");
  v.object("health", c.engine.health, "freshness");
  v.object("outputs", c.outputs, "digital outputs");
  v.object("guard", c.guard, "drover-guard");
  v.object("mqtt", c.mqtt, "broker");
  v.object("protocol", c.protocol, "choices of the RTK navigation protocol");
  v.object("aimrt", c.aimrt, "AimRT channel");
  v.object("ros2", c.ros2, "drover-ros2: left out, it shows nothing");
  v.object("scene", c.scene, "what is around the robot: left out, nothing of it is looked at");
  v.names(
      "accept", c.accept, Count{0, 20},
      "no_estop: there is no e-stop line; slow_guard: guard.limit_ms is above 200; no_tilt: "
      "nothing tells how steep the ground is; no_soc: no battery tells its charge; no_relay: "
      "nothing takes the power from drives that do not stop; short_look: the scene, or a lidar's "
      "field, is not looked at as far as the fastest speed needs; slow_chassis: what the "
      "drives do by their own max_speed_mps or max_rpm is below limits.max_speed_mps; far_antenna: "
      "it is farther from base_link than three tracks; slow_watchdog: a drive goes on for more "
      "than a second when its line is cut; "
      "no_guard: it drives without drover-guard; falls: a joint that carries a weight sinks or "
      "falls without power; no_first_way: navigate.first_way_m is 0; late_silence: a drive is "
      "silent for more than half a second before the robot stops; estop_not_fail_safe: a broken "
      "wire of the e-stop reads as released; remote_broker: mqtt.host is another computer, which "
      "droverd.service was allowed to reach; lets_fall: a joint that carries a weight is let go "
      "when its commands cease; rolls: groups.base.max_tilt_deg is above 3, and drover-guard lets "
      "the wheels coast; early_time_out: a drive of which nobody says that it holds then stops by "
      "itself before the guard does; swings: a joint is damped little where it is held; mixed_bus: "
      "DAMIAO motors share a bus with CANopen or RoboMaster drives, or drives of two bit rates do; "
      "that is known");
}

}  // namespace drover::config
