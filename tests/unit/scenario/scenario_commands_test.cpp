// The commands of the scenarios that are delivered, told to the robots that they name.
#include <gtest/gtest.h>

#include <filesystem>
#include <string>
#include <vector>

#include "sim/robot/robot.h"
#include "sim/robot/scenario_file.h"
#include "sim/scenario/draw.h"
#include "sim/scenario/mission.h"

namespace drover::sim {
namespace {

/// Cables, controllers, chips and the battery's line are not the robot's.
bool is_of_a_line(const std::string& command) {
  for (const auto* end : {"plug", "unplug", "unplugged", "disconnect"})
    if (command.ends_with(end)) return true;
  for (const auto* begin : {"can ", "lines ", "tap ", "battery "})
    if (command.starts_with(begin)) return true;
  return false;
}

std::vector<std::string> commands_of(const nlohmann::json& document) {
  std::vector<std::string> commands;
  for (const auto& step : read_mission(document).steps)
    for (const auto& action : step.actions)
      if (action.kind == Action::Kind::sim && !is_of_a_line(action.text))
        commands.push_back(action.text);
  return commands;
}

// A step that the robot refuses is told in the lab only when its moment comes.
TEST(TheScenarios, TellTheRobotOnlyWhatItCanDo) {
  std::size_t told = 0;
  const auto folder = std::filesystem::path(DROVER_SOURCE_DIR) / "sim/scenarios";
  for (const auto& entry : std::filesystem::directory_iterator(folder)) {
    const auto file = entry.path().string();
    auto document = load_scenario_document(file);
    draw_mission(document, 1);
    const auto commands = commands_of(document);
    if (commands.empty()) continue;
    const auto scenario = load_scenario(file);
    Robot robot(scenario, make_twins(scenario, 1));
    robot.step(Time(std::chrono::seconds(1)));
    for (const auto& command : commands) {
      const auto answer = robot.command(command);
      EXPECT_FALSE(answer.starts_with("error")) << file << ": " << command << ": " << answer;
      ++told;
    }
  }
  EXPECT_GE(told, 50U);
}

}  // namespace
}  // namespace drover::sim
