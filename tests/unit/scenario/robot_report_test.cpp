#include "sim/scenario/robot_report.h"

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

namespace drover::sim {
namespace {

using Names = std::vector<std::string>;

std::string base_status(const std::string& locate, const std::string& status,
                        bool obstacle = false) {
  const nlohmann::json message{
      {"nav",
       {{"locate", locate}, {"status", status}, {"obstacle", obstacle}, {"why", {"a", "b"}}}},
      {"pose", {{"x", 1}, {"y", 2}, {"yaw", 3}}},
      {"robot", {{"vx", 0.5}, {"vz", 0.1}}},
      {"rtk", {{"latitude", 23}, {"longitude", 113}, {"status", 4}}}};
  return message.dump();
}

TEST(ARobotReport, IgnoresWhatIsNoMessage) {
  RobotReport report;
  EXPECT_EQ(report.on_base_status("{"), Names{});
  EXPECT_EQ(report.on_base_status("[]"), Names{});
  EXPECT_EQ(report.on_base_status(R"({"pose": {}})"), Names{});
  EXPECT_EQ(report.on_feedback("7"), Names{});
  EXPECT_FALSE(report.heard());
}

TEST(ARobotReport, TellsChangesOnce) {
  RobotReport report;
  EXPECT_EQ(report.on_base_status(base_status("LOCATE_TRUE", "NAV_FREE")), Names{"ready"});
  EXPECT_EQ(report.on_base_status(base_status("LOCATE_TRUE", "NAV_RUN")), Names{});
  EXPECT_EQ(report.on_base_status(base_status("LOCATE_FALSE", "NAV_RUN")), Names{"locate_false"});
  EXPECT_EQ(report.on_base_status(base_status("LOCATE_TRUE", "NAV_SUCCESS")),
            (Names{"ready", "nav_success"}));
  EXPECT_EQ(report.on_base_status(base_status("LOCATE_TRUE", "NAV_SUCCESS")), Names{});
  EXPECT_EQ(report.on_base_status(base_status("LOCATE_TRUE", "NAV_ERROR")), Names{"nav_error"});
  EXPECT_EQ(report.why(), "a; b");
  EXPECT_DOUBLE_EQ(report.fix().y_m, 2);
}

TEST(ARobotReport, CountsAnObstacleOnlyWhileATaskRuns) {
  RobotReport report;
  EXPECT_EQ(report.on_base_status(base_status("LOCATE_UNINIT", "NAV_FREE", true)), Names{});
  EXPECT_EQ(report.on_base_status(base_status("LOCATE_UNINIT", "NAV_RUN", true)),
            Names{"obstacle"});
  EXPECT_EQ(report.on_base_status(base_status("LOCATE_UNINIT", "NAV_RUN", true)), Names{});
  EXPECT_EQ(report.on_base_status(base_status("LOCATE_UNINIT", "NAV_RUN", false)),
            Names{"obstacle_gone"});
}

TEST(ARobotReport, ReadsFeedbackWithItsReason) {
  RobotReport report;
  EXPECT_EQ(report.on_feedback(R"({"cmd":"start_task_failse","reason":"too far"})"),
            Names{"start_task_failed"});
  EXPECT_EQ(report.last_feedback(), "start_task_failse: too far");
  EXPECT_EQ(report.on_feedback(R"({"cmd":"something_else"})"), Names{});
}

TEST(RobotReport, TellsEachAnswerOfTheScene) {
  RobotReport report;
  EXPECT_EQ(report.on_scene_feedback(R"({"id": "box1", "result": "done"})"),
            std::vector<std::string>{"scene_done"});
  EXPECT_EQ(report.on_scene_feedback(
                R"([{"result": "done"}, {"name": "yard", "result": "refused", "reason": "bad"}])"),
            (std::vector<std::string>{"scene_done", "scene_refused"}));
  EXPECT_EQ(report.last_feedback(), "scene: refused yard: bad");
  EXPECT_TRUE(report.on_scene_feedback("nonsense").empty());
}

}  // namespace
}  // namespace drover::sim
