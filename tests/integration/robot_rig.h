// A whole robot on one machine: broker, simulated hardware, guard and gateway as real processes,
// with CAN frames over a socket, contacts as files and the receiver on a pseudo-terminal.
//
// It runs in real time on whatever machine builds it, so nothing here asserts a time; deadlines
// only end what hangs, and grow with DROVER_DEADLINE_FACTOR. A test that fails on a machine that
// had no time for it says so, and ctest shows it as skipped.
#pragma once

#include <gtest/gtest.h>

#include <chrono>
#include <filesystem>
#include <functional>
#include <string>
#include <string_view>
#include <vector>

#include "integration/operator_client.h"
#include "integration/process.h"
#include "integration/starvation_watch.h"

namespace drover::test {

/// DROVER_DEADLINE_FACTOR: how many times slower the programs are, say with a sanitizer; 1 without.
int deadline_factor();

struct CommandResult {
  int code = -1;  ///< -1: it did not end
  std::string text;
};

/// A velocity set point on the bus.
struct SetPoint {
  double time_s = 0;  ///< of the monotonic clock
  unsigned bus = 0;   ///< 0: can0
  unsigned node = 0;
  float velocity_turnps = 0;
};

class RobotRig : public testing::Test {
 protected:
  RobotRig();
  ~RobotRig() override;

  void start_broker();
  void start_sim();
  void start_guard();
  void start_daemon();
  /// After `first`, a line of a shell; the shell itself by `wrapper`. It is replaced by the
  /// gateway.
  void start_daemon(const std::string& first, std::vector<std::string> wrapper = {});
  /// From the next start of the gateway on.
  void set_broker_host(const std::string& host);
  /// Into the configuration, like `"aimrt": {"commands": false}`: from the next start on.
  void add_section(const std::string& section);
  /// Each `from` of sim.json or drover.json becomes `to`: from the next start on.
  void edit(const char* name, std::string_view from, const std::string& to);
  /// All four, until the robot knows where it is. It has driven before, in this boot and with this
  /// configuration: no first way of 0.3 m at 0.05 m/s.
  void start_all();
  /// As that, but it has never driven.
  void start_new();
  /// Ends the gateway as systemd would and expects that it ends well.
  void stop_daemon();

  /// Turns the operator's loop until `done`; false at the deadline (60 s), or when so long is over.
  bool wait_until(const std::function<bool()>& done);
  bool wait_until(const std::function<bool()>& done, std::chrono::nanoseconds longest);
  bool wait_for_feedback(std::string_view cmd, std::size_t from);
  bool wait_for_status(std::string_view nav_status);
  bool wait_for_locate();

  /// In the first second after the broker came back nothing is followed that begins a motion.
  void wait_until_believed();
  void control(std::string_view text, bool retained = false);
  /// A save_trajectory: straight ahead of where the robot believes to be, points each half metre.
  std::string track_ahead(const std::string& name, double length_m) const;
  void save_track(const std::string& name, double length_m);
  void start_task(const std::string& name, int id, double speed_mps = 0.5);
  /// As a person who is refused and tries again: the broker was connected just now, say. Returns
  /// when the accepted one was sent.
  double start_until_accepted(const std::string& name, int id);
  /// Saves a track of `length_m`, starts it and waits until the robot moves.
  void drive(double length_m);

  CommandResult drover(std::vector<std::string> words);
  CommandResult droverd(std::vector<std::string> words);
  std::string sim(std::vector<std::string> words);

  /// A member of the newest base_status, like `nav.status`; text as it is, anything else as JSON.
  std::string status_text(std::string_view section, std::string_view key) const;
  double status_number(std::string_view section, std::string_view key) const;
  double true_speed_mps();
  bool at_rest() { return true_speed_mps() < 0.01; }
  /// Ends the simulator and reads its record of the bus.
  std::vector<SetPoint> set_points_on_the_bus();
  static double now_s();

  const std::filesystem::path& folder() const { return folder_; }
  int port() const { return port_; }  ///< the broker's
  Process& broker() { return broker_; }
  Process& simulator() { return sim_; }
  Process& guard() { return guard_; }
  Process& daemon() { return daemon_; }
  OperatorClient& client() { return client_; }

 private:
  std::string log(const char* name) const { return (folder_ / name).string(); }
  CommandResult run(const std::vector<std::string>& words);
  void write_files();
  /// As if the gateway that was here before it had driven it.
  void remember_its_first_way();
  /// Of one thing a test waits for. All of them together end before ctest ends the test, after
  /// 600 s (CMakeLists.txt): a test that was ended tells nothing of what it saw.
  std::chrono::milliseconds deadline() const;
  /// False when there is one.
  bool expect_no_sanitizer_report(const Process& process) const;
  void tell_what_happened() const;

  const std::chrono::steady_clock::time_point began_ = std::chrono::steady_clock::now();
  std::filesystem::path folder_;
  int port_ = 0;
  int commands_ = 0;
  Process broker_;
  Process sim_;
  Process guard_;
  Process daemon_;
  OperatorClient client_;
  StarvationWatch starvation_;
};

}  // namespace drover::test
