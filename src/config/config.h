// The whole configuration as plain values; each field is a key of drover.json.
#pragma once

#include <array>
#include <string>
#include <string_view>
#include <vector>

#include "drover/measurement.h"
#include "drover/options.h"
#include "drover/register_map.h"
#include "drover/registry.h"
#include "engine/config.h"

namespace drover::config {

struct PathsConfig {
  std::string state = "/var/lib/drover";  ///< tracks and origin
  std::string run = "/run/drover";        ///< socket of the command line
};

struct ControlConfig {
  double tick_Hz = 200;
  bool realtime = true;  ///< SCHED_FIFO and locked memory where the system allows it
  int priority = 50;
};

/// A way to devices. One of four addresses is given, and says what the link carries.
struct LinkConfig {
  std::string can;     ///< "can0", or "unix:PATH" for a socket that carries the same frames
  std::string serial;  ///< path of the line
  std::string modbus;  ///< path of the line, or "tcp:ADDRESS:PORT"
  std::string gpio;    ///< label or name of the chip, or "files:DIRECTORY"
  int baud = 0;        ///< 0: as is usual; then filled in
  std::string parity = "none";
  std::string name;       ///< its key in the table
  Wire wire = Wire::can;  ///< follows from the address
};

/// Whichever of the four is given.
const std::string& address(const LinkConfig& link);

/// An axis of a device that moves something.
struct JointConfig {
  std::string channel;            ///< of the device; may be left out when it has one
  std::string name;               ///< its key in the table
  std::size_t channel_index = 0;  ///< in the order of the driver's
};

struct DeviceConfig {
  std::string driver;
  std::string link;
  Options options;
  // Of a drive:
  std::vector<JointConfig> joints;  ///< none given: one, with the device's name; then filled in
  std::vector<std::string> accept;  ///< by name what is refused otherwise: no_watchdog
  // Of what is asked for registers:
  std::string map;  ///< file of the device's registers
  int unit = 0;     ///< 0: as the map says; then filled in
  double period_s = 1.0;
  // Of a digital input:
  std::string line;  ///< its name on the chip
  std::string is;    ///< which of the robot's lines it is
  // Of a receiver, an inertial sensor or a battery:
  std::string role;  ///< "steers", "spare" or "told"; left out: then filled in
  // Of a receiver; what is left out is as in `estimate`:
  double antenna_x_m = 0;
  double antenna_y_m = 0;
  double antenna_z_m = 0;
  double heading_baseline_offset_deg = 0;

  std::string name;  ///< its key in the table
  // Follows from other keys:
  SlotKind kind = SlotKind::drive;
  std::size_t link_index = 0;
  AxisId first_axis = 0;  ///< of its joints, which are numbered through all devices
  /// It moves something, and goes on as it was told last when messages cease.
  bool goes_on_in_silence = false;
  int stops_after_ms = 0;  ///< else: when its own time-out ends it
  RegisterMap registers;   ///< read from `map`
};

/// The robot's lines, as they are written: by Line.
inline constexpr std::array<std::string_view, kLineCount> kLineKeys{"estop", "bumper", "zone_far",
                                                                    "zone_near"};

struct OutputConfig {
  bool configured = false;
  std::string name;  ///< line name on the chip
  bool active_low = false;
};

struct OutputsConfig {
  std::string link;                               ///< a chip
  std::array<OutputConfig, kOutputCount> output;  ///< by Output
  OutputConfig watchdog;                          ///< pulsed by the guard for a hardware watchdog
  std::string chip;                               ///< address of the link
};

struct GuardConfig {
  bool required = true;
  std::string socket = "/run/drover/guard.sock";
  int limit_ms = 50;
};

struct MqttConfig {
  bool enabled = true;
  std::string host = "127.0.0.1";  ///< or the path of a Unix socket, with port 0
  int port = 1883;
  std::string client_id;  ///< empty: "droverd-" and eight random hex digits
  std::string username;
  std::string password_file;
  int keepalive_s = 10;
};

struct ProtocolConfig {
  std::string heading = "clockwise_from_north";
  int first_target_id = 1;        ///< number of a track's first point: 1, or 0 for some makers
  std::string power = "percent";  ///< "percent" or "volts"
  std::string vz = "yaw_rate";    ///< "yaw_rate" or "steering_angle"
  bool start_needs_time = false;  ///< refuse a start_task that does not tell when it was pressed
  bool automatic_origin = true;   ///< take the first RTK fix as origin when none was ever stored
};

/// The AimRT channel on the same broker.
struct AimrtConfig {
  bool enabled = true;
  double rate_Hz = 50;
  bool commands = true;  ///< follow joint commands
  int max_command_age_ms = 250;
  // Topics of the channel, as AimRT's modules name them.
  std::string joint_state = "/joint_state";
  std::string imu_state = "/imu_state";
  std::string touch_state = "/touch_state";
  std::string joint_command = "/joint_command";
  // Under whose names of the messages states go out: "document", "aimrt_1x" or "both". Commands
  // are heard under both.
  std::string joint_state_names = "document";
  std::string touch_state_names = "document";
  // How they are written: "pb" or "json". Commands are read in both.
  std::string joint_state_content = "pb";
  std::string imu_state_content = "pb";
  std::string touch_state_content = "pb";
};

/// What drover-ros2 hears from ROS 2 users: each is closed until it is opened.
struct Ros2InputsConfig {
  bool e_stop = false;  ///< true on /e_stop is an emergency stop
  /// What comes on /cmd_vel: "closed", "twist" or "twist_stamped".
  std::string cmd_vel = "closed";
  bool joint_command = false;         ///< what comes on /joint_command is followed
  bool collision_object = false;      ///< what comes on /collision_object is in the scene
  bool planning_constraints = false;  ///< likewise on /planning_constraints

  bool may_move() const { return cmd_vel != "closed" || joint_command; }
  bool may_change_scene() const { return collision_object || planning_constraints; }
  bool any() const { return e_stop || may_move() || may_change_scene(); }
};

/// What drover-ros2 shows to ROS 2 users, and to whom.
struct Ros2Config {
  bool configured = false;  ///< the section is there
  /// "off"; "localhost": programs on this computer; "network": whoever reaches its networks.
  std::string mode = "localhost";
  int domain = 0;  ///< as ROS_DOMAIN_ID
  double rate_Hz = 50;
  Ros2InputsConfig inputs;
  bool network_inputs = false;  ///< whoever reaches its networks may use them
  std::string interface;        ///< the network that mode network uses; empty: the first
};

/// A point of the footprint in base_link.
struct CornerConfig {
  double x_m = 0;
  double y_m = 0;
};

/// A named frame on the base: a sensor, a mast. Yaw first, then pitch, then roll, as mount_*_deg of
/// a sensor.
struct FrameConfig {
  std::string name;  ///< its key in the table
  double x_m = 0;
  double y_m = 0;
  double z_m = 0;
  double roll_deg = 0;
  double pitch_deg = 0;
  double yaw_deg = 0;
};

/// The rectangle before the robot in which whatever a scanner sees is in the way: it begins at the
/// front edge of the footprint.
struct FieldConfig {
  double ahead_m = 2.0;
  double beside_m = 0.4;  ///< to each side of base_link
};

/// What the robot takes of the space around it, and how it looks there.
struct SceneConfig {
  bool configured = false;  ///< the section is there
  /// Convex, counter-clockwise whichever way round it is written, around base_link.
  std::vector<CornerConfig> footprint;
  double height_m = 1.0;             ///< its top
  double ground_clearance_m = 0.05;  ///< what is lower is driven over
  std::string heights = "robot";     ///< or "ignore": on uneven land
  double margin_m = 0.1;             ///< around the footprint
  double ahead_m = 3.0;              ///< so far along the present curve, ahead and back
  double along_m = 10.0;             ///< so far along the track
  double max_object_age_s = 0;       ///< of what is stored, when it is loaded; 0: none is too old
  /// Ages are fixed, beside_m and reach_m follow from margin and footprint; the others are keys of
  /// this section.
  engine::ClearanceConfig clearance;
  std::vector<FrameConfig> frames;
  FieldConfig field;  ///< of scanners; without one it is of no use
};

struct DroverConfig {
  std::string robot_name = "drover";
  PathsConfig paths;
  ControlConfig control;
  std::vector<LinkConfig> links;      ///< in the order of the file
  std::vector<DeviceConfig> devices;  ///< in the order of the file
  OutputsConfig outputs;
  GuardConfig guard;
  MqttConfig mqtt;
  ProtocolConfig protocol;
  AimrtConfig aimrt;
  Ros2Config ros2;
  SceneConfig scene;
  std::vector<std::string> accept;  ///< by name what is warned of otherwise, see warn_of_risks()
  engine::EngineConfig engine;
};

/// Devices with joints, in the order of their axes.
std::vector<const DeviceConfig*> by_axis(const DroverConfig& config);
/// The first device of this kind; nullptr: there is none.
const DeviceConfig* first(const DroverConfig& config, SlotKind kind);
/// Which of the robot's lines a digital input is.
Line line_of(const DeviceConfig& device);
/// What its driver is told of its place.
MakeContext context_of(const DeviceConfig& device);

}  // namespace drover::config
