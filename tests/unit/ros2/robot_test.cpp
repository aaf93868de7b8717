// What /tf_static and the scans have of the configuration.
#include "ros2/robot.h"

#include <gmock/gmock.h>

#include <cmath>
#include <string>
#include <vector>

#include "config/load.h"
#include "drover/angle.h"

namespace drover::ros2 {
namespace {

constexpr const char* kScene = R"(
  "scene": {
    "footprint": [{"x_m": 0.2, "y_m": 0.25}, {"x_m": -0.35, "y_m": 0.25},
                  {"x_m": -0.35, "y_m": -0.25}, {"x_m": 0.2, "y_m": -0.25}],
    "frames": {
      "gripper": {"x_m": 0.5, "y_m": -0.25, "z_m": 0.75,
                  "roll_deg": 10, "pitch_deg": 20, "yaw_deg": 30},
      "hitch": {"x_m": -0.5}
    },)";

void replace(std::string& text, std::string_view from, std::string_view to, std::string_view by) {
  const auto at = text.find(from);
  const auto end = text.find(to, at);
  ASSERT_NE(end, std::string::npos) << from;
  text.replace(at, end + to.size() - at, by);
}

/// The example with a lidar that is mounted to the left, and with frames.
Robot example() {
  std::string text;
  EXPECT_EQ(config::read_text(DROVER_SOURCE_DIR "/config/examples/lidar.json", text), "");
  replace(text, "\"mount_yaw_deg\": 0,", ",", "\"mount_yaw_deg\": 90,");
  replace(text, "\n  \"scene\": {", "}],", kScene);
  const auto loaded = config::load_text(text);
  for (const auto& problem : loaded.problems) ADD_FAILURE() << problem.text("lidar.json");
  return robot_of(loaded.config);
}

/// "lidar{ x, y, z in m, roll, pitch, yaw in degrees }"
std::string text_of(const FixedFrame& frame) {
  std::vector<double> numbers{frame.x_m,
                              frame.y_m,
                              frame.z_m,
                              to_deg(frame.roll_rad),
                              to_deg(frame.pitch_rad),
                              to_deg(frame.yaw_rad)};
  for (double& number : numbers) number = std::round(1e6 * number) / 1e6;
  return frame.name + testing::PrintToString(numbers);
}

TEST(RobotOfAConfiguration, HasTheFramesOfItsSensorsAndOfItsScene) {
  std::vector<std::string> frames;
  for (const auto& frame : example().frames) frames.push_back(text_of(frame));
  EXPECT_THAT(frames, testing::UnorderedElementsAre("gnss{ -0.05, 0, 0.5, 0, 0, 0 }",
                                                    "lidar{ 0.15, 0, 0.35, 0, 0, 90 }",
                                                    "gripper{ 0.5, -0.25, 0.75, 10, 20, 30 }",
                                                    "hitch{ -0.5, 0, 0, 0, 0, 0 }"));
}

TEST(RobotOfAConfiguration, HasItsScannersLimits) {
  const Robot robot = example();
  EXPECT_EQ(robot.name, "with a lidar");
  ASSERT_EQ(robot.scanners.size(), 1U);
  EXPECT_EQ(robot.scanners[0].frame.name, "lidar");
  EXPECT_EQ(robot.scanners[0].limits.max_m, 12);
}

}  // namespace
}  // namespace drover::ros2
