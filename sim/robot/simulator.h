// The robot on its wires: one thread, one timer, every bus, line and log.
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "sim/robot/battery_port.h"
#include "sim/robot/can_port.h"
#include "sim/robot/control_socket.h"
#include "sim/robot/line_port.h"
#include "sim/robot/log.h"
#include "sim/robot/output_log.h"
#include "sim/robot/relay_port.h"
#include "sim/robot/robot.h"
#include "sim/robot/serial_port.h"

namespace drover::sim {

struct SimulatorSettings {
  std::string scenario_file;
  std::uint64_t seed = 1;
  std::string run_folder = "/run/drover-sim";
  std::string log_folder;      ///< empty: no logs
  bool can_over_unix = false;  ///< every bus a socket RUN_FOLDER/NAME.sock
  /// Lines as files below RUN_FOLDER/lines; the gateway's outputs below RUN_FOLDER/outputs.
  bool line_files = false;
};

class Simulator {
 public:
  /// Opens everything. Throws std::runtime_error with one sentence.
  explicit Simulator(const SimulatorSettings& settings);
  ~Simulator();

  /// Until SIGTERM, SIGINT or the command "quit". Ticks lie on multiples of 5 ms of the monotonic
  /// clock; after a delay of more than 100 ms the ticks in between are left out and counted.
  void run();
  /// One line for people.
  std::string summary() const;

 private:
  void tick(Time now);
  void exchange_can(Time now);
  void send_can(Time now);
  void watch_bus(const CanPort& bus);
  bool drain_bus(int fd);
  void write_lines();
  void keep_records(Time now);
  void measure_clocks();
  void exchange_serial(Time now);
  void hear_drives(Time now);
  std::string command(std::string_view text);
  std::string command_tap(std::string_view name);
  std::string command_can(std::string_view text);
  std::string command_lines(std::string_view verb);
  BatteryPort& battery_line(const BatterySpec& spec, const RegisterTwin& device);
  std::string command_more(std::string_view text);
  std::string command_lidar(std::string_view state);
  std::string command_plug(std::string_view device, std::string_view verb);
  SerialPort* drive_line(std::string_view text, std::string_view& verb);
  void on_events(int timeout_ms);

  SimulatorSettings settings_;
  Robot robot_;
  link::UniqueFd epoll_;
  link::UniqueFd timer_;
  link::UniqueFd signals_;
  std::vector<std::unique_ptr<CanPort>> buses_;
  std::vector<std::unique_ptr<SerialPort>> drive_lines_;  // by drive; nullptr: it hangs on a bus
  std::optional<SerialPort> gnss_;
  std::optional<SerialPort> imu_;  // none: there is no inertial sensor, or it hangs on a bus
  std::optional<SerialPort> lidar_;
  std::vector<std::unique_ptr<BatteryPort>> batteries_;  ///< the first battery's, and others
  /// Of further devices; nullptr: batteries, and what hangs on a bus.
  std::vector<std::unique_ptr<SerialPort>> more_lines_;
  std::optional<GpioSimChip> chip_;  // none: the lines are files
  LinePort lines_;
  std::optional<OutputLog> outputs_;
  std::optional<RelayPort> relay_;  // none: the drives have their supply without the gateway
  CanLog can_log_;
  SerialLog serial_log_;  // none where no drive hangs on a serial line
  TruthLog truth_log_;
  TextLog object_log_;  // none where nothing can be put in the robot's way
  std::optional<ControlSocket> control_;
  std::vector<link::ReceivedFrame> received_;
  Duration wall_minus_monotonic_{};
  Time start_{};
  Time previous_{};
  Time next_truth_{};
  Time next_flush_{};
  std::size_t next_event_ = 0;
  std::uint64_t expired_ = 0;  // timer expirations not yet worked off
  std::uint64_t ticks_ = 0;
  std::uint64_t left_out_ = 0;
  std::uint64_t frames_in_ = 0;
  std::uint64_t frames_out_ = 0;
  bool quit_ = false;
};

}  // namespace drover::sim
