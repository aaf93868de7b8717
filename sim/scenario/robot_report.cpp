#include "sim/scenario/robot_report.h"

#include <nlohmann/json.hpp>

#include <array>
#include <utility>

namespace drover::sim {
namespace {

using nlohmann::json;

constexpr std::array<std::pair<std::string_view, std::string_view>, 7> kFeedbackEvents{{
    {"save_trajectory_success", "saved"},
    {"save_trajectory_failse", "save_failed"},
    {"start_task_success", "start_task"},
    {"start_task_failse", "start_task_failed"},
    {"start_nav_success", "start_nav"},
    {"start_nav_failse", "start_nav_failed"},
    {"cancel_task_success", "cancelled"},
}};

}  // namespace

std::vector<std::string> RobotReport::on_base_status(std::string_view payload) try {
  const auto message = json::parse(payload);
  const auto& pose = message.at("pose");
  const auto& rtk = message.at("rtk");
  const auto& nav = message.at("nav");
  const auto& robot = message.at("robot");
  fix_ = {pose.at("x").get<double>(), pose.at("y").get<double>(), pose.at("yaw").get<double>(),
          rtk.at("latitude").get<double>(), rtk.at("longitude").get<double>()};
  rtk_status_ = rtk.at("status").get<int>();
  speed_mps_ = robot.at("vx").get<double>();
  turn_radps_ = robot.at("vz").get<double>();
  why_.clear();
  for (const auto& reason : nav.value("why", json::array()))
    why_ += (why_.empty() ? "" : "; ") + reason.get<std::string>();
  heard_ = true;

  std::vector<std::string> events;
  const auto locate = std::exchange(locate_, nav.at("locate").get<std::string>());
  if (locate_ != locate && locate_ == "LOCATE_TRUE") events.emplace_back("ready");
  if (locate_ != locate && locate_ == "LOCATE_FALSE") events.emplace_back("locate_false");
  obstacle_ = nav.at("obstacle").get<bool>();
  const auto status = std::exchange(nav_status_, nav.at("status").get<std::string>());
  const bool held = std::exchange(held_, obstacle_ && nav_status_ == "NAV_RUN");
  if (held_ != held) events.emplace_back(held_ ? "obstacle" : "obstacle_gone");
  if (nav_status_ != status && nav_status_ == "NAV_SUCCESS") events.emplace_back("nav_success");
  if (nav_status_ != status && nav_status_ == "NAV_ERROR") events.emplace_back("nav_error");
  return events;
} catch (const json::exception&) {
  return {};
}

std::vector<std::string> RobotReport::on_feedback(std::string_view payload) try {
  const auto message = json::parse(payload);
  const auto cmd = message.at("cmd").get<std::string>();
  last_feedback_ = cmd;
  for (const auto* key : {"reason", "note"})
    if (message.contains(key)) last_feedback_ += ": " + message.at(key).get<std::string>();
  for (const auto& [feedback, event] : kFeedbackEvents)
    if (cmd == feedback) return {std::string(event)};
  return {};
} catch (const json::exception&) {
  return {};
}

/// One answer, or a list of them.
std::vector<std::string> RobotReport::on_scene_feedback(std::string_view payload) try {
  auto answers = json::parse(payload);
  if (!answers.is_array()) answers = json::array({answers});
  std::vector<std::string> events;
  for (const auto& answer : answers) {
    const auto result = answer.at("result").get<std::string>();
    const auto id = answer.value("id", answer.value("name", ""));
    last_feedback_ = "scene: " + result + (id.empty() ? "" : " " + id);
    if (answer.contains("reason")) last_feedback_ += ": " + answer.at("reason").get<std::string>();
    events.emplace_back(result == "done" ? "scene_done" : "scene_refused");
  }
  return events;
} catch (const json::exception&) {
  return {};
}

}  // namespace drover::sim
