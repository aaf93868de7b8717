// The "mission" of a scenario: what the operator does, and what goes wrong when.
//
// Events that steps can follow: boot (all programs were started), ready (LOCATE_TRUE),
// locate_false, saved, save_failed, start_task, start_task_failed, start_nav, start_nav_failed,
// nav_success, nav_error, obstacle (while NAV_RUN), obstacle_gone, cancelled, broker_lost,
// broker_back, commands_end (a stream of joint commands is over), scene_done and scene_refused
// (each answer on scene_feedback), object_arrived, exit_NAME of a program, and the name of every
// step. "ready#2" is the second one.
#pragma once

#include <nlohmann/json.hpp>

#include <map>
#include <optional>
#include <string>
#include <vector>

#include "drover/time.h"
#include "sim/scenario/action.h"
#include "sim/scenario/track.h"

namespace drover::sim {

struct EventName {
  std::string name;
  std::size_t count = 1;
};
/// "ready#2". Throws std::runtime_error.
EventName parse_event_name(const std::string& text);

/// A bound on one value of the robot's true state: {"x_m_above": 8}.
struct Condition {
  std::string value;
  bool above = true;
  double bound = 0;
};

struct Step {
  std::string name;
  EventName after;
  Duration delay{};
  std::optional<Condition> when;  ///< waited for, once the delay is over
  std::vector<Action> actions;
};

struct Mission {
  std::string name;
  std::string track_name;
  std::vector<TrackPose> track;
  std::size_t target_id = 0;  ///< from 1
  double speed_mps = 0.5;
  bool automatic = true;  ///< save when first ready, then start when ready
  std::vector<Step> steps;
  std::optional<EventName> end_after;  ///< none: the first nav_success, nav_error or failed start
  Duration end_delay = std::chrono::seconds(1);
  Duration timeout = std::chrono::seconds(300);
  std::string expect_status = "NAV_SUCCESS";
  Origin origin;
  Antenna antenna;  ///< as the gateway is told of it
};

/// From a scenario's document (see scenario_file.h). Throws std::runtime_error naming the key.
Mission read_mission(const nlohmann::json& document);

/// Changes one member: "mission.speed_mps=0.3". The value is JSON, or else a text.
/// Throws std::runtime_error.
void set_member(nlohmann::json& document, const std::string& assignment);

}  // namespace drover::sim
