// What the simulated robot is built of: world, start, origin, devices and timed events, from JSON.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "drover/options.h"
#include "drover/registry.h"
#include "drover/time.h"
#include "sim/robot/battery.h"

namespace drover::sim {

enum class CanKind : std::uint8_t {
  vcan,         ///< an interface that exists already
  canfd,        ///< the same, with frames of 64 bytes
  slcan,        ///< made by drover-sim on a pseudo-terminal: a controller with error states
  unix_socket,  ///< SOCK_SEQPACKET with `struct can_frame`s, for hosts without AF_CAN
};

struct BusSpec {
  std::string name;
  CanKind kind = CanKind::vcan;
};

/// A device's end of a serial line.
struct SerialSpec {
  std::string port = "base";  ///< as a receiver's
  int baud = 115200;
};

struct DriveSpec {
  std::string name;                 ///< beside its joints' names; may be empty
  std::vector<std::string> joints;  ///< of the world, in the order of the driver's channels
  const DriverEntry* driver = nullptr;
  std::size_t bus = 0;               ///< on CAN: index into `buses`
  std::optional<SerialSpec> serial;  ///< not on CAN
  bool own_supply = false;           ///< neither relay nor e-stop nor a dip takes it away
  Options options;                   ///< the driver's and the twin's

  /// By its own name, or by that of any of its joints.
  bool is_called(std::string_view text) const;
};

struct GnssSpec {
  const DriverEntry* driver = nullptr;
  /// Symbolic link to the pseudo-terminal; relative: in the run folder. "usb:1546:01a9": see
  /// serial_port.h.
  std::string port = "gnss";
  int baud = 115200;
  Options options;
  // Antenna in base_link.
  double antenna_x_m = 0;
  double antenna_y_m = 0;
  double antenna_z_m = 0;
  double heading_offset_deg = 0;  ///< of the antennas' baseline from ahead, clockwise
};

struct ImuSpec {
  const DriverEntry* driver = nullptr;
  std::optional<std::size_t> bus;  ///< on CAN: index into `buses`; else on a serial line
  std::string port = "imu";        ///< as the receiver's
  int baud = 115200;
  Options options;  ///< with the attitude in which it is mounted
  // Place in base_link.
  double x_m = 0;
  double y_m = 0;
  double z_m = 0;
};

struct BatterySpec {
  const DriverEntry* driver = nullptr;
  RegisterMap map;
  std::string port = "battery";  ///< symbolic link to the pseudo-terminal
  int baud = 9600;
  std::uint8_t unit = 1;
  Options options;
  BatteryModel model;
};

struct ScannerSpec {
  const DriverEntry* driver = nullptr;
  std::string port = "lidar";  ///< as the receiver's
  int baud = 230400;
  Options options;  ///< whether it hangs; its place is the one below
  // Place in base_link, and what its x points to, counter-clockwise from ahead. Its plane is the
  // base's.
  double x_m = 0;
  double y_m = 0;
  double z_m = 0;
  double yaw_deg = 0;
  double reach_m = 12;  ///< farther nothing comes back
};

/// One more of a kind: one of the three is there.
struct MoreSpec {
  std::string name;
  std::optional<GnssSpec> gnss;
  std::optional<ImuSpec> imu;
  std::optional<BatterySpec> battery;

  std::string_view kind() const { return gnss ? "gnss" : imu ? "imu" : "battery"; }
};

enum class LineName : std::uint8_t { estop, bumper, zone_far, zone_near };
inline constexpr std::size_t kLineNames = 4;
inline constexpr std::array<std::string_view, kLineNames> kLineText{"estop", "bumper", "zone_far",
                                                                    "zone_near"};

/// A contact. All are fail-safe by default, as a normally closed contact or a scanner's output is:
/// high means that all is well, low that it is active, or that the wire is broken.
struct LineSpec {
  bool wired = true;
  bool active_high = false;
};

struct Event {
  Duration at{};  ///< since the simulator became ready
  std::string command;
};

struct Scenario {
  std::string name;
  std::string world;  ///< path of the MJCF file
  double start_x_m = 0;
  double start_y_m = 0;
  double start_yaw_deg = 0;  ///< counter-clockwise from east
  double origin_latitude_deg = 0;
  double origin_longitude_deg = 0;
  double origin_altitude_m = 0;
  std::vector<BusSpec> buses;
  std::vector<DriveSpec> drives;
  std::optional<GnssSpec> gnss;
  std::optional<ImuSpec> imu;
  std::optional<BatterySpec> battery;
  std::optional<ScannerSpec> lidar;
  std::vector<MoreSpec> more;  ///< in the order of the alphabet
  std::array<LineSpec, kLineNames> lines;
  double zone_near_m = 0.6;  ///< ahead of the bumper
  double zone_far_m = 2.0;
  double zone_width_m = 0.8;
  bool outputs = false;  ///< the wires of the gateway's outputs are recorded (a gpio-sim chip's)
  bool estop_cuts_power = false;  ///< the pressed button also takes the drives' supply away
  /// The gateway's output enable_relay feeds the drives: open or not driven, they have no supply.
  bool relay_feeds_drives = false;
  bool brake = false;      ///< each wheel has a holding brake, released only by its drive
  bool worm_gear = false;  ///< no wheel can turn its motor
  /// Between two lines of the true motion.
  Duration truth_period = std::chrono::milliseconds(50);
  std::vector<Event> events;  ///< by time
};

/// Throws std::runtime_error with one sentence that names the key ("drives[2].bus: ...").
/// The paths of a world and of a register map are relative to `folder`. Keys that belong to the
/// scenario's player ("description", "gateway", "mission", "player") are left alone; any other
/// unknown key is refused.
Scenario parse_scenario(std::string_view json, const std::string& folder);
/// The same for a file, which may name its robot: see scenario_file.h.
Scenario load_scenario(const std::string& file);

}  // namespace drover::sim
