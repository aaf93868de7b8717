// One mission as its logs tell it: frames, messages, the operator's doings, and the true motion.
#pragma once

#include <cmath>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

#include "mission/joint_command.h"
#include "mission/log_lines.h"
#include "mission/track.h"
#include "mission/wire.h"

namespace drover::mission {

/// One base_status message.
struct Status {
  Time time = kNever;
  nlohmann::json document;
  std::string nav;
  std::string locate;
  bool obstacle = false;
  std::string why;     ///< all reasons, "; " between them
  Place map;           ///< pose.x, pose.y
  bool placed = true;  ///< the receiver has told a position
  Place sim;           ///< of base_link in the simulator's frame, from rtk and pose.yaw
};

struct Feedback {
  Time time = kNever;
  std::string cmd;
  std::string reason;
};

struct Sent {
  Time time = kNever;
  WheelCommand wheel;
};

/// Whose drives they are.
enum class Maker {
  odrive,
  zlac8015d,
  gt01_serial,
  gt01_can,
  agilex_v2,
  hunter,
  robomaster,
  cia402
};
/// And whose motors an arm on a bus of its own has.
enum class ArmMaker { none, damiao, cubemars_mit };

struct Record {
  std::filesystem::path folder;
  Maker maker = Maker::odrive;
  std::vector<std::string> joints;  ///< of the drives, in their order; none of such a base
  bool bumper = true;               ///< it has one
  double mps_per_turnps = 0;        ///< way of a wheel in a motor's turn
  std::vector<CanLine> can;
  std::vector<MqttLine> mqtt;
  std::vector<EventLine> events;
  std::vector<TruthLine> truth;
  ArmMaker arm = ArmMaker::none;
  std::vector<LevelLine> levels;  ///< of the outputs, where the scenario records them
  // What the lines above mean:
  std::vector<Status> statuses;
  std::vector<Feedback> feedback;
  /// Every set point on the wire, whoever sent it. Of a ZLAC8015D the wheels are nodes 1 and 2; of
  /// RoboMaster motors what drives them is a torque; of a base that takes a twist its left and its
  /// right edge, in m/s.
  std::vector<Sent> sent;
  std::vector<JointCommandLine> joint_commands;
  std::vector<Place> track;   ///< of the last save_trajectory, in the simulator's frame
  std::size_t target_id = 0;  ///< of the last start_task, from 1

  /// When the n-th event of this text happened. Throws std::runtime_error when it did not.
  Time event(const std::string& text, std::size_t n = 1) const;
  std::vector<Time> all(const std::string& text) const;
  /// When the n-th feedback of this kind came. Throws.
  Time answered(const std::string& cmd, std::size_t n = 1) const;
  std::vector<std::string> feedback_words() const;
  /// An output's changes from `begin` to `end`, both included.
  std::vector<LevelLine> changes(const std::string& output, Time begin, Time end) const;
  /// Of an output; nothing: its chip is away. Throws before it was first seen.
  std::optional<bool> level_at(const std::string& output, Time time) const;
  /// Interpolated between two lines; throws outside of them.
  TruthLine truth_at(Time time) const;
  /// Commands with motion from `begin` to `end`, both included.
  std::vector<Sent> moving(Time begin, Time end) const;
  /// How fast a set point lets its wheel's rim move, whichever way.
  double rim_mps(const Sent& one) const {
    return std::abs(one.wheel.velocity_turnps) * mps_per_turnps;
  }
  std::vector<Sent> moving() const { return moving(kNever, Time::max()); }
  /// The first status from `begin` on with this nav.status or locate. Throws.
  const Status& first_status(const std::string& word, Time begin = kNever) const;
};

/// Reads can.log, mqtt.log, events.log, truth.csv and what else the scenario records. Throws
/// std::runtime_error with file and line.
Record read_record(const std::filesystem::path& folder, const nlohmann::json& scenario);

/// The scenario's file and below it the robot it names. Throws std::runtime_error.
nlohmann::json read_scenario(const std::string& name);

/// The record of a scenario, from $DROVER_MISSION_LOGS/NAME; read once. Throws when there is none.
const Record& record(const std::string& name);
/// $DROVER_MISSION_LOGS. Throws when it is not set.
std::filesystem::path logs_folder();

}  // namespace drover::mission
