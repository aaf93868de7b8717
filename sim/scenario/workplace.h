// Where a scenario runs: folders, generated files, and the programs' command lines.
#pragma once

#include <nlohmann/json.hpp>

#include <cstdint>
#include <string>

#include "sim/scenario/children.h"

namespace drover::sim {

struct WorkplaceSettings {
  std::string scenario_file;
  std::vector<std::string> changes;  ///< see set_member
  std::uint64_t seed = 1;
  std::string log_folder;  ///< empty: a temporary one
  std::string program_folder;
  /// In real time, too, the robot's own ages: on a machine that has nothing else to do.
  bool own_ages = false;
  bool native = false;  ///< no CAN interfaces, no gpio-sim: sockets and files in a private folder
};

/// Made once; the private folder goes when it ends.
class Workplace {
 public:
  /// Throws std::runtime_error with one sentence.
  explicit Workplace(const WorkplaceSettings& settings);
  ~Workplace();
  Workplace(const Workplace&) = delete;
  Workplace& operator=(const Workplace&) = delete;

  const nlohmann::json& document() const { return document_; }
  int port() const { return port_; }
  const std::string& log_folder() const { return log_folder_; }
  std::string ready_file() const { return sim_folder_ + "/ready"; }
  std::string sim_socket() const { return sim_folder_ + "/sim.sock"; }
  std::string guard_socket() const { return guard_socket_; }
  std::string daemon_socket() const { return daemon_folder_ + "/drover.sock"; }
  /// Whether devices come and go on USB: then udevd gives them their names, by the rules that the
  /// scenario names (player.udev_rules).
  bool has_udev() const { return !udev_rules_.empty(); }
  /// What the programs read: made of the scenario's files, and gone at the end.
  std::string private_file(const std::string& name) const { return private_folder_ + "/" + name; }
  /// What a program said, with the scenario's and the gateway's own file in the place of what was
  /// made of them, which is gone when somebody looks. Lines and columns of that are left out.
  std::string as_written(const std::string& text) const;
  /// mosquitto, udevd, drover-sim, drover-guard, droverd, or drover with `words` as its arguments.
  Program program(const std::string& name, const std::vector<std::string>& words = {}) const;

 private:
  // The gateway's configuration keeps the order of its tables.
  void widen_ages(nlohmann::ordered_json& config);
  void make_native(nlohmann::ordered_json& config);
  void prepare_udev(nlohmann::ordered_json& config);
  void write_files(const nlohmann::ordered_json& config);

  WorkplaceSettings settings_;
  nlohmann::json document_;
  std::string private_folder_;
  std::string sim_folder_ = "/run/drover-sim";
  std::string daemon_folder_ = "/run/drover";
  std::string guard_socket_;
  std::string log_folder_;
  std::string config_file_;  ///< the gateway's, beside the robot
  std::string udev_rules_;   ///< empty: none
  int port_ = 1883;
};

}  // namespace drover::sim
