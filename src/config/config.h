// The whole configuration as plain values; each field is a key of drover.json.
#pragma once

#include <string>
#include <vector>

#include "drover/measurement.h"
#include "drover/options.h"
#include "drover/register_map.h"
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

struct BusConfig {
  std::string name;
  std::string interface;  ///< "can0", or "unix:PATH" for a socket that carries the same frames
};

struct DriveConfig {
  std::string joint;
  std::string driver;
  std::string bus;
  Options options;
  std::vector<std::string> accept;  ///< by name what is refused otherwise: no_watchdog
  std::size_t bus_index = 0;        ///< resolved from `bus`
};

struct GnssConfig {
  bool configured = false;
  std::string driver = "nmea0183";
  std::string port = "/dev/drover/gnss";
  int baud = 115200;
  Options options;
};

struct ImuConfig {
  bool configured = false;
  std::string driver;
  std::string port = "/dev/drover/imu";
  int baud = 115200;
  Options options;
};

struct BatteryConfig {
  bool configured = false;
  std::string driver = "modbus_bms";
  std::string map;                           ///< file of the device's registers
  std::string port = "/dev/drover/battery";  ///< serial line, or "tcp:ADDRESS:PORT"
  int baud = 0;                              ///< 0: as the map says
  std::string parity = "none";
  int unit = 0;  ///< 0: as the map says
  double period_s = 1.0;
  Options options;
  RegisterMap registers;  ///< read from `map`
};

struct LineConfig {
  bool configured = false;
  std::string driver = "gpio_line";
  std::string name;  ///< line name on the chip
  Options options;
};

struct LinesConfig {
  std::string chip;                         ///< label or name of the chip, or "files:DIRECTORY"
  std::array<LineConfig, kLineCount> line;  ///< by Line
};

struct OutputConfig {
  bool configured = false;
  std::string name;  ///< line name on the chip
  bool active_low = false;
};

struct OutputsConfig {
  std::string chip;                               ///< as LinesConfig's
  std::array<OutputConfig, kOutputCount> output;  ///< by Output
  OutputConfig watchdog;                          ///< pulsed by the guard for a hardware watchdog
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

struct DroverConfig {
  std::string robot_name = "drover";
  PathsConfig paths;
  ControlConfig control;
  std::vector<BusConfig> buses;
  std::vector<DriveConfig> drives;
  GnssConfig gnss;
  ImuConfig imu;
  BatteryConfig battery;
  LinesConfig lines;
  OutputsConfig outputs;
  GuardConfig guard;
  MqttConfig mqtt;
  ProtocolConfig protocol;
  AimrtConfig aimrt;
  std::vector<std::string> accept;  ///< by name what is warned of otherwise: no_estop, slow_guard
  engine::EngineConfig engine;
};

}  // namespace drover::config
